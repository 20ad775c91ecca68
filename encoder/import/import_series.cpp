#include "encoder/import/import_series.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <variant>

#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"
#include "encoder/import/release.h"

namespace cleft {

namespace {

/// Places (u, v, w). Those on the break's plane, or in the plane of a flat mesh, are put there exactly.
std::vector<Vec3> placed_points(const SourceMesh& mesh, const Placement& placement, bool has_break,
                                bool is_flat) {
  const double tolerance = in_plane(mesh);
  std::vector<Vec3> points;
  for (const Vec3& p : mesh.points) {
    Vec3 x = placement.placed(p);
    if (has_break && std::abs(x.y) <= tolerance) x.y = 0;
    if (is_flat) x.z = 0;
    points.push_back(x);
  }
  return points;
}

RecordedParameters parse_parameters(const std::vector<std::string>& list) {
  RecordedParameters parameters;
  for (const std::string& text : list) {
    const std::size_t equals = text.find('=');
    if (equals == 0 || equals == text.npos)
      throw InputError("--set " + text + ": is not NAME=VALUE, such as skin.thickness=1.5");
    const std::string name = text.substr(0, equals);
    const double value = parse_number(text.substr(equals + 1), "--set " + name);
    if (parameters.find(name)) throw InputError("--set " + name + " is given twice");
    parameters.set(name, value);
  }
  return parameters;
}

Snapshot snapshot_of(const Series& series, const Break& found, const Placement& placement, bool is_flat) {
  const SourceMesh& mesh = series.mesh();
  Snapshot s;
  s.points = placed_points(mesh, placement, found.plane.has_value(), is_flat);
  s.cell_types = mesh.cell_types, s.cell_offsets = mesh.cell_offsets, s.connectivity = mesh.connectivity;
  for (const double t : series.times()) s.times.push_back(t - series.times().front());
  for (std::size_t j = 1; j < s.times.size(); ++j)
    if (!(s.times[j - 1] < s.times[j]))
      throw InputError(series.path() + ": times " + shortest(series.times()[j - 1]) + " and " +
                       shortest(series.times()[j]) +
                       " are the same, counted from the first; give more digits");
  fill_cut(s, found);
  s.source =
      SnapshotSource{std::filesystem::path(series.path()).filename().string(), placement.origin,
                     placement.axes, series.times().front(), found.plane ? text_of(*found.plane) : "none"};
  return s;
}

/// Least opening along v over the released pairs; 0 where there are none.
double smallest_gap(const Snapshot& s, std::size_t frame, const std::vector<double>& displacement) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < static_cast<std::size_t>(s.released[frame]); ++p) {
    const auto v = [&](std::int32_t node) { return displacement[3 * static_cast<std::size_t>(node) + 1]; };
    least = std::min(least, v(s.pairs[p][1]) - v(s.pairs[p][0]));
  }
  return std::isfinite(least) ? least : 0;
}

std::vector<Vec3> as_vectors(const std::vector<double>& numbers) {
  std::vector<Vec3> vectors;
  for (std::size_t i = 0; i < numbers.size(); i += 3)
    vectors.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  return vectors;
}

void write_frames(const Series& series, const Placement& placement, const std::string& out,
                  ImportReport& report, const std::function<void(const std::string&)>& progress) {
  Snapshot& s = report.snapshot;
  s.smallest_gap.assign(s.frames(), 0);
  SnapshotWriter writer(out, s, report.arrays);
  for (std::size_t j = 0; j < s.frames(); ++j) {
    progress("writing frame " + std::to_string(j + 1) + " of " + std::to_string(s.frames()));
    FieldValues values = series.frame(j);
    auto array = report.arrays.begin();
    for (std::size_t f = 0; f < values.size(); ++f) {
      const SeriesField& field = series.fields()[f];
      placement.turn(values[f], field.components);
      if (field.name == "displacement") {
        writer.write_frames(j, as_vectors(values[f]));
        s.smallest_gap[j] = smallest_gap(s, j, values[f]);
      } else {
        writer.write_array(*array++, j, values[f]);
      }
    }
  }
  writer.finish(s);
}

}  // namespace

ImportReport import_series(const ImportOptions& o, const std::function<void(const std::string&)>& progress) {
  // Told before the long part.
  if (o.break_plane && *o.break_plane != "none") parse_plane(*o.break_plane);
  auto parameters = parse_parameters(o.parameters);
  Series series(o.series, parse_fields(o.fields));
  refuse_to_overwrite(o.out, series.files());
  { const OutputFile probe(o.out); }

  const std::optional<Vec3> flat = flatness(series.mesh());
  const std::string frames = std::to_string(series.frames());
  Break found = find_break(series, o.break_plane, flat, [&](std::size_t j) {
    progress("looking at frame " + std::to_string(j + 1) + " of " + frames);
  });
  const Placement placement =
      found.plane ? placement_on(found, series.mesh(), flat) : placement_in_box(series.mesh(), o.box, flat);

  ImportReport report;
  report.snapshot = snapshot_of(series, found, placement, flat.has_value());
  report.snapshot.parameters = std::move(parameters);
  for (const SeriesField& field : series.fields())
    if (field.name == "displacement")
      report.has_displacement = true;
    else
      report.arrays.push_back({field.name, static_cast<std::size_t>(field.components), true});
  write_frames(series, placement, o.out, report, progress);
  report.notes = std::move(found.notes);
  if (series.farthest_moved() > same_place(series.mesh()))
    report.notes.push_back("the nodes move by up to " + shortest(series.farthest_moved()) +
                           " between frames; their places in the first frame were taken");
  return report;
}

}  // namespace cleft
