#include "explorer/incision/refine.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <vector>

#include "explorer/incision/incision_tolerances.h"

namespace cleft {

namespace {

using Limits = IncisionTolerances;

/// The longest edge; of equally long ones always the same, for both triangles.
int longest_edge(const CutMesh& mesh, int t) {
  const auto rank = [&](int i) {
    const int a = mesh.triangle(t).vertex[i], b = mesh.triangle(t).vertex[(i + 1) % 3];
    // Both triangles must compute the same length to the last bit: order the ends.
    const Vec3 d = mesh.position(std::max(a, b)) - mesh.position(std::min(a, b));
    return std::tuple(squared_norm(d), std::min(a, b), std::max(a, b));
  };
  int best = 0;
  for (int i = 1; i < 3; ++i)
    if (rank(i) > rank(best)) best = i;
  return best;
}

double edge_length(const CutMesh& mesh, int t, int i) {
  return norm(mesh.position(mesh.triangle(t).vertex[(i + 1) % 3]) -
              mesh.position(mesh.triangle(t).vertex[i]));
}

/// Splits the first edge on the way from t along ever longer edges that is the longest of both its triangles
/// (of walls, lips and the boundary, of the one). False where that edge is not manifold.
bool split_on_the_way(CutMesh& mesh, int t, int parted[2]) {
  int edge = longest_edge(mesh, t), neighbor = mesh.triangle(t).neighbor[edge];
  while (mesh.is_skin(neighbor) && mesh.triangle(neighbor).neighbor[longest_edge(mesh, neighbor)] != t) {
    t = neighbor;
    edge = longest_edge(mesh, t);
    neighbor = mesh.triangle(t).neighbor[edge];
  }
  if (neighbor == CutMesh::non_manifold) return false;
  const int a = mesh.triangle(t).vertex[edge], b = mesh.triangle(t).vertex[(edge + 1) % 3];
  mesh.split_edge(t, edge, 0.5 * (mesh.position(std::min(a, b)) + mesh.position(std::max(a, b))));
  parted[0] = t, parted[1] = neighbor;
  return true;
}

/// How long edges may be near a piece of the path.
class EdgeLimit {
 public:
  EdgeLimit(const CutMesh& mesh, const ScalpelPath& path, double from, double to, double height,
            double max_edge, double band)
      : mesh_(mesh), max_edge_(max_edge), band_(band) {
    constexpr int samples = Limits::refinement_samples;
    for (int i = 0; i <= samples; ++i) {
      const PathFrame frame = path.at(from + (to - from) * i / samples);
      line_.push_back(frame.position + height * frame.outward);
    }
    low_ = high_ = line_[0];
    for (const Vec3& p : line_)
      for (int k = 0; k < 3; ++k) low_[k] = std::min(low_[k], p[k]), high_[k] = std::max(high_[k], p[k]);
  }

  bool too_long(int t) const {
    const double longest = edge_length(mesh_, t, longest_edge(mesh_, t));
    if (longest <= max_edge_) return false;
    const Vec3 middle = middle_of(t);
    double outside = 0;  // of the path's box: a cheap lower bound of the distance
    for (int k = 0; k < 3; ++k) outside = std::max({outside, low_[k] - middle[k], middle[k] - high_[k]});
    const auto limit = [&](double distance) {
      return max_edge_ *
             (1 + Limits::refinement_growth * std::max(0.0, (distance - longest / 2) / band_ - 1));
    };
    return longest > limit(outside) && longest > limit(distance_to_line(middle));
  }

  bool near(int t) const {
    return distance_to_line(middle_of(t)) <
           Limits::refinement_search * band_ + edge_length(mesh_, t, longest_edge(mesh_, t));
  }

 private:
  Vec3 middle_of(int t) const {
    const auto& corners = mesh_.triangle(t).vertex;
    return 1. / 3 * (mesh_.position(corners[0]) + mesh_.position(corners[1]) + mesh_.position(corners[2]));
  }
  double distance_to_line(const Vec3& x) const {
    double least = squared_norm(x - line_[0]);
    for (const Vec3& p : line_) least = std::min(least, squared_norm(x - p));
    return std::sqrt(least);
  }

  const CutMesh& mesh_;
  double max_edge_, band_;
  std::vector<Vec3> line_;
  Vec3 low_, high_;
};

void bisect_all(CutMesh& mesh, const EdgeLimit& limit, std::vector<int> work) {
  while (!work.empty()) {
    const int t = work.back();
    if (!limit.too_long(t)) {
      work.pop_back();
      continue;
    }
    const int first_new = static_cast<int>(mesh.triangles().size());
    int parted[2];
    if (!split_on_the_way(mesh, t, parted)) {  // leave it as it is
      work.pop_back();
      continue;
    }
    for (const int other : parted)
      if (other != t && mesh.is_skin(other)) work.push_back(other);
    for (int n = first_new; n < static_cast<int>(mesh.triangles().size()); ++n)
      if (mesh.is_skin(n)) work.push_back(n);
  }
}

}  // namespace

void refine_along(CutMesh& mesh, const ScalpelPath& path, double height, double max_edge, double band) {
  const EdgeLimit limit(mesh, path, 0, path.length(), height, max_edge, band);
  std::vector<int> work;
  for (int t = 0; t < static_cast<int>(mesh.triangles().size()); ++t)
    if (mesh.is_skin(t) && limit.too_long(t)) work.push_back(t);
  bisect_all(mesh, limit, std::move(work));
}

void refine_along(CutMesh& mesh, const ScalpelPath& path, double from, double to,
                  const std::vector<int>& seeds, double height, double max_edge, double band) {
  const EdgeLimit limit(mesh, path, from, to, height, max_edge, band);
  std::vector<int> near, work;
  std::set<int> known;
  const auto take = [&](int t) {
    if (mesh.is_skin(t) && limit.near(t) && known.insert(t).second) near.push_back(t);
  };
  for (const int t : seeds) take(t);
  for (std::size_t k = 0; k < near.size(); ++k)
    for (const int other : mesh.triangle(near[k]).neighbor) take(other);
  for (const int t : near)
    if (limit.too_long(t)) work.push_back(t);
  bisect_all(mesh, limit, std::move(work));
}

double longest_edge_length(const CutMesh& mesh, int t) { return edge_length(mesh, t, longest_edge(mesh, t)); }

bool bisect(CutMesh& mesh, int t) {
  for (int parted[2]; split_on_the_way(mesh, t, parted);)
    if (parted[0] == t || parted[1] == t) return true;
  return false;
}

}  // namespace cleft
