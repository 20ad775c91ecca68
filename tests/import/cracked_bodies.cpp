#include "tests/import/cracked_bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace cleft {

namespace {

constexpr double pi = std::numbers::pi;

/// Turned by an angle about c.
Vec3 turned(const Vec3& x, double angle) {
  return {std::cos(angle) * x.x - std::sin(angle) * x.y, std::sin(angle) * x.x + std::cos(angle) * x.y, x.z};
}

CrackedBody named(CrackedBody body, const std::string& name) {
  body.name = name;
  return body;
}

CrackedBody bent(const std::string& name, const std::function<Vec3(const Vec3&)>& place) {
  CrackedBody body = edge_crack();
  body.place = place;
  return named(std::move(body), name);
}

/// What the body does besides the crack: it bends and twists, smoothly in space.
Vec3 of_body(const Vec3& x, double t) {
  return 1e-5 * t * Vec3{x.x * x.y, 0.5 * x.x * x.x - 0.3 * x.y * x.y + 2 * x.x, x.y * x.z - x.x};
}

/// The same over places, with what the body does added.
CrackedBody with_body(CrackedBody body) {
  body.displacement = [place = body.place, crack = body.displacement](const Vec3& abc, int side, double t) {
    return crack(abc, side, t) + of_body(place(abc), t);
  };
  return body;
}

/// Growing rings of a disc of nodes are circles: squares of (s, t) of half side r <= inner become circles of
/// radius r, and turn back into squares at `outer`.
Vec3 disc(double s, double t, double b, double inner, double outer) {
  const double r = std::max(std::abs(s), std::abs(t)), h = std::hypot(s, t);
  if (r == 0) return {0, b, 0};
  const double square = std::clamp((r - inner) / (outer - inner), 0., 1.);
  const double scale = (1 - square) * r / h + square;
  return {scale * s, b, scale * t};
}

/// Flow around a disc of radius R in the plane y = 0: harmonic, odd in y, on the disc +- sqrt(1 - (r / R)^2);
/// in oblate spheroidal coordinates.
double through_disc(const Vec3& x, double R, int side) {
  const double r2 = (x.x * x.x + x.z * x.z) / (R * R), y = x.y / R;
  const double q = r2 + y * y - 1;
  const double zeta2 = 0.5 * (q + std::sqrt(q * q + 4 * y * y));
  const double zeta = std::sqrt(std::max(zeta2, 0.));
  const double xi2 = zeta > 1e-7 ? y * y / (zeta * zeta) : std::max(0., 1 - r2);
  const double xi = std::copysign(std::sqrt(std::max(xi2, 0.)), side != 0 ? side : x.y);
  const double decay = 1 - zeta * (pi / 2 - std::atan(zeta));
  return xi * decay;
}

}  // namespace

CrackedBody posed(CrackedBody body, const std::string& name, const Pose& pose) {
  const auto place = body.place;
  const auto displacement = body.displacement;
  body.place = [=](const Vec3& abc) { return pose.point(place(abc)); };
  body.displacement = [=](const Vec3& abc, int side, double t) {
    return pose.vector(displacement(abc, side, t));
  };
  body.name = name;
  return body;
}

std::vector<double> planes(double front, double back, int cells) {
  std::vector<double> list;
  for (int i = 0; i <= cells; ++i) list.push_back(front + (back - front) * i / cells);
  return list;
}

double around_slit(double x, double y, double R, int side) {
  const double p = R * R - x * x + y * y, q = -2 * x * y, size = std::hypot(p, q);
  const double real = std::sqrt(std::max(0., 0.5 * (size + p)));
  return std::copysign(real, side != 0 ? side : y) - y;
}

Vec3 beside_front(double a, double b, int side) {
  const double r = std::hypot(a, b), angle = side != 0 && b == 0 && a < 0 ? side * pi : std::atan2(b, a);
  constexpr double kappa = 3 - 4 * 0.3;
  const double c = std::cos(angle / 2), s = std::sin(angle / 2);
  return std::sqrt(r) * Vec3{c * (kappa - 1 + 2 * s * s), s * (kappa + 1 - 2 * c * c), 0};
}

