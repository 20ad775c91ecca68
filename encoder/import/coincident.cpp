#include "encoder/import/coincident.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <unordered_map>

#include "encoder/import/jumps.h"
#include "solver/snapshot/cell_types.h"

namespace cleft {

namespace {

std::uint64_t key(const Vec3& place, double size) {
  std::uint64_t hash = 0;
  for (int i = 0; i < 3; ++i) {
    const auto cell = static_cast<std::int64_t>(std::floor(place[i] / size));
    hash = (hash ^ static_cast<std::uint64_t>(cell)) * 0x9E3779B97F4A7C15u;
    hash ^= hash >> 29;
  }
  return hash;
}

}  // namespace

Groups coincident_groups(const std::vector<Vec3>& points, double tolerance) {
  const double size = 16 * tolerance;  // most points are far from the borders of their cell
  std::unordered_map<std::uint64_t, std::vector<std::int32_t>> cells;
  cells.reserve(points.size());
  Sets sets(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<std::uint64_t> near;
    for (const double x : {-tolerance, tolerance})
      for (const double y : {-tolerance, tolerance})
        for (const double z : {-tolerance, tolerance}) near.push_back(key(points[i] + Vec3{x, y, z}, size));
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (const std::uint64_t cell : near)
      if (const auto found = cells.find(cell); found != cells.end())
        for (const std::int32_t other : found->second)
          if (norm(points[other] - points[i]) <= tolerance) sets.join(static_cast<std::int32_t>(i), other);
    cells[key(points[i], size)].push_back(static_cast<std::int32_t>(i));
  }

  std::vector<std::vector<std::int32_t>> members(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    members[sets.root(static_cast<std::int32_t>(i))].push_back(static_cast<std::int32_t>(i));
  Groups groups;
  for (auto& group : members)
    if (group.size() > 1) groups.push_back(std::move(group));
  return groups;
}

bool FacesInBreak::take(std::size_t cell, const std::vector<double>& distances, double near) {
  constexpr double flat = 0.05, apart = 1e-3;  // of the cell's extent
  if (!is_flat_type(mesh_.cell_types[cell]) || distances.size() < 3) return false;
  const auto* first = mesh_.connectivity.data() + mesh_.cell_offsets[cell];
  const auto* last = mesh_.connectivity.data() + mesh_.cell_offsets[cell + 1];
  double farthest = 0, extent = 0;
  for (const double distance : distances) farthest = std::max(farthest, std::abs(distance));
  for (const auto* i = first; i != last; ++i)
    extent = std::max(extent, norm(mesh_.points[*i] - mesh_.points[*first]));
  if (farthest > std::min(near, flat * extent)) return false;
  for (const auto* i = first; i != last; ++i)
    for (const auto* k = first; k != i; ++k)
      if (norm(mesh_.points[*i] - mesh_.points[*k]) <= apart * extent) return false;  // between the lips
  std::optional<std::int32_t> one;
  for (const auto* i = first; i != last; ++i) {
    if (!doubled_[*i]) continue;
    if (one) together_.join(*one, static_cast<std::int32_t>(*i));
    one = static_cast<std::int32_t>(*i);
  }
  if (one) cells_.push_back(cell);
  return one.has_value();
}

void FacesInBreak::spread(std::vector<double>& side) {
  std::vector<double> of_all(side.size());
  const auto for_each_node = [&](const auto& use) {
    for (const std::size_t c : cells_)
      for (auto i = mesh_.cell_offsets[c]; i < mesh_.cell_offsets[c + 1]; ++i)
        if (const auto node = static_cast<std::int32_t>(mesh_.connectivity[i]); doubled_[node])
          use(node, together_.root(node));
  };
  for_each_node([&](std::int32_t node, std::int32_t root) { of_all[root] += side[node]; });
  for_each_node([&](std::int32_t node, std::int32_t root) {
    if (side[node] == 0 && of_all[root] != 0) side[node] = of_all[root] < 0 ? -1 : 1;
  });
}

bool is_unwelded(const SourceMesh& mesh, const Groups& groups) {
  std::size_t in_company = 0;
  for (const auto& group : groups) in_company += group.size();
  // A slit through one row of elements on either side doubles half of the nodes.
  return static_cast<double>(in_company) > 0.6 * static_cast<double>(mesh.points.size());
}

std::size_t weld(ImportedSeries& series, const Groups& groups) {
  const std::vector<double> tolerance = rounding_of(series);
  const std::size_t points = series.mesh().points.size();
  std::vector<std::int32_t> stands_for(points);  // the first node that agreed so far
  std::iota(stands_for.begin(), stands_for.end(), 0);
  for (const auto& group : groups)
    for (const std::int32_t node : group) stands_for[node] = group.front();

  series.for_each_frame([&](std::size_t, const FieldValues& values) {
    const auto agree = [&](std::int32_t a, std::int32_t b) {
      for (std::size_t f = 0; f < values.size(); ++f)
        if (jump_of(values[f], series.fields()[f].components, a, b) > tolerance[f]) return false;
      return true;
    };
    for (const auto& group : groups) {
      // Those that stood for one node, and now differ from it, follow the first of them with their values.
      std::vector<std::pair<std::int32_t, std::int32_t>> classes;  // before, and now
      for (const std::int32_t node : group) {
        std::int32_t& mine = stands_for[node];
        const auto found = std::find_if(classes.begin(), classes.end(), [&](const auto& c) {
          return c.first == mine && agree(c.second, node);
        });
        const std::int32_t before = mine;
        mine = found == classes.end() ? node : found->second;
        if (mine == node) classes.emplace_back(before, node);
      }
    }
  });

  std::vector<std::int32_t> number(points);
  std::int32_t next = 0;
  for (std::size_t i = 0; i < points; ++i)
    number[i] = stands_for[i] == static_cast<std::int32_t>(i) ? next++ : number[stands_for[i]];
  series.weld(number);
  return points - static_cast<std::size_t>(next);
}

}  // namespace cleft
