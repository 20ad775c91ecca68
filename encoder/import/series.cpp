#include "encoder/import/series.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "encoder/field/field_source.h"
#include "encoder/import/remeshed_files.h"

namespace cleft {

namespace {

void check_times(const std::string& path, const std::vector<double>& times) {
  if (times.size() < 2)
    throw InputError(path + ": holds " + std::to_string(times.size()) +
                     (times.size() == 1 ? " frame" : " frames") + "; a series needs 2");
  for (std::size_t j = 0; j < times.size(); ++j) {
    if (!std::isfinite(times[j]))
      throw InputError(path + ": the time of frame " + std::to_string(j) + " is not finite");
    if (j > 0 && !(times[j - 1] < times[j]))
      throw InputError(path + ": times must increase, but frame " + std::to_string(j) + " at " +
                       shortest(times[j]) + " follows one at " + shortest(times[j - 1]) +
                       (times[j] == times[j - 1] ? "; pieces of one frame must be merged into one file first"
                                                 : "; sort the frames"));
  }
}

bool among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

template <class T>
std::string listed(const std::vector<T>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

}  // namespace

std::vector<SeriesField> parse_fields(const std::vector<std::string>& texts) {
  std::vector<SeriesField> fields;
  std::set<std::string> names;
  for (const std::string& text : texts) {
    const SourceName names_of(text);
    const SeriesField field{names_of.there, names_of.here, names_of.unit};
    if (field.source.empty() || field.name.empty())
      throw InputError("--field '" + text + "': expected SOURCE, SOURCE:NAME or SOURCE:NAME[UNIT]");
    if (text.ends_with("[]") && text.find(':') != text.npos)
      throw InputError("--field '" + text +
                       "': the brackets hold no unit; write one, as [MPa], or leave them out");
    if (field.name.find('/') != std::string::npos || field.name == ".")
      throw InputError("--field '" + text + "': '" + field.name +
                       "' cannot be a dataset's name; give another, as SOURCE:NAME");
    if (!names.insert(field.name).second) throw InputError("--field: '" + field.name + "' is named twice");
    fields.push_back(field);
  }
  if (fields.empty()) throw InputError("--field: name at least one field, like displacement");
  return fields;
}

ImportedSeries::ImportedSeries(const std::vector<std::string>& paths, const std::vector<SeriesField>& fields)
    : path_(paths.front()), files_(open_series(paths)), fields_(fields) {
  check_times(path_, times());
  find_fields();
  const WantedArrays wanted = sources_there(0);
  SourceFrame first = files_->read(0, wanted);
  if (is_remeshed(*files_, first.mesh)) {
    auto remeshed = std::make_unique<RemeshedFiles>(std::move(files_), wanted);
    notes_.push_back(remeshed->note());
    files_ = std::move(remeshed);
    for (SeriesField& field : fields_) field.of_cells = false;
    first = files_->read(0, sources_there(0));
  }
  compose_fields(first);
  check_cells(where(0), first.mesh);
  describe_fields(first);
  mesh_ = mesh_as_read_ = std::move(first.mesh);
  leave_loose_nodes();
}

std::string ImportedSeries::where(std::size_t frame) const {
  return files_->file(frame) + " (frame " + std::to_string(frame) + ")";
}

/// Among the arrays of the points of frame 0, or else among those of its cells.
void ImportedSeries::find_fields() {
  const std::vector<std::string> points = files_->point_arrays(0), cells = files_->cell_arrays(0);
  const auto all_there = [](const std::vector<Component>& arrays, const std::vector<std::string>& there) {
    return std::all_of(arrays.begin(), arrays.end(),
                       [&](const Component& one) { return one.is_zero() || among(there, one.array); });
  };
  for (SeriesField& field : fields_) {
    std::string of_points = field.source, of_cells = field.source;
    const std::vector<Component> at_points = components_of(of_points, points),
                                 in_cells = components_of(of_cells, cells);
    field.of_cells = field.of_means = !all_there(at_points, points) && all_there(in_cells, cells);
    field.arrays = field.of_cells ? in_cells : at_points;
    field.source = field.of_cells ? of_cells : of_points;
  }
}

WantedArrays ImportedSeries::sources_there(std::size_t frame) const {
  const std::vector<std::string> points = files_->point_arrays(frame), cells = files_->cell_arrays(frame);
  WantedArrays wanted;
  for (const SeriesField& field : fields_)
    for (const auto& [array, column] : field.arrays) {
      if (array.empty()) continue;
      if (!among(field.of_cells ? cells : points, array)) {
        std::vector<std::string> all = points;
        all.insert(all.end(), cells.begin(), cells.end());
        throw InputError("--field " + field.source + ": " + where(frame) + " holds no " +
                         (array == field.source ? "such array" : "array '" + array + "'") +
                         did_you_mean(array, all) + "; there are: " + listed(points) +
                         (cells.empty() ? "" : "; and of cells: " + listed(cells)));
      }
      (field.of_cells ? wanted.cells : wanted.points).push_back(array);
    }
  return wanted;
}

/// Then there is one array of each field, in their order among those of points, or of cells.
void ImportedSeries::compose_fields(SourceFrame& frame) const {
  auto at_points = frame.arrays.begin(), in_cells = frame.cell_arrays.begin();
  std::vector<SourceArray> points, cells;
  for (const SeriesField& field : fields_) {
    auto& next = field.of_cells ? in_cells : at_points;
    std::vector<SourceArray> arrays;
    for (const Component& one : field.arrays)
      if (!one.is_zero()) arrays.push_back(std::move(*next++));
    (field.of_cells ? cells : points).push_back(composed(field.arrays, std::move(arrays), field.source));
  }
  frame.arrays = std::move(points), frame.cell_arrays = std::move(cells);
}

SourceArray& ImportedSeries::array_of(SourceFrame& frame, std::size_t field) const {
  std::size_t before = 0;
  for (std::size_t f = 0; f < field; ++f) before += fields_[f].of_cells == fields_[field].of_cells;
  return (fields_[field].of_cells ? frame.cell_arrays : frame.arrays).at(before);
}

void ImportedSeries::describe_fields(SourceFrame& first) {
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    SeriesField& field = fields_[f];
    const SourceArray& array = array_of(first, f);
    field.components = array.components, field.single = array.single;
    const std::string has = "--field " + field.source + ": has " + std::to_string(field.components) +
                            " components in " + where(0);
    field.all_nine = field.components == 9;
    if (field.all_nine) field.components = 6;
    if (field.components != 1 && field.components != 3 && field.components != 6)
      throw InputError(
          has + "; only scalars (1), vectors (3, or 2) and symmetric tensors (6, or 9) can be imported");
    if (field.name == "displacement" && field.components != 3)
      throw InputError(has + "; a displacement has 3");
  }
}

CellOrder ImportedSeries::check_mesh(std::size_t frame, const SourceMesh& mesh) const {
  const auto refuse = [&](const std::string& what) {
    throw InputError(where(frame) + ": " + what +
                     "; all frames must have the mesh of the first, or the last one another, too");
  };
  if (mesh.points.size() != mesh_as_read_.points.size())
    refuse("has " + std::to_string(mesh.points.size()) + " nodes, where frame 0 has " +
           std::to_string(mesh_as_read_.points.size()));
  std::optional<CellOrder> order = order_as(mesh, mesh_as_read_);
  if (!order) refuse("has other cells than frame 0");
  return std::move(order).value();
}

void ImportedSeries::check_values(std::size_t frame, SourceFrame& found) const {
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    const SeriesField& field = fields_[f];
    const SourceArray& array = array_of(found, f);
    const auto components = static_cast<std::size_t>(field.all_nine ? 9 : field.components);
    const std::size_t count = field.of_cells ? found.mesh.cell_types.size() : found.mesh.points.size();
    if (static_cast<std::size_t>(array.components) != components || array.values.size() != components * count)
      throw InputError(where(frame) + ": field '" + field.source + "' has another shape than in frame 0");
    const auto refuse = [&](std::size_t at, const std::string& what) {
      throw InputError(where(frame) + ": field '" + field.source + "' is " + what + " at " +
                       (field.of_cells ? "cell " : "node ") + std::to_string(at) + " (counted from 0)");
    };
    const auto check = [&](std::size_t at) {
      for (std::size_t c = 0; c < components; ++c)
        if (const double value = array.values[components * at + c]; !std::isfinite(value))
          refuse(at, std::isnan(value) ? "not a number" : "infinite");
    };
    if (field.of_cells || kept_.empty())
      for (std::size_t i = 0; i < count; ++i) check(i);
    else
      for (const std::int32_t node : kept_) check(static_cast<std::size_t>(node));
  }
}

