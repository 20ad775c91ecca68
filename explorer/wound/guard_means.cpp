// The vertices that move as means of others: of the ends of an edge, or of the ring around them.
#include <algorithm>

#include "base/error.h"
#include "explorer/wound/guard_search.h"
#include "explorer/wound/mean_value.h"

namespace cleft {

namespace {

/// The height of a sliver over its longest edge at most.
constexpr double sliver = 0.2;
/// How often the vertices that means move are found anew, and how many may hang together.
constexpr int mean_rounds = 6;
constexpr std::size_t most_together = 150;

}  // namespace

/// Inside of the skin: its ring is closed.
bool GuardSearch::is_free(int n) const {
  const int v = vertex_[n];
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

/// The vertex of a sliver between the ends of its longest edge moves as that edge does there. Whether it is
/// newly so.
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
  if (n < 0 || in_group_[n] || norm(cross(along, from)) > sliver * longest * longest ||
      (kind != VertexKind::left_lip && kind != VertexKind::right_lip && !is_free(n)))
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
        for (const int next : next_[number_[v]]) add(next);
  }
  return grown;
}

void GuardSearch::spread_means() {
  std::vector<int> group;
  for (int round = 0; round < mean_rounds && !offending_.empty(); ++round) {
    if (!grow(group)) return;
    std::vector<bool> seen(vertex_.size());
    for (const int first : group) {
      if (seen[first]) continue;
      std::vector<int> together{first};
      seen[first] = true;
      for (std::size_t i = 0; i < together.size(); ++i)
        for (const int next : next_[together[i]])
          if (in_group_[next] && !seen[next]) seen[next] = true, together.push_back(next);
      solve(together);
    }
    renew(group);
    check(group);
  }
}

/// The displacements with which each of the group is the mean of its ring, from those beside the group; those
/// of a group that is too large are their own.
void GuardSearch::solve(const std::vector<int>& group) {
  for (const int n : group) mean_[n].clear();
  if (group.size() > most_together) return;
  std::vector<int> beside;
  std::vector<std::vector<Part>> means;
  for (const int n : group) {
    means.push_back(tie_[n].empty() ? mean_of_ring(n) : tie_[n]);
    for (const Part& p : means.back())
      if (p.number >= 0 && !in_group_[p.number]) beside.push_back(p.number);
  }
  std::sort(beside.begin(), beside.end());
  beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
  const std::size_t m = group.size(), columns = m + beside.size();
  std::vector<double> a(m * columns);
  for (std::size_t i = 0; i < m; ++i) {
    a[i * columns + i] += 1;
    for (const auto& [n, part] : means[i]) {
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
      if (const double part = a[i * columns + m + j]; part != 0) mean_[group[i]].push_back({beside[j], part});
    if (mean_[group[i]].empty()) mean_[group[i]].push_back({group[i], 0});  // all around it is at rest
  }
}

}  // namespace cleft
