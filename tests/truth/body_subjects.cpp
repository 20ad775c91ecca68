#include "tests/truth/body_subjects.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "base/error.h"
#include "base/text.h"
#include "examples/head/surface_mesher.h"

namespace cleft::testing {

namespace {

using Places = std::vector<std::pair<double, double>>;
constexpr double edge = 2, jitter = 0.25, depth = 3, length = 30;

/// From so many mm before to so many mm behind a place of the plane, at an angle in degrees.
Places straight(double length_of_cut, double angle = 0, double x = 0, double y = 0) {
  Places places;
  const int pieces = std::max(8, static_cast<int>(length_of_cut / 2));
  const double c = std::cos(angle * std::numbers::pi / 180), s = std::sin(angle * std::numbers::pi / 180);
  for (int i = 0; i <= pieces; ++i) {
    const double along = length_of_cut * (double(i) / pieces - 0.5);
    places.emplace_back(x + c * along, y + s * along);
  }
  return places;
}

Places wave(double amplitude, double wavelength) {
  Places places;
  for (int i = 0; i <= 60; ++i) {
    const double x = wavelength * (i / 60. - 0.5);
    places.emplace_back(x, amplitude * std::sin(2 * std::numbers::pi * x / wavelength));
  }
  return places;
}

/// A path of a length, mm, whose curvature is a function of the part of it, around the middle of its ends.
template <class Curvature>
Places bending(double length_of_cut, const Curvature& curvature) {
  constexpr int steps = 3000, points = 60;
  const double step = length_of_cut / steps;
  Places places;
  double x = 0, y = 0, direction = 0;
  for (int i = 0; i <= steps; ++i) {
    if (i % (steps / points) == 0) places.emplace_back(x, y);
    const double turn = step * curvature((i + 0.5) / steps);
    x += step * std::cos(direction + turn / 2), y += step * std::sin(direction + turn / 2);
    direction += turn;
  }
  const auto [end_x, end_y] = places.back();
  const double long_way = std::hypot(end_x, end_y), c = end_x / long_way, s = end_y / long_way;
  for (auto& [px, py] : places) {
    const double from_x = px - end_x / 2, from_y = py - end_y / 2;
    px = c * from_x + s * from_y, py = c * from_y - s * from_x;
  }
  return places;
}

/// Of two arcs that bend to either side.
Places s_shape(double radius, double length_of_cut) {
  return bending(length_of_cut, [=](double part) { return (part < 0.5 ? 1 : -1) / radius; });
}

/// Two straight legs, joined by half a circle.
Places flap(double radius, double leg) {
  Places places;
  for (int i = 0; i < 6; ++i) places.emplace_back(leg * (i / 6. - 1), -radius);
  for (int i = 0; i <= 20; ++i) {
    const double angle = std::numbers::pi * (i / 20. - 0.5);
    places.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  for (int i = 5; i >= 0; --i) places.emplace_back(leg * (i / 6. - 1), radius);
  return places;
}

Places ellipse(double half_x, double half_y) {
  Places places;
  for (int i = 0; i <= 60; ++i) {
    const double angle = 2 * std::numbers::pi * i / 60;
    places.emplace_back(half_x * std::cos(angle), half_y * std::sin(angle));
  }
  places.back() = places.front();
  return places;
}

/// The path with a depth that goes from one number to the other.
ScalpelPath deepening(const ScalpelPath& path, double from, double to) {
  std::vector<ScalpelPath::Point> points;
  for (const double s : path.given()) {
    const PathFrame at = path.at(s);
    points.push_back({at.position, at.outward, from + (to - from) * s / path.length()});
  }
  return ScalpelPath(points);
}

/// A sheet that goes around the places of all paths.
Subject on(const Bend& bend, const std::vector<Places>& all, double margin, double deep = depth,
           double tilt = 0) {
  double half_x = 0, half_y = 0;
  Subject subject;
  for (const Places& places : all) {
    for (const auto& [x, y] : places)
      half_x = std::max(half_x, std::abs(x)), half_y = std::max(half_y, std::abs(y));
    subject.paths.push_back(path_on(bend, places, deep, tilt));
  }
  subject.skin = sheet(bend, half_x + margin, half_y + margin, edge, jitter);
  return subject;
}

Subject head_cheek() {
  const head::TriangleMesh mesh = head::mesh_head(12000);
  std::vector<ScalpelPath::Point> points;
  for (const auto& [position, normal] : head::cheek_path(2)) points.push_back({position, normal, depth});
  return {"", {mesh.points, mesh.triangles}, {ScalpelPath(points)}, {}};
}

/// From `a` to `b` mm deep between x = -half and half.
Subject above_bone(double a, double b, double half, double margin) {
  Subject subject = on(flat, {straight(length)}, margin);
  const auto deep = [=](double x, double) {
    return (a + b) / 2 + (b - a) / 2 * std::clamp(x / half, -1., 1.);
  };
  subject.bone = sheet(below(flat, deep), length / 2 + margin + 5, margin + 5, edge);
  return subject;
}

}  // namespace

std::vector<NamedSubject> body_subjects(double margin) {
  std::vector<NamedSubject> all;
  const auto add = [&](const std::string& name, const Bend& bend, const std::vector<Places>& paths,
                       double deep = depth, double tilt = 0) {
    all.push_back({name, [=] { return on(bend, paths, margin, deep, tilt); }});
  };
  const auto text = [](double x) { return shortest(x); };
  const Places usual = straight(length);
  add("flat, straight", flat, {usual});
  for (const double r : {60., 30., 20., 15.}) add("arc of " + text(r), flat, {arc(r, length)});
  for (const double r : {30., 20., 15.}) add("S of " + text(r), flat, {s_shape(r, length)});
  add("S of 15, 45 mm long", flat, {s_shape(15, 45)});
  add("spiral to 15", flat, {bending(length, [](double part) { return part / 15; })});
  add("wave of 6 in 60", flat, {wave(6, 60)});
  for (const double a : {5., 8.}) add("sine of " + text(a), flat, {wave(a, 40)});
  for (const double a : {15., 30., 45.}) add("tilted by " + text(a), flat, {usual}, depth, a);
  for (const double l : {10., 20., 60., 90., 120.}) add(text(l) + " mm long", flat, {straight(l)});
  for (const double d : {1.5, 6.}) add(text(d) + " mm deep", flat, {usual}, d);
  all.push_back({"2 to 4 mm deep", [=] {
                   Subject subject = on(flat, {usual}, margin);
                   subject.paths = {deepening(subject.paths[0], 2, 4)};
                   return subject;
                 }});
  for (const double r : {100., 60., 30.}) {
    add("along a cylinder of " + text(r), cylinder_along(r), {usual});
    add("around a cylinder of " + text(r), cylinder_around(r), {usual});
    add("45 degrees on a cylinder of " + text(r), cylinder_along(r), {straight(length, 45)});
  }
  for (const double r : {80., 40.}) add("sphere of " + text(r), sphere_cap(r), {usual});
  add("saddle of 60", saddle(60), {usual});
  add("torus of 60 and 40", torus_outside(60, 40), {usual});
  all.push_back({"bone 5 to 8 mm below", [=] { return above_bone(5, 8, length / 2, margin); }});
  all.push_back({"bone 5 to 8 mm below within 10", [=] { return above_bone(5, 8, 5, margin); }});
  for (const double d : {10., 4.})
    add("parallel, " + text(d) + " apart", flat,
        {straight(length, 0, 0, -d / 2), straight(length, 0, 0, d / 2)});
  add("three parallel, 8 apart", flat,
      {straight(length, 0, 0, -8), straight(length, 0, 0, 0), straight(length, 0, 0, 8)});
  add("two in a line, 6 apart", flat, {straight(20, 0, -13, 0), straight(20, 0, 13, 0)});
  add("at an angle of 30", flat, {straight(length, 0, 0, -5), straight(24, 30, 2, 5)});
  add("at an angle of 60", flat, {straight(length, 0, 0, -8), straight(20, 60, 2, 6)});
  add("T, branch of 15", flat, {usual, straight(15, 90, 0, 7.5)});
  add("X at 90 degrees", flat, {usual, straight(length, 90)});
  add("X at 45 degrees", flat, {usual, straight(length, 45)});
  add("flap, U of radius 10", flat, {flap(10, 15)});
  add("excision, ellipse 30 x 14", flat, {ellipse(15, 7)});
  all.push_back({"cheek of the generated head", head_cheek});
  return all;
}

NamedSubject straight_cuts(const std::string& text, double margin) {
  std::vector<Places> all;
  double deep = depth;
  std::istringstream cuts(text);
  for (std::string cut; cuts >> cut;) {
    std::vector<double> numbers;
    std::istringstream list(cut);
    for (std::string number; std::getline(list, number, ',');)
      numbers.push_back(parse_number(number, "--cuts " + cut));
    if (numbers.size() < 4 || numbers.size() > 5 || !(numbers[0] > 0) ||
        !(numbers.size() < 5 || numbers[4] > 0))
      throw InputError("--cuts " + cut +
                       ": must be LENGTH,ANGLE,X,Y or LENGTH,ANGLE,X,Y,DEPTH, such as 30,90,0,0");
    if (numbers.size() == 5) deep = numbers[4];
    all.push_back(straight(numbers[0], numbers[1], numbers[2], numbers[3]));
  }
  if (all.empty()) throw InputError("--cuts: must be LENGTH,ANGLE,X,Y of each cut, such as 30,90,0,0");
  std::string name = text;
  std::replace(name.begin(), name.end(), ',', ' ');
  return {name, [=] { return on(flat, all, margin, deep); }};
}

}  // namespace cleft::testing
