#include "explorer/body/skin_coordinates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/text.h"
#include "explorer/body/extrusion.h"
#include "explorer/body/surface_index.h"
#include "explorer/incision/incision.h"

namespace cleft {

namespace {

/// Skin beside the path may be reached around an end of it, as the other face of an organ's edge is.
Side side_of(Side reached_from, const PathCoordinates& at, const ScalpelPath& path) {
  if (reached_from != Side::both || at.s < 0 || at.s > path.length()) return reached_from;
  return at.v < 0 ? Side::left : Side::right;
}

/// How many times as far skin ahead of an end is from it as its coordinates along the tangent plane tell,
/// where it bends away.
double times_as_far(double beyond, const PathCoordinates& at) {
  const double seen = std::hypot(beyond, at.v);
  return beyond != 0 && seen > 0 ? std::hypot(seen, at.w) / seen : 1;
}

}  // namespace

SkinCoordinates coordinates_on(const SurfaceMesh& skin, const ScalpelPath& path,
                               const std::set<int>& on_cut) {
  CutMesh mesh(skin);
  IncisionOptions options;
  options.max_edge = 0, options.reach = std::numeric_limits<double>::infinity();
  const Incision incision(mesh, path, options);
  const auto& labels = incision.surroundings().labels();
  const std::vector<Vec3> normals = normals_of(skin);
  const SurfaceIndex index(skin);
  SkinCoordinates result;
  for (int p = 0; p < static_cast<int>(skin.points.size()); ++p) {
    const PathCoordinates at = path.coordinates(skin.points[p]);
    const double beyond = std::min(at.s, 0.) + std::max(at.s - path.length(), 0.);
    const double times = times_as_far(beyond, at);
    double across = times * at.v;
    if (on_cut.contains(p))
      across = 0;
    else if (p < static_cast<int>(labels.size()) && labels[p].reached)
      if (const auto side = side_of(labels[p].side, at, path); side != Side::both)
        across = Surroundings::across(at.v, labels[p].detour, side);
    const double along = (across == 0 ? at.s : path.steady_place(skin.points[p], at)) + (times - 1) * beyond;
    result.canonical.push_back({along - path.length() / 2, across, 0});
    const PathFrame frame = path.at(along);
    const SurfacePlace place = index.nearest(frame.position);
    const auto& corners = skin.triangles[place.triangle];
    Vec3 normal;
    for (int i = 0; i < 3; ++i) normal += place.weights[i] * normals[corners[i]];
    normal = normalized(normal);
    const Vec3 forward = normalized(frame.along - dot(frame.along, normal) * normal);
    result.frames.push_back({forward, cross(normal, forward), normal});
  }
  return result;
}

std::vector<Vec3> directions_within(const SurfaceMesh& skin, const ScalpelPath& path,
                                    std::vector<TensionLine> lines, const std::vector<bool>& on_a_cut) {
  const Vec3 chord = path.at(path.length()).position - path.at(0).position;
  const Vec3 usual = norm(chord) < 1e-3 * path.length() ? path.at(0).along : chord;
  if (lines.empty()) lines = {{{}, usual}};
  const Vec3 forward = lines.size() == 1 ? lines.front().direction : usual;
  std::vector<Vec3> directions;
  for (const auto& t : skin.triangles) {
    const Vec3 a = skin.points[t[0]], b = skin.points[t[1]], c = skin.points[t[2]];
    const Vec3 first = normalized(b - a), normal = normalized(cross(b - a, c - a));
    const auto twice = twice_angle_of(lines, {first, cross(normal, first)}, (1. / 3) * (a + b + c));
    if (!twice && std::any_of(t.begin(), t.end(), [&](int p) { return on_a_cut[p]; }))
      throw InputError(
          lines.size() == 1
              ? "the direction of the tension, " + place_text(forward) +
                    ", is perpendicular to the skin at " + place_text(a) +
                    " mm, on a cut; give one within the skin (--direction)"
              : "the lines of tension are perpendicular to the skin at " + place_text(a) +
                    " mm, on a cut, or cancel each other there; give a line within the skin there");
    Vec3 within = first;  // seen from its end any direction is as good
    if (twice && lines.size() == 1)
      within = normalized(forward - dot(forward, normal) * normal);
    else if (twice)
      within = std::cos(*twice / 2) * first + std::sin(*twice / 2) * cross(normal, first);
    directions.push_back(dot(within, forward) < 0 ? -within : within);
  }
  return directions;
}

ScalpelPath stretched(const ScalpelPath& path, double from, double to, double size) {
  std::vector<ScalpelPath::Point> points;
  const auto add = [&](double s) {
    const PathFrame at = path.at(s);
    points.push_back({at.position, at.outward, path.depth(std::clamp(s, 0., path.length()))});
  };
  const double first = std::max(0., from), last = std::min(path.length(), to);
  if (from < 0) add(from);
  const int pieces = std::clamp(static_cast<int>(std::ceil(8 * (last - first) / size)), 32, 4000);
  for (int i = 0; i <= pieces; ++i) add(first + (last - first) * i / pieces);
  if (to > path.length()) add(to);
  return ScalpelPath(points);
}

std::string place_text(const Vec3& p) {
  const auto rounded = [](double x) { return shortest(std::round(1e3 * x) / 1e3); };
  return "(" + rounded(p.x) + ", " + rounded(p.y) + ", " + rounded(p.z) + ")";
}

}  // namespace cleft