CrackedBody::Mesh CrackedBody::mesh() const {
  Mesh mesh;
  std::map<std::tuple<std::size_t, std::size_t, std::size_t, int>, std::int64_t> numbers;
  const bool flat = c.size() == 1;
  const auto side_at = [&](const Vec3& abc, const Vec3& middle) {
    if (side) return side(abc, middle);
    const bool on_crack = std::find(cracks.begin(), cracks.end(), abc.y) != cracks.end() && doubled(abc);
    return !on_crack ? 0 : middle.y < abc.y ? -1 : 1;
  };
  const auto node = [&](std::size_t i, std::size_t j, std::size_t k, const Vec3& middle) {
    const Vec3 abc{a[i], b[j], c[k]};
    const int at_side = side_at(abc, middle);
    const auto [at, is_new] =
        numbers.try_emplace({i, j, k, at_side}, static_cast<std::int64_t>(mesh.nodes.size()));
    if (is_new) mesh.nodes.push_back({abc, at_side}), mesh.series.add_point(place(abc));
    return at->second;
  };
  for (std::size_t i = 0; i + 1 < a.size(); ++i)
    for (std::size_t j = 0; j + 1 < b.size(); ++j)
      for (std::size_t k = 0; k + 1 < c.size() + (flat ? 1 : 0); ++k) {
        const Vec3 middle{(a[i] + a[i + 1]) / 2, (b[j] + b[j + 1]) / 2, c[k]};
        if (!solid(middle)) continue;
        std::vector<std::int64_t> corners;
        for (const std::size_t level : {k, k + 1}) {
          if (flat && level > k) continue;
          for (const auto& [x, y] : {std::pair<std::size_t, std::size_t>{0, 0}, {1, 0}, {1, 1}, {0, 1}})
            corners.push_back(node(i + x, j + y, level, middle));
        }
        mesh.series.add_cell(flat ? quad : hexahedron, corners);
      }
  return mesh;
}

SourceSeries CrackedBody::series() const {
  Mesh made = mesh();
  SourceSeries series = std::move(made.series);
  series.times = times;
  auto& field = series.fields.emplace_back(SourceSeries::Field{"displacement", 3, {}});
  for (const double t : times) {
    auto& values = field.frames.emplace_back();
    for (const Node& node : made.nodes) {
      const Vec3 d = displacement(node.abc, node.side, t);
      values.insert(values.end(), {d.x, d.y, d.z});
    }
  }
  return series;
}

CrackedBody edge_crack() {
  CrackedBody body;
  body.name = "edge crack, hexahedra, axis-parallel";
  body.a = planes(0, 40, 40), body.b = planes(-15, 15, 30), body.c = planes(-6, 0, 4);
  body.times = planes(0, 12, 12);
  body.doubled = [](const Vec3& abc) { return abc.x < 24; };
  body.displacement = [](const Vec3& abc, int side, double t) {
    return 0.01 * t * beside_front(abc.x - 2 * t, abc.y, side);
  };
  return body;
}

