#include "explorer/scene/overlay.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/text.h"

namespace cleft {

namespace {

// Okabe and Ito's colours, which colour-blind people can distinguish.
constexpr Ink blue{0, 0.447, 0.698}, vermilion{0.835, 0.369, 0}, green{0, 0.62, 0.451},
    grey{0.35, 0.35, 0.38};

Vec3 moved(const Field& field, const Vec3& uvw, Side side, double t) {
  return uvw + field.displacement(uvw, side, t);
}

std::vector<double> places_of_knots(const BSplineBasis& basis, const auto& place) {
  std::vector<double> places;
  for (const double knot : basis.knots())
    if (const double x = place(knot); places.empty() || x > places.back() + 1e-9) places.push_back(x);
  return places;
}

}  // namespace

Overlay nodes_around(const RawCase& raw, const Vec3& place, double radius, double t) {
  const std::size_t frame = raw.nearest_frame(t);
  const std::vector<int> nodes = raw.nodes_within(place, radius);
  const std::vector<Vec3> moves = raw.displacements(frame, nodes);
  const std::vector<double> errors = raw.errors(frame, nodes);
  const double largest = errors.empty() ? 0 : *std::max_element(errors.begin(), errors.end());
  constexpr Ink little{1, 0.95, 0.7}, much{0.3, 0, 0.35};
  Overlay overlay;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    overlay.dots.push_back({raw.snapshot().points[nodes[i]] + moves[i],
                            between(little, much, largest > 0 ? errors[i] / largest : 0)});
  overlay.in_front = true;
  if (largest > 0) overlay.scale = {"error of the field at the nodes, mm", largest, little, much};
  overlay.caption =
      formatted("%zu nodes of the simulation, frame %zu at %.1f mm: the field is off by up to %.2g mm",
                nodes.size(), frame, raw.snapshot().times[frame], largest);
  return overlay;
}

Overlay constraints_at(const RawCase& raw, double t) {
  const Snapshot& s = raw.snapshot();
  const Field& field = raw.field();
  const std::size_t frame = raw.nearest_frame(t);
  const double time = s.times[frame];
  const auto place = [&](int node) { return moved(field, s.points[node], raw.side(node), time); };
  Overlay overlay;
  for (const auto& [a, b, c] : s.skin())
    overlay.lines.push_back({{place(a), place(b), place(c), place(a)}, grey});
  const int released = s.released[frame];
  for (int k = 0; k < static_cast<int>(s.pairs.size()); ++k) {
    const auto [left, right] = s.pairs[k];
    const Vec3 a = place(left), b = place(right);
    overlay.dots.push_back({a, k < released ? vermilion : blue});
    if (k >= released) continue;
    overlay.dots.push_back({b, vermilion});
    overlay.lines.push_back({{a, b}, vermilion});
  }
  overlay.surface_opacity = 0.25;
  overlay.caption =
      formatted("frame %zu: %zu constraints hold pairs of nodes together (blue), %d are released (orange)",
                frame, s.pairs.size() - static_cast<std::size_t>(released), released);
  return overlay;
}

Overlay lattice_at(const Field& field, double t) {
  const Parametrization& p = field.parametrization();
  const auto inside = [&](double x, int axis) { return p.inside(x, axis); };
  const auto us = places_of_knots(field.basis(0), [&](double k) { return inside(p.u_at(k, t), 0); });
  const auto vs = places_of_knots(field.basis(1), [&](double k) { return inside(p.v_at(k), 1); });
  const auto ws = places_of_knots(field.basis(2), [&](double k) { return inside(p.w_at(k), 2); });
  Overlay overlay;
  constexpr int pieces = 24;
  // From a to b on one side of the plane of the cut.
  const auto line = [&](const Vec3& a, const Vec3& b, Side side, const Ink& ink) {
    Overlay::Line curve{{}, ink};
    for (int i = 0; i <= pieces; ++i)
      curve.places.push_back(moved(field, a + double(i) / pieces * (b - a), side, t));
    overlay.lines.push_back(std::move(curve));
  };
  for (const Side side : {Side::left, Side::right}) {
    const Ink& ink = side == Side::left ? blue : green;
    const double edge = side == Side::left ? vs.front() : vs.back();
    for (const double u : us) {
      line({u, edge, 0}, {u, 0, 0}, side, ink);
      line({u, 0, ws.front()}, {u, 0, 0}, side, ink);
    }
    for (const double v : vs)
      if (v == 0 || side_of(v) == side) {
        line({us.front(), v, 0}, {us.back(), v, 0}, side, ink);
        for (const double u : us) overlay.dots.push_back({moved(field, {u, v, 0}, side, t), ink});
      }
    for (const double w : ws)
      if (w < 0) {
        line({us.front(), 0, w}, {us.back(), 0, w}, side, ink);
        for (const double u : us) overlay.dots.push_back({moved(field, {u, 0, w}, side, t), ink});
      }
  }
  overlay.surface_opacity = 0.3;
  overlay.caption =
      formatted("the lattice at t = %.1f mm: %d x %d x %d x %d control points, broken at the cut", t,
                field.basis(0).size(), field.basis(1).size(), field.basis(2).size(), field.basis(3).size());
  return overlay;
}

Overlay volume_along(const ScalpelPath& path, const Field& field, double s) {
  Overlay overlay;
  const double left = field.domain(1).front, right = field.domain(1).back, below = field.domain(2).front;
  const double depth = path.largest_depth() > 0 ? path.largest_depth() : field.cut().depth;
  constexpr double above = 8;  // mm: so that the blade is seen over the skin
  constexpr int stations = 60, sections = 12;
  const auto place = [&](double at, double v, double w) {
    const PathFrame frame = path.at(at);
    return frame.position + v * frame.across + w * frame.outward;
  };
  const std::vector<std::pair<double, double>> corners{{left, 0}, {right, 0}, {right, below}, {left, below}};
  for (const auto& [v, w] : corners) {
    Overlay::Line edge{{}, blue};
    for (int i = 0; i <= stations; ++i) edge.places.push_back(place(path.length() * i / stations, v, w));
    overlay.lines.push_back(std::move(edge));
  }
  for (int i = 0; i <= sections; ++i) {
    Overlay::Line section{{}, blue};
    for (std::size_t k = 0; k <= corners.size(); ++k)
      section.places.push_back(
          place(path.length() * i / sections, corners[k % 4].first, corners[k % 4].second));
    overlay.lines.push_back(std::move(section));
  }
  Overlay::Line trace{{}, vermilion}, bottom{{}, vermilion};
  for (int i = 0; i <= stations; ++i) {
    trace.places.push_back(place(path.length() * i / stations, 0, 0));
    bottom.places.push_back(place(path.length() * i / stations, 0, -depth));
  }
  overlay.lines.push_back(std::move(trace)), overlay.lines.push_back(std::move(bottom));
  for (int i = 0; i <= 3 * sections; ++i) {  // the blade where it has been: C(s) along N(s)
    const double at = path.length() * i / (3 * sections);
    if (at <= s) overlay.lines.push_back({{place(at, 0, -depth), place(at, 0, above / 2)}, vermilion});
  }
  overlay.lines.push_back({{place(s, 0, -depth), place(s, 0, 2 * above)}, green});
  overlay.dots.push_back({place(s, 0, -depth), green});
  overlay.dots.push_back({place(s, 0, 2 * above), green});
  overlay.in_front = true;
  overlay.caption = formatted(
      "the parametrisation volume along the path (blue), the blade's ruled surface (orange), the blade "
      "at s = %.1f mm (green)",
      s);
  return overlay;
}

}  // namespace cleft
