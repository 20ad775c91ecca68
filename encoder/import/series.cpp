#include "encoder/import/series.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

namespace {

constexpr std::uint8_t polyhedron = 42;  // VTK_POLYHEDRON

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

void check_cells(const std::string& where, const SourceMesh& mesh) {
  const auto refuse = [&](const std::string& what) { throw InputError(where + ": " + what); };
  const auto& offsets = mesh.cell_offsets;
  if (mesh.cell_types.empty()) refuse("holds no cells");
  if (offsets.size() != mesh.cell_types.size() + 1 || offsets.front() != 0 ||
      !std::is_sorted(offsets.begin(), offsets.end()) ||
      offsets.back() != static_cast<std::int64_t>(mesh.connectivity.size()))
    refuse("is damaged: the cells' offsets do not agree with their types and corners");
  for (std::size_t c = 0; c < mesh.cell_types.size(); ++c) {
    if (mesh.cell_types[c] == polyhedron)
      refuse("cell " + std::to_string(c) +
             " is a polyhedron, which snapshots cannot hold; split it into tetrahedra first");
    if (offsets[c + 1] == offsets[c]) refuse("cell " + std::to_string(c) + " has no corners");
  }
  const auto points = static_cast<std::int64_t>(mesh.points.size());
  for (const std::int64_t i : mesh.connectivity)
    if (i < 0 || i >= points)
      refuse("is damaged: a cell names node " + std::to_string(i) + " of " + std::to_string(points));
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    if (!std::isfinite(squared_norm(mesh.points[i])))
      refuse("the place of node " + std::to_string(i) + " is not finite");
}

template <class T>
std::string listed(const std::vector<T>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

}  // namespace

double diagonal(const std::vector<Vec3>& points) {
  if (points.empty()) return 0;
  Vec3 low = points.front(), high = low;
  for (const Vec3& p : points)
    for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
  return norm(high - low);
}

std::unique_ptr<FrameFiles> open_series(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending == ".pvd") return open_pvd(path);
  if (ending == ".vtkhdf" || ending == ".hdf" || ending == ".h5" || ending == ".hdf5")
    return open_vtkhdf(path);
  if (ending == ".vtu")
    throw InputError(path +
                     ": is one frame, and a series needs 2; list the .vtu files with their times in a .pvd");
  throw InputError(path + ": unknown ending '" + ending + "' of a series; known are .pvd .vtkhdf");
}

std::vector<SeriesField> parse_fields(const std::vector<std::string>& texts) {
  std::vector<SeriesField> fields;
  std::set<std::string> names;
  for (const std::string& text : texts) {
    const auto colon = text.rfind(':');
    SeriesField field{text.substr(0, colon), colon == std::string::npos ? text : text.substr(colon + 1)};
    if (field.source.empty() || field.name.empty())
      throw InputError("--field '" + text + "': expected SOURCE or SOURCE:NAME");
    if (field.name.find('/') != std::string::npos || field.name == ".")
      throw InputError("--field '" + text + "': '" + field.name +
                       "' cannot be a dataset's name; give another, as SOURCE:NAME");
    if (!names.insert(field.name).second) throw InputError("--field: '" + field.name + "' is named twice");
    fields.push_back(field);
  }
  if (fields.empty()) throw InputError("--field: name at least one field, like displacement");
  return fields;
}

Series::Series(const std::string& path, const std::vector<SeriesField>& fields)
    : path_(path), files_(open_series(path)), fields_(fields) {
  check_times(path, times());
  const SourceFrame first = files_->read(0, sources_there(0));
  check_cells(where(0), first.mesh);
  describe_fields(first);
  mesh_ = mesh_as_read_ = first.mesh;
  leave_loose_nodes();
}

std::string Series::where(std::size_t frame) const {
  return files_->file(frame) + " (frame " + std::to_string(frame) + ")";
}