std::vector<CrackedBody> cracked_bodies() {
  std::vector<CrackedBody> rows = {edge_crack()};
  Pose by_thirty;
  by_thirty.axes[0] = turned({1, 0, 0}, pi / 6), by_thirty.axes[1] = turned({0, 1, 0}, pi / 6);
  by_thirty.origin = {3, 4, 5};
  rows.push_back(posed(edge_crack(), "rotated by 30 degrees", by_thirty));
  rows.push_back(bent("wavy edge and bottom", [](const Vec3& x) {
    return Vec3{x.x + 0.03 * std::sin(2.1 * x.z + 0.4 * x.y) * (1 - x.x / 40), x.y,
                x.z + 0.03 * std::sin(1.3 * x.x) * (1 + x.z / 6)};
  }));

  CrackedBody within = named(edge_crack(), "its front within the elements, coarse");
  within.a = planes(0, 24, 24), within.b = planes(-12, 12, 24), within.c = planes(-4, 0, 4);
  within.times = planes(0, 8, 8);
  within.doubled = [](const Vec3& x) { return x.x < 14; };
  within.displacement = [](const Vec3& x, int side, double t) {
    return 0.01 * t * beside_front(x.x - 1.5 * t - 0.7, x.y, side);
  };
  rows.push_back(within);
  CrackedBody stops = named(edge_crack(), "stops within an element, and goes on faster");
  stops.c = planes(-4, 0, 4);
  stops.times = {0, 0.1, 0.5, 1, 2, 3, 4, 6, 8, 9, 9.5, 10, 11, 12};
  stops.displacement = [](const Vec3& x, int side, double t) {
    return 0.01 * t * beside_front(x.x - std::min(2 * t, 8.) - 3 * std::max(0., t - 9) - 0.6, x.y, side);
  };
  rows.push_back(stops);

  CrackedBody notch = named(edge_crack(), "crack from a notch root");
  notch.solid = [](const Vec3& x) { return x.x > 6 || std::abs(x.y) > 2; };
  notch.doubled = [](const Vec3& x) { return 6 <= x.x && x.x < 24; };
  notch.displacement = [](const Vec3& x, int side, double t) {
    return 0.01 * t * beside_front(x.x - 6 - 2 * t, x.y, side);
  };
  notch.times = planes(0, 9, 9);
  rows.push_back(notch);

  CrackedBody penny = named(edge_crack(), "penny crack inside the body");
  penny.a = penny.c = planes(-15, 15, 24), penny.b = planes(-12, 12, 16);
  penny.times = planes(0, 6, 6);
  penny.place = [](const Vec3& x) { return disc(x.x, x.z, x.y, 11.25, 15); };
  penny.doubled = [](const Vec3& x) { return std::max(std::abs(x.x), std::abs(x.z)) < 8.75; };
  penny.displacement = [place = penny.place](const Vec3& x, int side, double t) {
    return t == 0 ? Vec3{} : Vec3{0, 0.1 * t * through_disc(place(x), 1.25 * (t + 1), side), 0};
  };
  rows.push_back(posed(with_body(penny), penny.name, Pose::random(3)));

  CrackedBody oval = named(penny, "elliptic crack inside the body, coarse");
  oval.a = oval.c = planes(-15, 15, 16), oval.b = planes(-12, 12, 10);
  oval.times = planes(0, 5.7, 6);
  oval.place = [of = penny.place](const Vec3& x) {
    const Vec3 p = of(x);
    return Vec3{2 * p.x, p.y, p.z};
  };
  rows.push_back(posed(with_body(oval), oval.name, Pose::random(8)));

  // Half a disc, wider than deep by 1.5.
  CrackedBody elliptic = named(penny, "half elliptic crack at a face");
  elliptic.c = planes(-15, 0, 12);
  elliptic.place = [](const Vec3& x) {
    const Vec3 p = disc(x.x, x.z, x.y, 11.25, 15);
    return Vec3{1.5 * p.x, p.y, p.z};
  };
  elliptic.displacement = [](const Vec3& x, int side, double t) {
    return t == 0 ? Vec3{}
                  : Vec3{0, 0.1 * t * through_disc(disc(x.x, x.z, x.y, 11.25, 15), 1.25 * (t + 1), side), 0};
  };
  rows.push_back(posed(with_body(elliptic), elliptic.name, Pose::random(4)));

  CrackedBody corner = named(elliptic, "quarter elliptic crack in a corner");
  corner.a = planes(0, 15, 12);
  rows.push_back(posed(with_body(corner), corner.name, Pose::random(6)));

  // As it lies, u points toward the corner.
  CrackedBody at_once = named(elliptic, "quarter elliptic crack that opens at once");
  at_once.a = planes(-15, 0, 12);
  at_once.displacement = [](const Vec3& x, int side, double t) {
    return Vec3{0, 0.1 * t * through_disc(disc(x.x, x.z, x.y, 11.25, 15), 8.75, side), 0};
  };
  rows.push_back(with_body(at_once));

  CrackedBody plane = named(edge_crack(), "2D edge crack, one plane of nodes");
  plane.c = {0};
  rows.push_back(plane);

  CrackedBody shell = named(plane, "straight slit along a curved shell");
  shell.place = [](const Vec3& x) { return Vec3{x.x, 20 * std::sin(x.y / 20), 20 * std::cos(x.y / 20)}; };
  rows.push_back(posed(shell, shell.name, Pose::random(7)));

  // The last columns open, and the front is nowhere in the body any more.
  CrackedBody divided = named(edge_crack(), "through the body, whose halves part");
  divided.a = planes(0, 24, 24), divided.times = planes(0, 16, 16);
  divided.doubled = [](const Vec3&) { return true; };
  divided.displacement = [](const Vec3& x, int side, double t) {
    const double apart = 0.05 * std::max(0., t - 13) * (side != 0 ? side : x.y < 0 ? -1 : 1);
    return 0.01 * t * beside_front(x.x - 2 * t, x.y, side) + Vec3{0, apart, 0};
  };
  rows.push_back(divided);

  CrackedBody slit = named(edge_crack(), "2D slit inside, a pulse past it");
  slit.a = planes(-20, 20, 40), slit.c = {0}, slit.times = planes(0, 12, 24);
  slit.doubled = [](const Vec3& x) { return std::abs(x.x) < 8; };
  slit.displacement = [](const Vec3& x, int side, double t) {
    return std::sin(0.5 * t) *
           Vec3{0.1 * std::cos(0.1 * x.x + 0.08 * x.y - 0.3 * t), 0.1 * around_slit(x.x, x.y, 8, side), 0};
  };
  rows.push_back(slit);

  CrackedBody noisy = named(edge_crack(), "noise of 1e-6, opening of 1e-3");
  noisy.displacement = [](const Vec3& x, int side, double t) {
    // The same for every call: a number from the bits of place and time.
    const auto noise = [&](int i) {
      const double number =
          std::sin(12.9898 * x.x + 78.233 * x.y + 37.719 * x.z + 4.581 * t + 9.151 * side + i) * 43758.5453;
      return 2e-6 * (number - std::floor(number) - 0.5);
    };
    return 1.6e-5 * t * beside_front(x.x - 2 * t, x.y, side) + Vec3{noise(0), noise(1), noise(2)};
  };
  rows.push_back(noisy);

  // The law's elastic branch: ahead of the front, pairs open by up to 1e-3 of the largest opening.
  CrackedBody cohesive = named(edge_crack(), "cohesive elements: closed pairs open by 1e-3");
  cohesive.displacement = [](const Vec3& x, int side, double t) {
    const double elastic = side * 3e-4 * t * std::exp(-std::max(0., x.x - 2 * t) / 4);
    return 0.01 * t * beside_front(x.x - 2 * t, x.y, side) + Vec3{0, elastic, 0};
  };
  cohesive.doubled = [](const Vec3&) { return true; };
  rows.push_back(cohesive);

  rows.push_back(with_body(bent("curved, radius 60", [](const Vec3& x) {
    const double turn = x.x / 60;
    return Vec3{(60 - x.y) * std::sin(turn), 60 - (60 - x.y) * std::cos(turn), x.z};
  })));
  rows.push_back(with_body(bent("kinked by 30 degrees", [](const Vec3& x) {
    return Vec3{x.x, x.y + std::max(0., x.x - 10) * std::tan(pi / 6), x.z};
  })));
  // A sheet that is curved along the crack and across the thickness, and turned.
  rows.push_back(
      posed(with_body(bent("curved both ways, turned",
                           [](const Vec3& x) {
                             return Vec3{x.x, x.y + 2 * std::sin(0.12 * x.x) + 0.05 * x.z * x.z, x.z};
                           })),
            "curved both ways, turned", Pose::random(5)));
  return rows;
}

