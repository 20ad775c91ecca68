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
#include "encoder/import/break_surface.h"
#include "encoder/import/release.h"
#include "solver/snapshot/break_front.h"

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

/// The map of a break that is curved, has a round front, or has parts of the body above it. `at_front`: nodes
/// there.
std::optional<BreakMap> map_of(const Snapshot& s, const Break& found, const std::vector<bool>& at_front,
                               double rounding, bool is_flat) {
  BreakPlaces places{{}, {}, range_of(s.points, 0), range_of(s.points, 2), rounding};
  for (std::size_t p = 0; p < found.pairs.size(); ++p)
    if (found.first_frame[p] < static_cast<std::int32_t>(s.frames()))
      places.pairs.push_back(s.points[found.pairs[p][0]]);
  for (std::size_t n = 0; n < at_front.size(); ++n)
    if (at_front[n]) places.front.push_back(s.points[n]);
  if (places.pairs.empty()) return {};
  const auto round = is_flat ? std::nullopt : round_front(places);
  const double top = is_flat ? 0 : places.w.back;
  if (!found.curved && !round && top <= rounding) return {};
  double farthest = 0;
  return (found.curved ? surface_through(places, farthest) : BreakMap()).with(top, round);
}

/// Canonical coordinates of the nodes; those of the break are exactly on v = 0.
std::vector<Vec3> canonical_points(const Snapshot& s, const BreakMap& map, const Break& found,
                                   const std::vector<bool>& at_front) {
  std::vector<Vec3> places;
  for (const Vec3& p : s.points) places.push_back(map.canonical(p));
  for (const NodePair& pair : found.pairs)
    for (const std::int32_t node : pair) places[node].y = 0;
  for (std::size_t n = 0; n < places.size(); ++n)
    if (at_front[n]) places[n].y = 0;
  return places;
}

/// A snapshot, and the canonical coordinates of its nodes where they are not their places.
struct Placed {
  Snapshot snapshot;
  std::vector<Vec3> canonical;
};

Placed snapshot_of(const Series& series, const Break& found, const Placement& placement, bool is_flat) {
  const SourceMesh& mesh = series.mesh();
  Placed result;
  Snapshot& s = result.snapshot;
  s.points = placed_points(mesh, placement, found.plane.has_value() && !found.curved, is_flat);
  s.cell_types = mesh.cell_types, s.cell_offsets = mesh.cell_offsets, s.connectivity = mesh.connectivity;
  for (const double t : series.times()) s.times.push_back(t - series.times().front());
  for (std::size_t j = 1; j < s.times.size(); ++j)
    if (!(s.times[j - 1] < s.times[j]))
      throw InputError(series.path() + ": times " + shortest(series.times()[j - 1]) + " and " +
                       shortest(series.times()[j]) +
                       " are the same, counted from the first; give more digits");
  s.source =
      SnapshotSource{std::filesystem::path(series.path()).filename().string(), placement.origin,
                     placement.axes, series.times().front(), found.plane ? text_of(*found.plane) : "none"};
  for (const SeriesField& field : series.fields())
    s.source->fields.push_back(field.source + ":" + field.name);
  std::vector<std::int8_t> sides(s.points.size(), 0);
  for (std::size_t p = 0; p < found.pairs.size(); ++p)
    if (found.first_frame[p] < static_cast<std::int32_t>(s.frames()))
      sides[found.pairs[p][0]] = -1, sides[found.pairs[p][1]] = 1;
  const std::vector<bool> at_front = nodes_at_front(s.cell_offsets, s.connectivity, found.pairs, sides);
  if (const auto map = map_of(s, found, at_front, in_plane(mesh), is_flat)) {
    s.source->break_map = map->numbers();
    s.coordinates = true;
    result.canonical = canonical_points(s, *map, found, at_front);
    std::swap(s.points, result.canonical);
    fill_cut(s, found);
    std::swap(s.points, result.canonical);
  } else {
    fill_cut(s, found);
  }
  return result;
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

/// Where the break is no plane: coordinates of the cut, and their directions, which are those of (u, v, w).
void write_coordinates(SnapshotWriter& writer, const std::vector<Vec3>& canonical) {
  std::vector<double> places, frames;
  for (const Vec3& p : canonical) {
    places.insert(places.end(), {p.x, p.y, p.z});
    frames.insert(frames.end(), {1, 0, 0, 0, 1, 0, 0, 0, 1});
  }
  writer.write_array(canonical_array, 0, places);
  writer.write_array(frame_array, 0, frames);
}

void write_frames(const Series& series, const Placement& placement, const std::string& out,
                  const std::vector<Vec3>& canonical, ImportReport& report,
                  const std::function<void(const std::string&)>& progress) {
  Snapshot& s = report.snapshot;
  s.smallest_gap.assign(s.frames(), 0);
  std::vector<SnapshotArray> arrays = report.arrays;
  if (s.coordinates) arrays.insert(arrays.end(), {canonical_array, frame_array});
  SnapshotWriter writer(out, s, arrays);
  if (s.coordinates) write_coordinates(writer, canonical);
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
  std::optional<OpenAt> open_at;
  if (o.open_at) open_at = parse_open_at(*o.open_at);
  auto parameters = parse_parameters(o.parameters);
  Series series(o.series, parse_fields(o.fields));
  refuse_to_overwrite(o.out, series.files());
  { const OutputFile probe(o.out); }

  const std::optional<Vec3> flat = flatness(series.mesh());
  const std::string frames = std::to_string(series.frames());
  Break found = find_break(series, o.break_plane, open_at, flat, [&](std::size_t j) {
    progress("looking at frame " + std::to_string(j + 1) + " of " + frames);
  });
  const Placement placement =
      found.plane ? placement_on(found, series.mesh(), flat) : placement_in_box(series.mesh(), o.box, flat);

  ImportReport report;
  Placed placed = snapshot_of(series, found, placement, flat.has_value());
  report.snapshot = std::move(placed.snapshot);
  report.snapshot.parameters = std::move(parameters);
  for (const SeriesField& field : series.fields())
    if (field.name == "displacement")
      report.has_displacement = true;
    else
      report.arrays.push_back({field.name, static_cast<std::size_t>(field.components), true});
  write_frames(series, placement, o.out, placed.canonical, report, progress);
  report.notes = std::move(found.notes);
  if (series.loose_nodes() > 0)
    report.notes.push_back(std::to_string(series.loose_nodes()) +
                           " nodes belong to no cell, and were left out");
  if (series.farthest_moved() > same_place(series.mesh()))
    report.notes.push_back("the nodes move by up to " + shortest(series.farthest_moved()) +
                           " between frames; their places in the first frame were taken");
  return report;
}

}  // namespace cleft
