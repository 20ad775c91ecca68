// The vertices that move as means of others: of the ends of an edge, or of the ring around them.
#include <algorithm>

#include "base/error.h"
#include "explorer/guard/guard_search.h"
#include "explorer/guard/mean_value.h"

namespace cleft {

namespace {

/// The height of a sliver over its longest edge at most.
constexpr double sliver = 0.2;
/// Of the displacements of its corners: a sliver that little of them turns over is tied even if it is sound
/// whenever it is looked at, unless it then always keeps this part of its area: it moves as what is around
/// it.
constexpr double delicate = 0.01, unbent = 0.75;
/// How often the vertices that means move are found anew, and how many may hang together.
constexpr int mean_rounds = 6;
constexpr std::size_t most_together = 150;
/// Of the largest opening, twice the largest displacement: by as much those differ at most that are joined,
/// with the cuts complete.
constexpr double most_joined = 0.04;

}  // namespace

/// Inside of the skin: its ring is closed.
bool GuardSearch::is_free(int n) const {
  const int v = vertex_[n];
  if (leader_[n] >= 0) return false;
  try {
    return mesh_.vertex(v).kind == VertexKind::skin && mesh_.fan(v).size() == around_[n].size() &&
           !mesh_.on_boundary(v) && !mesh_.on_wound(v);
  } catch (const InputError&) {  // its triangles are no ring
    return false;
  }
}

std::vector<GuardSearch::Part> GuardSearch::mean_of_ring(int n) const {
  const int v = vertex_[n];
  std::vector<int> ring;
  std::vector<Vec3> places;
  for (const int t : mesh_.skin_fan(v)) {
    const CutMesh::Triangle& triangle = mesh_.triangle(t);
    ring.push_back(triangle.vertex[(triangle.corner(v) + 1) % 3]);
    places.push_back(mesh_.position(ring.back()));
  }
  const std::vector<double> weights = mean_value_weights(mesh_.position(v), places);
  std::vector<Part> parts;
  for (std::size_t i = 0; i < ring.size(); ++i) parts.push_back({number_[ring[i]], weights[i]});
  return parts;
}

/// The vertex of a sliver between the ends of its longest edge moves as that edge does there; one on a lip
/// only where the sliver is not sound with the cuts complete: a lip opens less than the edges beside it tell,
/// and for a moment displacements are reduced. Whether it is newly so.
bool GuardSearch::tie(int triangle, std::vector<int>& group) {
  const auto corner = corners(triangle);
  int middle = 0;
  double longest = 0;
  for (int i = 0; i < 3; ++i) {
    const double length = norm(mesh_.position(corner[(i + 1) % 3]) - mesh_.position(corner[(i + 2) % 3]));
    if (length > longest) longest = length, middle = i;
  }
  const int v = corner[middle], a = corner[(middle + 1) % 3], b = corner[(middle + 2) % 3], n = number_[v];
  const Vec3 along = mesh_.position(b) - mesh_.position(a), from = mesh_.position(v) - mesh_.position(a);
  const VertexKind kind = mesh_.vertex(v).kind;
  if (n < 0 || in_group_[n] || leader_[n] >= 0 || norm(cross(along, from)) > sliver * longest * longest ||
      !(is_free(n) ||
        ((kind == VertexKind::left_lip || kind == VertexKind::right_lip) && offends_for_good(triangle))))
    return false;
  const double part = dot(from, along) / squared_norm(along);
  tie_[n] = {{number_[a], 1 - part}, {number_[b], part}};
  in_group_[n] = true;
  group.push_back(n);
  return true;
}

/// The vertices of offending triangles, and where all of these are in it, their neighbours.
bool GuardSearch::grow(std::vector<int>& group) {
  bool grown = false;
  const auto add = [&](int n) {
    if (n < 0 || in_group_[n] || !is_free(n)) return;
    in_group_[n] = grown = true;
    group.push_back(n);
  };
  for (const int one : offending_) {
    if (one < 0) continue;  // lips
    if (tie(one, group)) {
      grown = true;
      continue;
    }
    const std::size_t size = group.size();
    const auto corner = corners(one);
    for (const int v : corner) {
      const int n = number_[v];
      if (n >= 0 && !tie_[n].empty() && is_free(n)) tie_[n].clear(), grown = true;
      add(n);
    }
    if (group.size() > size) continue;
    for (const int v : corner)
      if (number_[v] >= 0 && in_group_[number_[v]])
        for (const Neighbor& next : next_[number_[v]]) add(next.number);
  }
  return grown;
}

/// The corners of a triangle that is not sound with the cuts complete, excused or not, move as one of them
/// does, if they move nearly alike: those of a triangle that is small against what displacements differ by,
/// as next to crossings, where its corners are on lips. Whether any are newly joined.
bool GuardSearch::join() {
  double largest = 0;
  for (const Vec3& d : own_) largest = std::max(largest, norm(d));
  const auto apart = [&](int a, int b) {
    double most = 0;
    for (std::size_t k = 0; k < times(); ++k)
      if (lasting_[k]) most = std::max(most, norm(own(a, k) - own(b, k)));
    return most;
  };
  std::sort(doubtful_.begin(), doubtful_.end());
  doubtful_.erase(std::unique(doubtful_.begin(), doubtful_.end()), doubtful_.end());
  bool joined = false;
  for (const int one : doubtful_) {
    if (one < 0) continue;
    const auto corner = corners(one);
    if (!offends_for_good(one) ||
        std::any_of(corner.begin(), corner.end(), [this](int v) { return number_[v] < 0; }))
      continue;
    std::vector<int> together;  // with those that corners are joined with
    for (const int v : corner) {
      const int n = number_[v];
      together.push_back(n);
      if (leader_[n] < 0) continue;
      for (std::size_t m = 0; m < leader_.size(); ++m)
        if (leader_[m] == leader_[n]) together.push_back(static_cast<int>(m));
    }
    int leader = -1;
    double least = most_joined * 2 * largest;
    for (const int candidate : together) {
      double most = 0;
      for (const int n : together) most = std::max(most, apart(n, candidate));
      if (most <= least) leader = candidate, least = most;
    }
    if (leader < 0) continue;
    for (const int n : together) {
      joined = joined || leader_[n] != leader;
      leader_[n] = leader;
    }
  }
  return joined;
}

/// All others begin anew.
void GuardSearch::move_joined() {
  for (auto& mean : mean_) mean.clear();
  for (auto& tie : tie_) tie.clear();
  in_group_.assign(in_group_.size(), false);
  for (std::size_t n = 0; n < leader_.size(); ++n)
    if (leader_[n] >= 0 && leader_[n] != static_cast<int>(n)) mean_[n].push_back({leader_[n], 1});
  renew(all_numbers());
  check_all();
}

/// Whether a triangle ever loses much of its area, or tears.
bool GuardSearch::bends(int triangle) const {
  for (std::size_t k = 0; k < times(); ++k) {
    const std::array<Vec3, 3> now = moved(triangle, k);
    if (left_of(triangle, now) < unbent || is_torn(triangle, now)) return true;
  }
  return false;
}

/// Slivers so flat that they turn over whenever displacements bend.
void GuardSearch::find_delicate() {
  std::vector<double> largest(vertex_.size());  // squared
  for (std::size_t n = 0; n < vertex_.size(); ++n)
    for (std::size_t k = 0; k < times(); ++k)
      largest[n] = std::max(largest[n], squared_norm(own(static_cast<int>(n), k)));
  for (std::size_t n = 0; n < around_.size(); ++n)
    for (const int one : around_[n])
      if (one >= 0 && harmless_[one] < delicate * delicate * largest[n] && bends(one))
        delicate_.push_back(one);
  std::sort(delicate_.begin(), delicate_.end());
  delicate_.erase(std::unique(delicate_.begin(), delicate_.end()), delicate_.end());
}

void GuardSearch::spread_means() {
  std::vector<int> group;
  for (const int one : delicate_) tie(one, group);
  if (!group.empty()) move_as_means(group);
  for (int round = 0; round < mean_rounds && !offending_.empty(); ++round) {
    if (!grow(group)) return;
    move_as_means(group);
  }
}

/// The vertices of the group move as their means.
void GuardSearch::move_as_means(const std::vector<int>& group) {
  // Those hang together that are parts of each other's means.
  std::vector<std::vector<Part>> means(vertex_.size());
  std::vector<std::vector<int>> hangs_on(vertex_.size());
  for (const int n : group) {
    means[n] = tie_[n].empty() ? mean_of_ring(n) : tie_[n];
    for (const Part& p : means[n])
      if (p.number >= 0 && in_group_[p.number])
        hangs_on[n].push_back(p.number), hangs_on[p.number].push_back(n);
  }
  std::vector<std::vector<Part>> before;
  before.reserve(group.size());
  for (const int n : group) before.push_back(mean_[n]);
  std::vector<bool> seen(vertex_.size());
  for (const int first : group) {
    if (seen[first]) continue;
    std::vector<int> together{first};
    seen[first] = true;
    for (std::size_t i = 0; i < together.size(); ++i)
      for (const int next : hangs_on[together[i]])
        if (!seen[next]) seen[next] = true, together.push_back(next);
    solve(together, means);
  }
  std::vector<int> changed;
  for (std::size_t i = 0; i < group.size(); ++i)
    if (mean_[group[i]] != before[i]) changed.push_back(group[i]);
  renew(changed);
  check(changed);
}

/// The displacements with which each of the group is the mean of its ring, from those beside the group; those
/// of a group that is too large are their own.
void GuardSearch::solve(const std::vector<int>& group, const std::vector<std::vector<Part>>& means) {
  for (const int n : group) mean_[n].clear();
  if (group.size() > most_together) return;
  std::vector<int> beside;
  for (const int n : group)
    for (const Part& p : means[n])
      if (p.number >= 0 && !in_group_[p.number]) beside.push_back(p.number);
  std::sort(beside.begin(), beside.end());
  beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
  const std::size_t m = group.size(), columns = m + beside.size();
  std::vector<double> a(m * columns);
  for (std::size_t i = 0; i < m; ++i) {
    a[i * columns + i] += 1;
    for (const auto& [n, part] : means[group[i]]) {
      if (n < 0) continue;  // it is at rest
      if (in_group_[n])
        a[i * columns + static_cast<std::size_t>(std::find(group.begin(), group.end(), n) - group.begin())] -=
            part;
      else
        a[i * columns + m +
          static_cast<std::size_t>(std::lower_bound(beside.begin(), beside.end(), n) - beside.begin())] +=
            part;
    }
  }
  if (!eliminate(a, m, columns)) return;
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t j = 0; j < beside.size(); ++j)
      if (const double part = a[i * columns + m + j]; part != 0)
        mean_[group[i]].push_back({leader_[beside[j]] < 0 ? beside[j] : leader_[beside[j]], part});
    if (mean_[group[i]].empty()) mean_[group[i]].push_back({group[i], 0});  // all around it is at rest
  }
}

}  // namespace cleft