std::vector<double> mean_of_cells(const SourceMesh& mesh, const std::vector<double>& values,
                                  std::size_t components) {
  std::vector<double> sums(mesh.points.size() * components, 0);
  std::vector<int> cells(mesh.points.size(), 0);
  for (std::size_t c = 0; c < mesh.cell_types.size(); ++c)
    for (std::int64_t i = mesh.cell_offsets[c]; i < mesh.cell_offsets[c + 1]; ++i) {
      const auto node = static_cast<std::size_t>(mesh.connectivity[static_cast<std::size_t>(i)]);
      for (std::size_t k = 0; k < components; ++k) sums[components * node + k] += values[components * c + k];
      ++cells[node];
    }
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= std::max(1, cells[i / components]);
  return sums;
}

namespace {

/// XX YY ZZ XY YZ XZ of nine components, row by row. Gives the first place that is not symmetric, if any.
std::optional<std::size_t> to_symmetric(std::vector<double>& values) {
  constexpr double rounding = 1e-5;  // of the largest component: a stress in single precision, summed up
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  std::vector<double> six;
  for (std::size_t i = 0; i + 8 < values.size(); i += 9) {
    const double* t = &values[i];
    for (const auto& [a, b] : {std::pair{1, 3}, {2, 6}, {5, 7}})
      if (std::abs(t[a] - t[b]) > rounding * largest) return i / 9;
    six.insert(six.end(), {t[0], t[4], t[8], (t[1] + t[3]) / 2, (t[5] + t[7]) / 2, (t[2] + t[6]) / 2});
  }
  values = std::move(six);
  return {};
}

}  // namespace