namespace {

/// Two edge cracks at the heights b = `heights`, of which the second grows at `slower` times the speed.
CrackedBody two_edge_cracks(const std::string& name, std::array<double, 2> heights, double slower) {
  CrackedBody body = named(edge_crack(), name);
  body.cracks = {heights[0], heights[1]};
  body.doubled = [=](const Vec3& x) { return x.x < (x.y == heights[1] ? slower : 1) * 24; };
  body.displacement = [=](const Vec3& x, int side, double t) {
    const auto of = [&](double height, double tip) {
      return 0.01 * t * beside_front(x.x - tip, x.y - height, x.y == height ? side : 0);
    };
    return of(heights[0], 2 * t) + of(heights[1], 2 * slower * t);
  };
  return body;
}

/// Displacement beside a crack along b at a = `at`, whose tip is at b = `tip`. `side`: -1 where a < at.
Vec3 beside_upright(const Vec3& x, double at, double tip, int side) {
  const Vec3 d = beside_front(x.y - tip, at - x.x, -side);
  return {-d.y, d.x, 0};
}

/// A crack along b = 0 to a = 32, from whose middle another grows along a = 20 when it has come to its end.
/// Sides: -1 below the first one, 1 above it and left of the second, 2 right of it.
CrackedBody branch() {
  CrackedBody body = named(edge_crack(), "T: a crack from the middle of another");
  body.a = planes(0, 40, 40), body.b = planes(-12, 18, 30);
  body.times = planes(0, 22, 22);
  body.side = [](const Vec3& x, const Vec3& middle) {
    if (x.y == 0 && x.x < 32 && middle.y < 0) return -1;
    const bool on_second = x.x == 20 && x.y >= 0 && x.y < 9;
    return on_second ? (middle.x < 20 ? 1 : 2) : x.y == 0 && x.x < 32 ? 1 : 0;
  };
  body.displacement = [](const Vec3& x, int side, double t) {
    const Vec3 first =
        0.01 * t * beside_front(x.x - std::min(32., 2 * t), x.y, x.y == 0 ? std::min(side, 1) : 0);
    if (t <= 16 || side < 0 || x.y < 0) return first;
    // Only above the first crack, and where that is open.
    const double off = (x.x - 20) / 12, part = std::max(0., 1 - off * off);
    const int of_second = x.x == 20 && x.y >= 0 ? (side == 1 ? -1 : side == 2 ? 1 : 0) : 0;
    return first + 0.02 * (t - 16) * part * part * part * beside_upright(x, 20, 1.5 * (t - 16), of_second);
  };
  return body;
}

}  // namespace

