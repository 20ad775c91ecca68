#include <pybind11/stl.h>

#include <filesystem>

#include "base/output_file.h"
#include "base/text.h"
#include "encoder/encode.h"
#include "encoder/field/file/field_file.h"
#include "params/encode_limits.h"
#include "python/arrays.h"
#include "solver/snapshot/snapshot.h"

namespace cleft::python {

namespace {

namespace fs = std::filesystem;

/// A folder of its own for the snapshot that the encoder reads, removed at the end.
struct Scratch {
  fs::path folder;
  Scratch() {
    std::string name = (fs::temp_directory_path() / "cleft-XXXXXX").string();
    if (!mkdtemp(name.data())) throw InputError(name + ": no folder can be made there; set TMPDIR");
    folder = name;
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
};

void need_shape(bool good, const std::string& name, const std::string& expected, const py::array& array) {
  if (!good)
    throw InputError(name + ": an array of shape " + expected + " is needed, not " +
                     text_of({array.shape(), array.shape() + array.ndim()}));
}

/// A time series in canonical coordinates, as imported data are.
Snapshot series_of(const Dense<double>& points, const Dense<std::int32_t>& pairs, const Dense<double>& times,
                   const Dense<std::int32_t>& released, const Dense<double>& position) {
  Snapshot s;
  s.points = rows_of<Vec3>(points, "points");
  s.cell_offsets = {0};
  if (pairs.size() > 0) s.pairs = rows_of<std::array<std::int32_t, 2>>(pairs, "pairs");
  s.times.assign(times.data(), times.data() + times.size());
  s.released.assign(released.data(), released.data() + released.size());
  s.position.assign(position.data(), position.data() + position.size());
  s.smallest_gap.assign(s.times.size(), 0);
  s.source = SnapshotSource{"arrays", {}, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, 0, "0,1,0,0"};
  return s;
}

SharedField encoded(const Dense<double>& points, const Dense<std::int32_t>& pairs, const Dense<double>& times,
                    const Dense<double>& displacement, const Dense<std::int32_t>& released,
                    const Dense<double>& position, const std::array<double, 3>& cut, double tolerance,
                    const std::string& parametrization, const std::map<std::string, Value>& parameters,
                    const std::string& out) {
  if (!(tolerance >= least_tolerance && tolerance < 1))
    throw InputError("tolerance = " + shortest(tolerance) + ": must be at least 1e-9 and less than 1");
  Snapshot s = series_of(points, pairs, times, released, position);
  std::tie(s.cut_start, s.cut_length, s.cut_depth) = std::tuple(cut[0], cut[1], cut[2]);
  const auto N = static_cast<py::ssize_t>(s.points.size()), F = static_cast<py::ssize_t>(s.times.size());
  need_shape(displacement.ndim() == 3 && displacement.shape(0) == F && displacement.shape(1) == N &&
                 displacement.shape(2) == 3,
             "displacement", "(times, points, 3) = " + text_of({F, N, 3}), displacement);
  if (!out.empty()) const OutputFile probe(out);  // reports a bad name before the work
  const auto* values = reinterpret_cast<const Vec3*>(displacement.data());
  const Scratch scratch;
  const std::string file = (scratch.folder / "series.h5").string();
  for (const auto& [name, value] : parameters) s.parameters.set(name, value);
  SnapshotWriter writer(file, s);
  writer.write_frames(0, {values, static_cast<std::size_t>(N * F)});
  writer.finish(s);
  std::optional<Series> series;
  try {
    series.emplace(SnapshotReader(file));
  } catch (const FileError& e) {  // the file is this function's own: what is wrong came with the arrays
    throw InputError("displacement: " + std::string(e.what()).substr(file.size() + 2));
  }
  EncodeOptions options;
  options.tolerance = tolerance, options.parametrization = parametrization;
  std::optional<Encoded> result;
  {
    const py::gil_scoped_release unlocked;
    result.emplace(encode(*series, options, [](const std::string&) {}));
  }
  Field& field = result->field;
  field.parameters = s.parameters;
  if (!out.empty()) write_field(out, *result);
  return {std::make_shared<const Field>(std::move(field))};
}

}  // namespace

void bind_encode(py::module_& module) {
  using py::arg;
  module.def("encoded", &encoded, arg("points"), arg("pairs"), arg("times"), arg("displacement"),
             arg("released"), arg("position"), arg("cut"), arg("tolerance"), arg("parametrization"),
             arg("parameters"), arg("out"));
}

}  // namespace cleft::python
