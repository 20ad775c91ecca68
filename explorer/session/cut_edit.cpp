#include "explorer/session/cut_edit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/text.h"
#include "explorer/body/extrusion.h"

namespace cleft {

namespace {

constexpr double degree = std::numbers::pi / 180;

/// `x`, turned as the shortest way from the unit vector `from` to `to` turns.
Vec3 turned(const Vec3& x, const Vec3& from, const Vec3& to) {
  const double cosine = dot(from, to);
  const Vec3 axis = cross(from, to);
  if (cosine < -0.99) return to;  // no shortest way
  return cosine * x + cross(axis, x) + dot(axis, x) / (1 + cosine) * axis;
}

/// Arc lengths of the points, along straight lines.
std::vector<double> lengths_of(const CutState& cut) {
  std::vector<double> s(cut.points.size());
  for (std::size_t i = 1; i < s.size(); ++i)
    s[i] = s[i - 1] + norm(cut.points[i].position - cut.points[i - 1].position);
  return s;
}

void move_points(CutState& cut, const CutEdit& edit, const Skin& skin) {
  const CutState before = cut;
  const std::vector<double> s = lengths_of(before);
  for (const auto& [point, to] : edit.moves) {
    const int count = static_cast<int>(before.points.size());
    if (point < 0 || point >= count)
      throw InputError(formatted("point %d: the cut has the points 1 to %d", point + 1, count));
    const Vec3& from = before.points[static_cast<std::size_t>(point)].position;
    const Skin::Place there = skin.nearest(to, skin.nearest(from).outward, CutEdit::farthest);
    if (const double off = norm(there.position - to); !(off <= CutEdit::farthest))
      throw InputError(formatted("the skin is %.3g mm away from %g,%g,%g", off, to.x, to.y, to.z));
    for (std::size_t i = 0; i < before.points.size(); ++i) {
      const double way = std::abs(s[i] - s[static_cast<std::size_t>(point)]);
      const bool itself = static_cast<int>(i) == point;
      const bool goes_itself = std::any_of(edit.moves.begin(), edit.moves.end(), [i](const auto& move) {
        return move.point == static_cast<int>(i);
      });
      if (!itself && (goes_itself || !(way < edit.reach))) continue;
      const double part = itself ? 1 : std::pow(1 - std::pow(way / edit.reach, 2), 2);
      const Skin::Place old = skin.nearest(before.points[i].position);
      const Vec3 aim = cut.points[i].position + part * (there.position - from);
      const Skin::Place fresh = itself ? there : skin.nearest(aim, old.outward, 1 + norm(to - from));
      cut.points[i].position = fresh.position;
      cut.points[i].outward = turned(before.points[i].outward, old.outward, fresh.outward);
    }
  }
}

void deepen(CutState& cut, double depth) {
  double deepest = 0;
  for (const ScalpelPath::Point& p : cut.points) deepest = std::max(deepest, p.depth);
  for (ScalpelPath::Point& p : cut.points)
    p.depth = depth == 0 || deepest == 0 || p.depth <= 0 ? depth : p.depth / deepest * depth;
}

void lean(CutState& cut, double tilt, const Skin& skin) {
  const std::vector<ScalpelPath::Point> points = cut.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 outward = skin.nearest(points[i].position).outward;
    const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, points.size() - 1);
    const Vec3 across = cross(outward, points[after].position - points[before].position);
    if (!(norm(across) > 0)) continue;
    cut.points[i].outward = std::cos(tilt * degree) * outward - std::sin(tilt * degree) * normalized(across);
  }
}

}  // namespace

Skin::Skin(const SurfaceMesh& mesh) : index_(mesh), normals_(normals_of(mesh)) {}

Skin::Place Skin::place_of(const SurfacePlace& found) const {
  const auto& corners = index_.surface().triangles[static_cast<std::size_t>(found.triangle)];
  Vec3 outward;
  for (std::size_t i = 0; i < 3; ++i)
    outward += found.weights[i] * normals_[static_cast<std::size_t>(corners[i])];
  return {found.position, norm(outward) > 0 ? normalized(outward) : Vec3{0, 0, 1}};
}

Skin::Place Skin::nearest(const Vec3& x) const { return place_of(index_.nearest(x)); }

Skin::Place Skin::nearest(const Vec3& x, const Vec3& outward, double reach) const {
  const SurfacePlace found = index_.nearest(x, outward, reach);
  return place_of(found.triangle < 0 ? index_.nearest(x) : found);
}

CutState edited(const CutState& cut, const CutEdit& edit, const Skin& skin) {
  CutState result = cut;
  move_points(result, edit, skin);
  if (edit.depth) deepen(result, *edit.depth);
  if (edit.tilt) lean(result, *edit.tilt, skin);
  return result;
}

Vec3 CutHandles::Blade::direction() const {
  return std::cos(tilt * degree) * outward - std::sin(tilt * degree) * across;
}

CutHandles handles_of(const CutState& cut, double depth, const Skin& skin) {
  constexpr std::size_t few = 8;
  constexpr double apart = 10;  // mm, of handles on a path with many points
  constexpr int most = 7, places_of_line = 60;
  CutState deep = cut;
  for (ScalpelPath::Point& p : deep.points)
    if (p.depth <= 0) p.depth = depth;
  const ScalpelPath path(deep.points);
  const std::vector<double> s = lengths_of(cut);
  CutHandles handles;
  if (cut.points.size() <= few) {
    for (std::size_t i = 0; i < cut.points.size(); ++i) handles.points.push_back(static_cast<int>(i));
  } else {
    const int count = std::clamp(static_cast<int>(std::lround(s.back() / apart)) + 1, 3, most);
    handles.reach = s.back() / (count - 1);
    for (int k = 0; k < count; ++k) {
      const auto after = std::lower_bound(s.begin(), s.end(), k * handles.reach * (1 - 1e-9));
      handles.points.push_back(static_cast<int>(std::min(after, s.end() - 1) - s.begin()));
    }
  }
  handles.points.erase(std::unique(handles.points.begin(), handles.points.end()), handles.points.end());
  for (const int i : handles.points)
    handles.places.push_back(cut.points[static_cast<std::size_t>(i)].position);
  // Depth and tilt are between the two points in the middle.
  const std::size_t left = (handles.points.size() - 1) / 2 - (handles.points.size() % 2 == 1 ? 1 : 0);
  const double scale = path.length() / s.back();
  const double from = scale * s[static_cast<std::size_t>(handles.points[left])];
  const double to = scale * s[static_cast<std::size_t>(handles.points[left + 1])];
  const auto blade_at = [&](double place) {
    const PathFrame frame = path.at(place);
    CutHandles::Blade blade;
    blade.foot = frame.position, blade.along = frame.along;
    blade.outward = skin.nearest(frame.position).outward;
    const Vec3 across = cross(blade.outward, frame.along);
    blade.across = norm(across) > 0 ? normalized(across) : frame.across;
    blade.depth = path.depth(place);
    blade.tilt = std::atan2(-dot(frame.outward, blade.across), dot(frame.outward, blade.outward)) / degree;
    return blade;
  };
  handles.depth = blade_at(std::lerp(from, to, 1. / 3)), handles.tilt = blade_at(std::lerp(from, to, 2. / 3));
  handles.lever = std::max(handles.tilt.depth, path.length() / 4);
  for (int i = 0; i <= places_of_line; ++i) {
    const double place = path.length() * i / places_of_line;
    const PathFrame frame = path.at(place);
    handles.line.push_back(frame.position);
    handles.edge.push_back(frame.position - path.depth(place) * frame.outward);
  }
  return handles;
}

}  // namespace cleft
