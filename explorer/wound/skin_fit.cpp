#include "explorer/wound/skin_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "explorer/incision/path_trace.h"
#include "explorer/wound/small_fit.h"

namespace cleft {

namespace {

/// Vertices that a fit takes, where its distance may grow for them, and at least; by how much the distance
/// grows, and how far.
constexpr std::size_t enough_vertices = 14, least_vertices = 6;
constexpr double growth = 1.25, farthest = 4;
/// The skin around a place ends where its triangles turn away from the normal further than this cosine: it
/// does not reach the far side of a fold.
constexpr double turned_away = 0.4;
/// How often the skin is fitted: the normal and the heights' fourth order come from the fit before.
constexpr int fits = 3;

double falling(double part) { return std::max(0., 1 - part * part); }

}  // namespace

SkinFit::SkinFit(const Incision& incision, double scale, double from, double to)
    : incision_(incision), mesh_(incision.mesh()), scale_(scale) {
  const auto& labels = incision.surroundings().labels();
  for (std::size_t v = 0; v < labels.size(); ++v)
    if (const double s = labels[v].s * scale; labels[v].reached && s >= from && s <= to)
      beside_.emplace_back(s, static_cast<int>(v));
  std::sort(beside_.begin(), beside_.end());
  passed_.resize(mesh_.triangles().size()), seen_.resize(mesh_.vertices().size());
}

/// Of a line through the triangles' normals, so that it is no other at the skin's rim.
Vec3 SkinFit::mean_normal(double s, double distance) const {
  const auto& stations = incision_.surroundings().stations();
  const auto next = [&](double place) {
    return std::partition_point(stations.begin(), stations.end(),
                                [&](const auto& at) { return at.s * scale_ < place; });
  };
  SmallFit<2> fit[3];
  Vec3 mean;
  for (auto at = next(s - distance); at != next(s + distance); ++at) {
    const double from = (at->s * scale_ - s) / distance, weight = falling(from) * at->length;
    for (int i = 0; i < 3; ++i) fit[i].add({1, from}, at->normal[i], weight);
    mean += weight * at->normal;
  }
  const Vec3 blade = incision_.path().at(s / scale_).outward;
  Vec3 line;
  for (int i = 0; i < 3; ++i)
    if (const auto found = fit[i].solve()) line[i] = (*found)[0];
  for (const Vec3& one : {line, mean})
    if (dot(one, blade) > 0) return normalized(one);
  const auto nearest = next(s);
  return stations.empty() ? blade : nearest == stations.end() ? stations.back().normal : nearest->normal;
}

/// From the triangle `seed` on, over those that do not turn away from `outward`.
std::vector<Vec3> SkinFit::vertices(const Vec3& center, const Vec3& outward, int seed, double distance) {
  const auto is_new = [this](int& search) { return std::exchange(search, searches_) != searches_; };
  ++searches_;
  passed_[seed] = searches_;
  std::vector<int> found;
  std::vector<int> next{seed};
  while (!next.empty()) {
    const int t = next.back();
    next.pop_back();
    bool within = t == seed;
    for (const int v : mesh_.triangle(t).vertex) {
      const CutMesh::Vertex& vertex = mesh_.vertex(v);
      if (norm(scale_ * vertex.original - center) >= distance) continue;
      within = true;
      // What was added has parents, and so have copies of a vertex that a cut has parted.
      if (vertex.parents[0] < 0 && is_new(seen_[v])) found.push_back(v);
    }
    if (!within) continue;
    for (int i = 0; i < 3; ++i) {
      const int other = skin_across(mesh_, t, i);
      if (other < 0 || passed_[other] == searches_) continue;
      const auto& [p, q, r] = mesh_.triangle(other).vertex;
      const Vec3 area = cross(mesh_.position(q) - mesh_.position(p), mesh_.position(r) - mesh_.position(p));
      if (dot(area, outward) <= turned_away * norm(area)) continue;
      passed_[other] = searches_;
      next.push_back(other);
    }
  }
  std::sort(found.begin(), found.end());  // sums do not depend on the way over the triangles
  std::vector<Vec3> places;
  places.reserve(found.size());
  for (const int v : found) places.push_back(scale_ * mesh_.vertex(v).original);
  return places;
}

/// A triangle of the skin where the path passes it: of the nearest vertex that is reached there.
int SkinFit::triangle_at(double s, const Vec3& center, double distance) const {
  int nearest = -1;
  for (double within = distance; nearest < 0 && within <= farthest * distance; within *= 2) {
    double least = std::numeric_limits<double>::infinity();
    for (auto at = std::lower_bound(beside_.begin(), beside_.end(), std::pair(s - within, -1));
         at != beside_.end() && at->first <= s + within; ++at) {
      const double way = norm(scale_ * mesh_.vertex(at->second).original - center) +
                         incision_.surroundings().labels()[at->second].detour * scale_;
      if (way < least) least = way, nearest = at->second;
    }
  }
  const int t = nearest < 0 ? -1 : mesh_.vertex(nearest).triangle;
  return mesh_.is_skin(t) ? t : -1;
}

/// Heights in units of the distance. Their fourth order is that of a sphere or a cylinder, from the fit
/// before: z = a + b x + c y + (A x^2 + 2 B x y + C y^2 + F (z - a)^2) / 2.
std::optional<SkinFit::Shape> SkinFit::at(double s, const Vec3& outward, const Vec3& along, double distance) {
  const auto& stations = incision_.surroundings().stations();
  const auto station = std::partition_point(stations.begin(), stations.end(),
                                            [&](const auto& piece) { return piece.s * scale_ < s; });
  const double height = station == stations.end() ? 0 : station->height;
  const PathFrame frame = incision_.path().at(s / scale_);
  const Vec3 center = scale_ * (frame.position + height * frame.outward);
  const int seed = triangle_at(s, center, distance);
  if (seed < 0) return std::nullopt;
  const double asked = distance;
  std::vector<Vec3> around = vertices(center, outward, seed, distance);
  for (const double most = farthest * distance; around.size() < enough_vertices && distance < most;)
    around = vertices(center, outward, seed, distance *= growth);
  if (around.size() < least_vertices) return std::nullopt;
  Shape shape{outward, 0, 0, 0};
  double level = 0, fourth = 0;
  for (int k = 0; k < fits; ++k) {
    const Vec3 w = shape.outward, u = normalized(along - dot(along, w) * w), v = cross(w, u);
    SmallFit<6> fit;
    for (const Vec3& one : around) {
      const Vec3 from = 1 / distance * (one - center);
      const double x = dot(from, u), y = dot(from, v), z = dot(from, w);
      fit.add({1, x, y, x * x / 2, x * y, y * y / 2}, z - fourth * (z - level) * (z - level) / 2,
              falling(norm(from)));
    }
    const auto found = fit.solve();
    if (!found) return std::nullopt;
    const auto& [a, b, c, xx, xy, yy] = *found;
    shape = {normalized(w - b * u - c * v), -xx / distance, -yy / distance, -xy / distance};
    shape.uneven = asked * fit.residual(*found);
    level = a;
    const double trace = xx + yy, determinant = xx * yy - xy * xy, square = trace * trace - 2 * determinant;
    fourth = square > 0 ? trace * (trace * trace - 3 * determinant) / square : 0;
  }
  return shape;
}

}  // namespace cleft
