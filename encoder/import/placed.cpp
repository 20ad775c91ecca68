#include "encoder/import/placed.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "encoder/import/boundary.h"
#include "encoder/import/break_surface.h"
#include "encoder/import/components.h"
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

/// The map of a break that is curved or continued by curved faces, has a round front, or has parts of the
/// body above it. `at_front`: nodes there.
std::optional<BreakMap> map_of(const Snapshot& s, const SourceMesh& mesh, const Break& found,
                               const std::vector<bool>& at_front, double rounding, bool is_flat) {
  BreakPlaces places{{}, {}, {}, range_of(s.points, 0), range_of(s.points, 2), rounding};
  std::vector<NodePair> parting;
  for (std::size_t p = 0; p < found.pairs.size(); ++p)
    if (found.first_frame[p] < static_cast<std::int32_t>(s.frames()))
      parting.push_back(found.pairs[p]), places.pairs.push_back(s.points[found.pairs[p][0]]);
  for (std::size_t n = 0; n < at_front.size(); ++n)
    if (at_front[n]) places.front.push_back(s.points[n]);
  if (places.pairs.empty()) return {};
  const auto round = is_flat ? std::nullopt : round_front(places);
  const double top = is_flat ? 0 : places.w.back;
  if (found.junctions.empty())
    for (const std::int32_t n : nodes_continuing_lips(mesh, parting, at_front, found.plane->normal))
      places.beyond.push_back(s.points[n]);
  const bool curved = found.curved || std::any_of(places.beyond.begin(), places.beyond.end(),
                                                  [&](const Vec3& p) { return std::abs(p.y) > rounding; });
  if (!curved && !round && top <= rounding) return {};
  double farthest = 0;
  return (curved ? surface_through(places, farthest) : BreakMap()).with(top, round);
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

/// Nodes without a partner that are in the plane of the break, or nearly so, and have cells on one side of it
/// alone, are on a face that is flush with it, as in a corner where it begins: they are put beside it.
void put_beside(std::vector<Vec3>& places, const Snapshot& s, const Break& found,
                const std::vector<bool>& at_front) {
  constexpr double near = 0.05, least = 1e-7;  // of the extent of cells, and of all, across
  std::vector<double> extent(places.size()), side(places.size());
  std::vector<char> whole(places.size(), 0);
  const Interval across = range_of(places, 1);
  const double beside = least * (across.back - across.front);
  for (std::size_t c = 0; c < s.cell_types.size(); ++c) {
    const std::span corners(s.connectivity.begin() + s.cell_offsets[c],
                            s.connectivity.begin() + s.cell_offsets[c + 1]);
    double sum = 0, farthest = 0;
    for (const std::int64_t n : corners)
      sum += places[n].y, farthest = std::max(farthest, std::abs(places[n].y));
    if (farthest == 0) continue;  // an interface element, between the two sides
    for (const std::int64_t n : corners) {
      const double other = std::exchange(side[n], sum);
      whole[n] = whole[n] || sum == 0 || std::signbit(sum) != std::signbit(other == 0 ? sum : other);
      extent[n] = std::max(extent[n], farthest);
    }
  }
  for (const NodePair& pair : found.pairs)
    for (const std::int32_t node : pair) whole[node] = 1;
  for (std::size_t n = 0; n < places.size(); ++n) {
    double& v = places[n].y;
    if (!whole[n] && !at_front[n] && std::abs(v) <= near * extent[n] &&
        (v * side[n] <= 0 || std::abs(v) < beside))
      v = std::copysign(beside, side[n]);
  }
}

std::vector<bool> front_of(const Snapshot& s, const Break& found) {
  std::vector<std::int8_t> sides(s.points.size(), 0);
  for (std::size_t p = 0; p < found.pairs.size(); ++p)
    if (found.first_frame[p] < static_cast<std::int32_t>(s.frames()))
      sides[found.pairs[p][0]] = -1, sides[found.pairs[p][1]] = 1;
  return nodes_at_front(s.cell_offsets, s.connectivity, found.pairs, sides);
}

}  // namespace

Placed snapshot_of(const ImportedSeries& series, const SourceMesh& mesh, const Break& found,
                   const Placement& placement, bool is_flat, const Placed* given, const BeyondArm& beyond) {
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
    s.source->fields.push_back(recorded_source(field.source, field.arrays) + ":" + field.name +
                               (field.unit.empty() ? "" : "[" + field.unit + "]"));
  const std::vector<bool> at_front = front_of(s, found);
  result.map = given ? given->map : map_of(s, mesh, found, at_front, in_plane(mesh), is_flat);
  if (result.map) {
    s.source->break_map = result.map->numbers();
    s.coordinates = true;
    result.canonical = canonical_points(s, *result.map, found, at_front);
    put_beside(result.canonical, s, found, at_front);
    std::swap(s.points, result.canonical);
    fill_cut(s, found, beyond);
    std::swap(s.points, result.canonical);
  } else {
    if (found.plane) put_beside(s.points, s, found, at_front);
    fill_cut(s, found, beyond);
  }
  return result;
}

}  // namespace cleft