std::vector<CrackedBody> bodies_of_several_cracks() {
  std::vector<CrackedBody> rows = {two_edge_cracks("two parallel cracks, 8 elements apart", {-4, 4}, 0.5)};
  rows.push_back(two_edge_cracks("two parallel cracks, 4 elements apart", {-2, 2}, 0.5));

  CrackedBody behind = named(edge_crack(), "in one plane, one behind the other");
  behind.a = planes(0, 48, 48);
  behind.doubled = [](const Vec3& x) { return x.x < 14 || std::abs(x.x - 28) < 6; };
  behind.times = planes(0, 7, 14);
  behind.displacement = [](const Vec3& x, int side, double t) {
    const int of_slit = x.x > 20 ? side : 0, of_edge = x.x > 20 ? 0 : side;
    return 0.01 * t * beside_front(x.x - 2 * t, x.y, of_edge) +
           Vec3{0, 0.02 * t * around_slit(x.x - 28, x.y, 6, of_slit), 0};
  };
  rows.push_back(behind);

  CrackedBody apart = named(edge_crack(), "far apart, at a right angle, turned");
  apart.a = planes(0, 60, 60), apart.b = planes(-20, 20, 40), apart.c = planes(-3, 0, 2);
  apart.side = [](const Vec3& x, const Vec3& middle) {
    if (x.y == 0 && x.x < 20) return middle.y < 0 ? -1 : 1;
    if (x.x == 45 && x.y < -5) return middle.x < 45 ? -1 : 1;
    return 0;
  };
  apart.times = planes(0, 10, 10);
  apart.displacement = [](const Vec3& x, int side, double t) {
    return 0.01 * t * beside_front(x.x - 2 * t, x.y, x.x < 30 ? side : 0) +
           0.01 * t * beside_upright(x, 45, -20 + 1.5 * t, x.x > 30 ? side : 0);
  };
  rows.push_back(posed(apart, apart.name, Pose::random(7)));

  CrackedBody curved = two_edge_cracks("two parallel cracks, curved, radius 60", {-4, 4}, 0.5);
  curved.place = [](const Vec3& x) {
    const double turn = x.x / 60;
    return Vec3{(60 - x.y) * std::sin(turn), 60 - (60 - x.y) * std::cos(turn), x.z};
  };
  rows.push_back(with_body(curved));

  CrackedBody flat = two_edge_cracks("2D, two parallel cracks", {-4, 4}, 0.5);
  flat.c = {0};
  rows.push_back(flat);

  CrackedBody both = named(edge_crack(), "from its middle to both ends, turned");
  both.a = planes(-24, 24, 40), both.b = planes(-16, 16, 26), both.c = planes(-4, 0, 3);
  both.doubled = [](const Vec3& x) { return std::abs(x.x) < 17; };
  both.times = planes(0, 10, 10);
  both.displacement = [](const Vec3& x, int side, double t) {
    return Vec3{0, 0.02 * t * around_slit(x.x, x.y, 0.9 + 1.4 * t, side), 0};
  };
  rows.push_back(posed(both, both.name, Pose::random(11)));
  CrackedBody faster = named(both, "2D, to both ends, to one of them faster");
  faster.a = planes(-24, 24, 60), faster.b = planes(-16, 16, 40), faster.c = {0};
  faster.displacement = [](const Vec3& x, int side, double t) {
    return Vec3{0, 0.02 * t * around_slit(x.x - 0.25 * t, x.y, 0.9 + 1.1 * t, side), 0};
  };
  rows.push_back(faster);

  rows.push_back(branch());
  CrackedBody flat_branch = named(branch(), "2D, T");
  flat_branch.c = {0};
  rows.push_back(flat_branch);
  return rows;
}

void add_start_and_tensor(SourceSeries& series, double at_start) {
  SourceSeries::Field tensor{"S", 6, {}};
  for (auto& frame : series.fields[0].frames) {
    auto& values = tensor.frames.emplace_back();
    for (std::size_t i = 0; i < frame.size(); i += 3) {
      frame[i] += at_start;
      values.insert(values.end(),
                    {frame[i], frame[i + 1], frame[i + 2], 2 * frame[i + 1], frame[i], -frame[i + 2]});
    }
  }
  series.fields.push_back(std::move(tensor));
}

}  // namespace cleft