std::vector<std::string> Series::sources_there(std::size_t frame) const {
  const std::vector<std::string> there = files_->point_arrays(frame);
  const auto among = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  std::vector<std::string> sources;
  for (const SeriesField& field : fields_) {
    if (!among(there, field.source))
      throw InputError("--field " + field.source + ": " + where(frame) +
                       " holds no such array of the points" +
                       (among(files_->cell_arrays(frame), field.source)
                            ? ", but one of the cells; turn it into one of the points first"
                            : did_you_mean(field.source, there)) +
                       "; there are: " + listed(there));
    sources.push_back(field.source);
  }
  return sources;
}

void Series::describe_fields(const SourceFrame& first) {
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    SeriesField& field = fields_[f];
    field.components = first.arrays[f].components, field.single = first.arrays[f].single;
    const std::string has = "--field " + field.source + ": has " + std::to_string(field.components) +
                            " components in " + where(0);
    if (field.components != 1 && field.components != 3 && field.components != 6)
      throw InputError(has + "; only scalars (1), vectors (3) and symmetric tensors (6) can be imported");
    if (field.name == "displacement" && field.components != 3)
      throw InputError(has + "; a displacement has 3");
  }
}

void Series::check_mesh(std::size_t frame, const SourceMesh& mesh) const {
  const auto refuse = [&](const std::string& what) {
    throw InputError(where(frame) + ": " + what + "; all frames must have the mesh of the first");
  };
  if (mesh.points.size() != mesh_as_read_.points.size())
    refuse("has " + std::to_string(mesh.points.size()) + " nodes, where frame 0 has " +
           std::to_string(mesh_as_read_.points.size()));
  if (!same_cells(mesh, mesh_as_read_)) refuse("has other cells than frame 0");
}

void Series::check_values(std::size_t frame, const SourceFrame& found) const {
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    const SourceArray& array = found.arrays[f];
    const std::size_t components = fields_[f].components;
    if (array.components != fields_[f].components ||
        array.values.size() != components * found.mesh.points.size())
      throw InputError(where(frame) + ": field '" + fields_[f].source +
                       "' has another shape than in frame 0");
    const auto is_bad = [](double value) { return !std::isfinite(value); };
    auto bad = array.values.end();
    if (kept_.empty()) bad = std::find_if(array.values.begin(), array.values.end(), is_bad);
    for (const std::int32_t node : kept_) {
      const auto first = array.values.begin() + static_cast<std::ptrdiff_t>(components) * node,
                 last = first + static_cast<std::ptrdiff_t>(components);
      if (const auto found_bad = std::find_if(first, last, is_bad);
          found_bad != last && bad == array.values.end())
        bad = found_bad;
    }
    if (bad != array.values.end())
      throw InputError(where(frame) + ": field '" + fields_[f].source + "' is " +
                       (std::isnan(*bad) ? "not a number" : "infinite") + " at node " +
                       std::to_string(static_cast<std::size_t>(bad - array.values.begin()) / components) +
                       " (counted from 0)");
  }
}

FieldValues Series::frame(std::size_t frame) const {
  SourceFrame found = files_->read(frame, sources_there(frame));
  check_mesh(frame, found.mesh);
  check_values(frame, found);
  for (std::size_t i = 0; i < found.mesh.points.size(); ++i)
    farthest_moved_ = std::max(farthest_moved_, norm(found.mesh.points[i] - mesh_as_read_.points[i]));
  FieldValues values;
  for (SourceArray& array : found.arrays) {
    if (kept_.empty()) {
      values.push_back(std::move(array.values));
      continue;
    }
    auto& some = values.emplace_back();
    for (const std::int32_t node : kept_)
      for (int c = 0; c < array.components; ++c)
        some.push_back(
            array.values[static_cast<std::size_t>(node) * static_cast<std::size_t>(array.components) +
                         static_cast<std::size_t>(c)]);
  }
  return values;
}

void Series::leave_loose_nodes() {
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

void Series::weld(const std::vector<std::int32_t>& number) {
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
