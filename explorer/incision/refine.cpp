#include "explorer/incision/refine.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <tuple>
#include <vector>

#include "base/error.h"
#include "base/text.h"
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
/// (of walls, lips and the boundary, of the one). False where that edge is not manifold, or has no middle.
bool split_on_the_way(CutMesh& mesh, int t, int parted[2]) {
  int edge = longest_edge(mesh, t), neighbor = mesh.triangle(t).neighbor[edge];
  while (mesh.is_skin(neighbor) && mesh.triangle(neighbor).neighbor[longest_edge(mesh, neighbor)] != t) {
    t = neighbor;
    edge = longest_edge(mesh, t);
    neighbor = mesh.triangle(t).neighbor[edge];
  }
  if (neighbor == CutMesh::non_manifold) return false;
  const int a = mesh.triangle(t).vertex[edge], b = mesh.triangle(t).vertex[(edge + 1) % 3];
  const Vec3 middle = 0.5 * (mesh.position(std::min(a, b)) + mesh.position(std::max(a, b)));
  if (middle == mesh.position(a) || middle == mesh.position(b)) return false;
  mesh.split_edge(t, edge, middle);
  parted[0] = t, parted[1] = neighbor;
  return true;
}

/// How long edges may be near a piece of the path.
class EdgeLimit {
 public:
  EdgeLimit(const CutMesh& mesh, const ScalpelPath& path, double from, double to, const Refinement& how)
      : mesh_(mesh), max_edge_(how.max_edge), band_(how.band) {
    constexpr int samples = Limits::refinement_samples;
    for (int i = 0; i <= samples; ++i) {
      const PathFrame frame = path.at(from + (to - from) * i / samples);
      line_.push_back(frame.position + how.height * frame.outward);
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
      const double beyond = std::max(0.0, (distance - longest / 2) / band_ - 1);
      if (!transition_ && beyond > 0) return std::numeric_limits<double>::infinity();
      return max_edge_ * (1 + Limits::refinement_growth * beyond);
    };
    return longest > limit(outside) && longest > limit(distance_to_line(middle));
  }

  bool near(int t) const {
    return distance_to_line(middle_of(t)) <
           Limits::refinement_search * band_ + edge_length(mesh_, t, longest_edge(mesh_, t));
  }

  /// Edges may be so many times longer, and beyond the band of any length.
  void loosen(double factor) {
    max_edge_ *= factor;
    transition_ = false;
  }

  /// Throws InputError where the corners of t are not known to a small part of the longest edge.
  void check_rounding(int t) const {
    for (const int v : mesh_.triangle(t).vertex) {
      const Vec3& p = mesh_.position(v);
      const double rounding =
          std::numeric_limits<double>::epsilon() * std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
      if (rounding > Limits::refinement_rounding * max_edge_)
        throw InputError("the mesh's vertex at " + place_of(p) + " is of a triangle near the path, which " +
                         "is to have edges of " + shortest(max_edge_) + "; so far away coordinates are " +
                         "rounded to " + shortest(rounding) + ". Remove the vertex, or move the mesh and " +
                         "the path to where coordinates are small");
    }
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
  bool transition_ = true;  ///< whether the limit grows gradually beyond the band
  std::vector<Vec3> line_;
  Vec3 low_, high_;
};

/// False where it would take more than `most` new triangles; the mesh is then left as it is.
bool bisect_all(CutMesh& mesh, const EdgeLimit& limit, std::vector<int> work, std::size_t most) {
  for (const std::size_t before = mesh.triangles().size(); !work.empty();) {
    if (mesh.triangles().size() - before > most) return false;
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
  return true;
}

/// How many equilateral triangles cover the strip about a piece of the path. Throws InputError where there
/// are too many.
std::size_t triangles_of_strip(double length, const Refinement& how) {
  const double strip = 2 * how.band * (length + 2 * how.band), of_unit_edge = std::sqrt(3.) / 4,
               count = strip / (of_unit_edge * how.max_edge * how.max_edge);
  if (!(count <= Limits::most_triangles_of_strip))
    throw InputError("edges of at most " + shortest(how.max_edge) + " near the path would take about " +
                     shortest(std::round(count)) + " triangles; the least edge possible along a path of " +
                     "length " + shortest(length) + " is " +
                     shortest(std::sqrt(strip / (of_unit_edge * Limits::most_triangles_of_strip))));
  return static_cast<std::size_t>(count);
}

/// Splits what is too long. `find` gives the triangles that are, by a limit.
void refine(CutMesh& mesh, EdgeLimit limit, std::size_t strip, const Refinement& how,
            const std::function<std::vector<int>(const EdgeLimit&)>& find) {
  const std::size_t most = Limits::refined_besides + Limits::refined_per_triangle * strip;
  std::vector<int> work = find(limit);
  for (const int t : work) limit.check_rounding(t);
  const CutMesh::Checkpoint before = mesh.checkpoint();
  for (bool first = true; !bisect_all(mesh, limit, work, most); first = false) {
    mesh.roll_back(before);
    if (!first && !how.may_coarsen)
      throw InputError("edges of at most " + shortest(how.max_edge) + " near the path would take more than " +
                       std::to_string(most) + " triangles, because the mesh has slivers there, such as at " +
                       place_of(mesh.position(mesh.triangle(work.back()).vertex[0])) +
                       "; permit longer edges, or leave the triangles as they are (0)");
    limit.loosen(first ? 1 : Limits::coarser_edges);
    work = find(limit);
  }
}

}  // namespace

void refine_along(CutMesh& mesh, const ScalpelPath& path, const Refinement& how) {
  const std::size_t strip = triangles_of_strip(path.length(), how);
  refine(mesh, EdgeLimit(mesh, path, 0, path.length(), how), strip, how, [&](const EdgeLimit& limit) {
    std::vector<int> work;
    for (int t = 0; t < static_cast<int>(mesh.triangles().size()); ++t)
      if (mesh.is_skin(t) && limit.too_long(t)) work.push_back(t);
    return work;
  });
}

void refine_along(CutMesh& mesh, const ScalpelPath& path, double from, double to,
                  const std::vector<int>& seeds, const Refinement& how) {
  const std::size_t strip = triangles_of_strip(to - from, how);
  const EdgeLimit limit(mesh, path, from, to, how);
  std::vector<int> near;
  std::set<int> known;
  const auto take = [&](int t) {
    if (mesh.is_skin(t) && limit.near(t) && known.insert(t).second) near.push_back(t);
  };
  for (const int t : seeds) take(t);
  for (std::size_t k = 0; k < near.size(); ++k)
    for (const int other : mesh.triangle(near[k]).neighbor) take(other);
  refine(mesh, limit, strip, how, [&](const EdgeLimit& now) {
    std::vector<int> work;
    for (const int t : near)
      if (now.too_long(t)) work.push_back(t);
    return work;
  });
}

double longest_edge_length(const CutMesh& mesh, int t) { return edge_length(mesh, t, longest_edge(mesh, t)); }

bool bisect(CutMesh& mesh, int t) {
  for (int parted[2]; split_on_the_way(mesh, t, parted);)
    if (parted[0] == t || parted[1] == t) return true;
  return false;
}

}  // namespace cleft