std::vector<double> ImportedSeries::at_nodes(std::size_t frame, std::size_t f,
                                             std::vector<double> values) const {
  const SeriesField& field = fields_[f];
  const auto components = static_cast<std::size_t>(field.all_nine ? 9 : field.components);
  if (field.of_cells) {
    values = mean_of_cells(mesh_, values, components);
  } else if (!kept_.empty()) {
    std::vector<double> some;
    some.reserve(kept_.size() * components);
    for (const std::int32_t node : kept_) {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(components) * node;
      some.insert(some.end(), first, first + static_cast<std::ptrdiff_t>(components));
    }
    values = std::move(some);
  }
  if (field.all_nine)
    if (const auto at = to_symmetric(values))
      throw InputError(
          where(frame) + ": tensor '" + field.source + "' is not symmetric at node " +
          std::to_string(kept_.empty() || field.of_cells ? *at : static_cast<std::size_t>(kept_[*at])) +
          " (counted from 0); write its rows as three vectors, and import these");
  return values;
}

FieldValues ImportedSeries::frame(std::size_t frame) const {
  SourceFrame found = files_->read(frame, sources_there(frame));
  compose_fields(found);
  const CellOrder order = check_mesh(frame, found.mesh);
  check_values(frame, found);
  order_cells(found, order);
  for (std::size_t i = 0; i < found.mesh.points.size(); ++i)
    farthest_moved_ = std::max(farthest_moved_, norm(found.mesh.points[i] - mesh_as_read_.points[i]));
  FieldValues values;
  for (std::size_t f = 0; f < fields_.size(); ++f)
    values.push_back(at_nodes(frame, f, std::move(array_of(found, f).values)));
  return values;
}

void ImportedSeries::for_each_frame(const UseFrame& use) const {
  for (std::size_t j = 0; j < frames(); ++j) {
    FieldValues values = frame(j);
    use(j, values);
  }
}

void ImportedSeries::leave_loose_nodes() {
  std::vector<std::int32_t> number(mesh_.points.size(), -1);
  for (const std::int64_t corner : mesh_.connectivity) number[corner] = 0;
  loose_ = static_cast<std::size_t>(std::count(number.begin(), number.end(), -1));
  if (loose_ == 0 || loose_ == number.size()) {
    loose_ = 0;
    return;
  }
  for (std::size_t i = 0; i < number.size(); ++i)
    if (number[i] == 0) {
      number[i] = static_cast<std::int32_t>(kept_.size());
      kept_.push_back(static_cast<std::int32_t>(i));
    }
  for (std::int64_t& corner : mesh_.connectivity) corner = number[corner];
  mesh_.points.resize(kept_.size());
  for (std::size_t i = 0; i < kept_.size(); ++i) mesh_.points[i] = mesh_as_read_.points[kept_[i]];
}

void ImportedSeries::weld(const std::vector<std::int32_t>& number) {
  CLEFT_CHECK(number.size(), ==, mesh_.points.size());
  std::vector<std::int32_t> kept(
      static_cast<std::size_t>(*std::max_element(number.begin(), number.end())) + 1, -1);
  for (std::size_t i = number.size(); i-- > 0;)
    kept[number[i]] = kept_.empty() ? static_cast<std::int32_t>(i) : kept_[i];
  kept_ = std::move(kept);
  mesh_.points.resize(kept_.size());
  for (std::size_t i = 0; i < kept_.size(); ++i) mesh_.points[i] = mesh_as_read_.points[kept_[i]];
  for (std::int64_t& corner : mesh_.connectivity) corner = number[corner];
}

}  // namespace cleft
