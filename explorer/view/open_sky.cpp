#include "explorer/view/open_sky.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <tuple>

namespace cleft {

namespace {

using Triangles = std::vector<std::array<int, 3>>;
constexpr float nothing = -std::numeric_limits<float>::infinity();

/// Even over the sphere: the golden spiral.
Vec3 direction(int i, int of) {
  const double z = 1 - (2 * i + 1.) / of, radius = std::sqrt(1 - z * z),
               angle = i * M_PI * (3 - std::sqrt(5.));
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// The surface as it is seen from far away: in each pixel how far towards the eye it reaches.
class DepthMap {
 public:
  DepthMap(const std::vector<Vec3>& points, const std::vector<int>& used, const Vec3& eye)
      : depth_(static_cast<std::size_t>(sky_pixels) * sky_pixels, nothing), seen_(points.size()) {
    const Vec3 side = normalized(cross(std::abs(eye.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, eye)),
               up = cross(eye, side);
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    for (const int p : used) {
      const double at[] = {dot(points[p], side), dot(points[p], up)};
      for (int k = 0; k < 2; ++k) low[k] = std::min(low[k], at[k]), high[k] = std::max(high[k], at[k]);
      seen_[p] = {static_cast<float>(at[0]), static_cast<float>(at[1]),
                  static_cast<float>(dot(points[p], eye))};
    }
    pixel_ = std::max({high[0] - low[0], high[1] - low[1], 1e-12}) / (sky_pixels - 2);
    for (const int p : used)
      for (std::size_t k = 0; k < 2; ++k)
        seen_[p][k] = static_cast<float>((seen_[p][k] - low[k]) / pixel_ + 0.5);
  }

  double pixel() const { return pixel_; }

  void draw(const std::array<int, 3>& t) {
    const auto &a = seen_[t[0]], &b = seen_[t[1]], &c = seen_[t[2]];
    const float twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if (twice == 0) return;
    const float by_x = ((b[2] - a[2]) * (c[1] - a[1]) - (c[2] - a[2]) * (b[1] - a[1])) / twice,
                by_y = ((c[2] - a[2]) * (b[0] - a[0]) - (b[2] - a[2]) * (c[0] - a[0])) / twice;
    const int last = sky_pixels - 1;
    const int y0 = std::max(0, static_cast<int>(std::ceil(std::min({a[1], b[1], c[1]})))),
              y1 = std::min(last, static_cast<int>(std::max({a[1], b[1], c[1]})));
    for (int y = y0; y <= y1; ++y) {
      const auto [left, right] = span(a, b, c, static_cast<float>(y));
      const int x0 = std::max(0, static_cast<int>(std::ceil(left))),
                x1 = std::min(last, static_cast<int>(std::floor(right)));
      float* row = &depth_[static_cast<std::size_t>(y) * sky_pixels];
      for (int x = x0; x <= x1; ++x)
        row[x] = std::max(
            row[x], a[2] + by_x * (static_cast<float>(x) - a[0]) + by_y * (static_cast<float>(y) - a[1]));
    }
  }

  /// The part of a point's surroundings of a pixel that nothing hides which is more than `margin` nearer.
  float seen(int point, float margin) const {
    const auto& p = seen_[point];
    const int x = std::clamp(static_cast<int>(p[0]), 0, sky_pixels - 2),
              y = std::clamp(static_cast<int>(p[1]), 0, sky_pixels - 2);
    const float u = p[0] - static_cast<float>(x), v = p[1] - static_cast<float>(y);
    const auto free = [&](int i, int j) {
      return depth_[static_cast<std::size_t>(y + j) * sky_pixels + static_cast<std::size_t>(x + i)] <=
                     p[2] + margin
                 ? 1.F
                 : 0.F;
    };
    return (1 - v) * ((1 - u) * free(0, 0) + u * free(1, 0)) + v * ((1 - u) * free(0, 1) + u * free(1, 1));
  }

 private:
  using Seen = std::array<float, 3>;
  /// Where a row crosses a triangle.
  static std::pair<float, float> span(const Seen& a, const Seen& b, const Seen& c, float y) {
    float left = std::numeric_limits<float>::infinity(), right = -left;
    for (const auto& [p, q] : {std::pair{&a, &b}, {&b, &c}, {&c, &a}}) {
      const float from = (*p)[1], to = (*q)[1];
      if ((from < y && to < y) || (from > y && to > y)) continue;
      const float x = from == to ? (*p)[0] : (*p)[0] + (y - from) / (to - from) * ((*q)[0] - (*p)[0]);
      left = std::min(left, x), right = std::max(right, x);
      if (from == to) left = std::min(left, (*q)[0]), right = std::max(right, (*q)[0]);
    }
    return {left, right};
  }

  std::vector<float> depth_;
  std::vector<Seen> seen_;
  double pixel_;
};

std::vector<Vec3> normals_of(const std::vector<Vec3>& points, const Triangles& triangles) {
  std::vector<Vec3> normals(points.size());
  for (const auto& [a, b, c] : triangles) {
    const Vec3 area = cross(points[b] - points[a], points[c] - points[a]);
    normals[a] += area, normals[b] += area, normals[c] += area;
  }
  for (Vec3& n : normals)
    if (squared_norm(n) > 0) n = normalized(n);
  return normals;
}

/// Each with the mean of its neighbours, which takes away what single directions leave.
void smooth(std::vector<float>& values, const Triangles& triangles) {
  std::vector<float> sum(values), weight(values.size(), 1);
  for (const auto& t : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        if (i != j) sum[t[i]] += 0.5F * values[t[j]], weight[t[i]] += 0.5F;
  for (std::size_t p = 0; p < values.size(); ++p) values[p] = sum[p] / weight[p];
}

Triangles skin_of(const WoundSurface& surface) {
  Triangles skin;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (surface.regions[t] == Region::skin) skin.push_back(surface.triangles[t]);
  return skin;
}

}  // namespace

std::vector<float> open_sky(const std::vector<Vec3>& points, const Triangles& triangles) {
  const std::vector<Vec3> normals = normals_of(points, triangles);
  std::vector<int> used;
  for (std::size_t p = 0; p < points.size(); ++p)
    if (squared_norm(normals[p]) > 0) used.push_back(static_cast<int>(p));
  std::vector<float> light(points.size(), 0), whole(points.size(), 0);
  constexpr double work = 6e6;  // triangles that are drawn: a second at most
  const int count =
      std::clamp(static_cast<int>(work / std::max(1., double(triangles.size()))), 20, sky_directions);
  for (int i = 0; i < count && !used.empty(); ++i) {
    const Vec3 eye = direction(i, count);
    DepthMap map(points, used, eye);
    for (const std::array<int, 3>& t : triangles) map.draw(t);
    for (const int p : used) {
      const double cosine = dot(normals[p], eye);
      if (cosine <= 0.05) continue;
      // Within a pixel the surface itself rises by its slope; a little more, since it is curved.
      const double slope = std::sqrt(1 - std::min(1., cosine * cosine)) / cosine;
      light[p] += static_cast<float>(cosine) *
                  map.seen(p, static_cast<float>(map.pixel() * (1 + 2 * std::min(slope, 8.))));
      whole[p] += static_cast<float>(cosine);
    }
  }
  for (std::size_t p = 0; p < points.size(); ++p) light[p] = whole[p] > 0 ? light[p] / whole[p] : 1;
  smooth(light, triangles);
  return light;
}

SurfaceLight::SurfaceLight(const WoundSurface& surface, const SurfaceLight* before) {
  if (!before || !take_sky(surface, *before)) {
    sky_ = open_sky(surface.points, skin_of(surface));
    original_.assign(surface.points.begin(), surface.points.begin() + surface.original_points);
  }
  find_lips(surface);
  walls_ = near_lips(surface, true, HUGE_VAL);
  rims_ = near_lips(surface, false, far);
}

bool SurfaceLight::take_sky(const WoundSurface& surface, const SurfaceLight& before) {
  if (before.original_.size() != static_cast<std::size_t>(surface.original_points) ||
      surface.points.size() < before.original_.size() ||
      !std::equal(before.original_.begin(), before.original_.end(), surface.points.begin()))
    return false;
  original_ = before.original_;
  sky_.assign(before.sky_.begin(), before.sky_.begin() + surface.original_points);
  fill_added(surface);
  return true;
}

/// From the points with a known sky to their neighbours, ring by ring.
void SurfaceLight::fill_added(const WoundSurface& surface) {
  const std::size_t known = sky_.size();
  sky_.resize(surface.points.size(), -1);
  Triangles open;
  for (const auto& t : skin_of(surface))
    if (std::any_of(t.begin(), t.end(), [&](int p) { return static_cast<std::size_t>(p) >= known; }))
      open.push_back(t);
  std::vector<float> sum, count;
  for (bool found = true; found;) {
    found = false;
    sum.assign(sky_.size(), 0), count.assign(sky_.size(), 0);
    for (const auto& t : open)
      for (const int p : t)
        for (const int q : t)
          if (sky_[p] < 0 && sky_[q] >= 0) sum[p] += sky_[q], count[p] += 1, found = true;
    for (std::size_t p = known; p < sky_.size(); ++p)
      if (count[p] > 0) sky_[p] = sum[p] / count[p];
  }
  for (float& sky : sky_)
    if (sky < 0) sky = 1;  // of walls: theirs is that of their lip
}

/// Points of skin and walls that share their place at rest with another one.
void SurfaceLight::find_lips(const WoundSurface& surface) {
  std::vector<int> parts(surface.points.size(), 0);  // 1: skin, 2: walls, 3: both
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (const int p : surface.triangles[t]) parts[p] |= surface.regions[t] == Region::skin ? 1 : 2;
  std::map<std::tuple<double, double, double>, std::vector<int>> places;
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (const Vec3& x = surface.points[p]; parts[p] == 3)
      places[{x.x, x.y, x.z}].push_back(static_cast<int>(p));
  for (const auto& [place, points] : places)
    for (const int p : points)
      for (const int q : points)
        if (p != q || points.size() == 1) lips_.push_back({p, q});
}

/// Points of walls or skin with the nearest of the lips that they lead to, up to `most` from it.
std::vector<SurfaceLight::Near> SurfaceLight::near_lips(const WoundSurface& surface, bool walls,
                                                        double most) const {
  std::vector<std::vector<int>> neighbours(surface.points.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if ((surface.regions[t] != Region::skin) != walls) continue;
    const auto& [a, b, c] = surface.triangles[t];
    for (const auto& [p, q] : {std::pair{a, b}, {b, c}, {c, a}})
      neighbours[p].push_back(q), neighbours[q].push_back(p);
  }
  std::vector<int> lip(surface.points.size(), -1);
  std::deque<int> next;
  for (std::size_t i = 0; i < lips_.size(); ++i)
    lip[lips_[i].point] = static_cast<int>(i), next.push_back(lips_[i].point);
  const auto distance = [&](int p, int of) {
    return norm(surface.points[p] - surface.points[lips_[of].point]);
  };
  for (; !next.empty(); next.pop_front()) {
    const int from = lip[next.front()];
    for (const int p : neighbours[next.front()]) {
      const double away = distance(p, from);
      if (away > most || (lip[p] >= 0 && distance(p, lip[p]) <= away)) continue;
      lip[p] = from;
      next.push_back(p);
    }
  }
  std::vector<Near> near;
  for (std::size_t p = 0; p < lip.size(); ++p)
    if (const int i = static_cast<int>(p); lip[p] >= 0 && (!walls || distance(i, lip[p]) > 0))
      near.push_back({i, lip[p], distance(i, lip[p])});
  return near;
}

void SurfaceLight::at(const std::vector<Vec3>& points, std::vector<Light>& out) const {
  constexpr double parted = 0.3;  // mm between lips that are wet all over
  out.resize(sky_.size());
  for (std::size_t p = 0; p < sky_.size(); ++p) out[p] = {sky_[p], far};
  const auto width = [&](int lip) { return norm(points[lips_[lip].point] - points[lips_[lip].across]); };
  for (const Near& rim : rims_) {
    const double wet = std::min(1., width(rim.lip) / parted);
    out[rim.point].dry = static_cast<float>(far - wet * (far - rim.distance));
  }
  for (const Near& wall : walls_) {
    const double slot = 1 - wall.distance / std::hypot(wall.distance, width(wall.lip));
    out[wall.point] = {sky_[lips_[wall.lip].point] * static_cast<float>(slot), 0};
  }
}

}  // namespace cleft
