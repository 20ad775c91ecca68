#include "explorer/incision/scalpel_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "explorer/incision/incision_tolerances.h"
#include "explorer/incision/natural_spline.h"

namespace cleft {

namespace {

using Limits = IncisionTolerances;

/// Throws InputError where a path cannot be computed with.
void check_points(const std::vector<ScalpelPath::Point>& points) {
  if (points.size() > Limits::most_path_points)
    throw InputError("a scalpel path may have " + std::to_string(Limits::most_path_points) +
                     " points; this one has " + std::to_string(points.size()) + ": leave some out");
  for (const ScalpelPath::Point& p : points) {
    const std::string name = "a scalpel path: point " + std::to_string(&p - points.data() + 1);
    const double farthest =
        std::max({std::abs(p.position.x), std::abs(p.position.y), std::abs(p.position.z)});
    if (!(farthest <= Limits::largest_coordinate))
      throw InputError(name + " has a coordinate of " + shortest(farthest) + "; it may be " +
                       shortest(Limits::largest_coordinate) + " at most");
    if (!(norm(p.outward) > 0))
      throw InputError(name + ": its direction (nx, ny, nz) is zero; it must point out of the surface");
    if (!std::isfinite(norm(p.outward)))
      throw InputError(name +
                       ": its direction (nx, ny, nz) is too long to be computed with; give one of "
                       "length 1");
  }
}

}  // namespace

ScalpelPath::ScalpelPath(const std::vector<Point>& points) {
  check_points(points);
  std::vector<double> chord;
  std::vector<Vec3> position, outward;
  std::vector<double> depth;
  double extent = 0;
  for (const Point& p : points) extent = std::max(extent, norm(p.position - points.front().position));
  for (const Point& p : points) {
    const double step = position.empty() ? 0 : norm(p.position - position.back());
    if (!position.empty() && step <= Limits::same_point * extent) continue;
    chord.push_back(position.empty() ? 0 : chord.back() + step);
    position.push_back(p.position);
    outward.push_back(normalized(p.outward));
    depth.push_back(p.depth);
  }
  if (position.size() < 2)
    throw InputError("a scalpel path needs at least 2 different points; it has " +
                     std::to_string(position.size()));
  if (!(chord.back() >= Limits::shortest_path))
    throw InputError("a scalpel path must be " + shortest(Limits::shortest_path) +
                     " long or longer; this one is " + shortest(chord.back()) + ": give it in larger units");

  const NaturalSpline curve(chord, position), direction(chord, outward);
  const std::size_t segments = position.size() - 1;
  const std::size_t pieces = std::max<std::size_t>(2, (Limits::path_samples + segments - 1) / segments);
  double s = 0;
  for (std::size_t i = 0; i < segments; ++i)
    for (std::size_t k = 0; k < pieces + (i + 1 == segments); ++k) {
      const double a = double(k) / pieces;
      if (k > 0) s += arc_length(curve, i, chord[i + 1] - chord[i], double(k - 1) / pieces, a);
      const double d = (1 - a) * depth[i] + a * depth[i + 1];
      samples_.push_back({s, curve.value(i, a), normalized(curve.derivative(i, a)),
                          normalized(direction.value(i, a)), d, k == 0 || k == pieces});
      if (k + 1 == pieces && i + 1 < segments) s += arc_length(curve, i, chord[i + 1] - chord[i], a, 1);
    }
  for (const Sample& sample : samples_)
    if (norm(cross(sample.tangent, sample.outward)) < Limits::least_sine)
      throw InputError("a scalpel path: near arc length " + shortest(sample.s) +
                       " the direction (nx, ny, nz) runs along the path; it must point out of the surface");
}

ScalpelPath ScalpelPath::from_table(const NumberTable& table, const std::string& name,
                                    const std::vector<std::string>& further) {
  int column[6];
  const char* names[6] = {"x", "y", "z", "nx", "ny", "nz"};
  for (int i = 0; i < 6; ++i) {
    column[i] = table.column(names[i]);
    if (column[i] < 0)
      throw FileError(name, std::string("has no column '") + names[i] +
                                "'; a path needs x,y,z,nx,ny,nz and may have depth");
  }
  const int depth = table.column("depth");
  std::vector<std::string> optional = further;
  optional.insert(optional.begin(), "depth");
  std::string list;
  for (const std::string& one : optional) list += (list.empty() ? "" : ", ") + one;
  for (const std::string& given : table.columns)
    if (std::find(optional.begin(), optional.end(), given) == optional.end() &&
        std::find(names, names + 6, given) == names + 6)
      throw FileError(name, "unknown column '" + given + "'" + did_you_mean(given, optional) +
                                "; a path has x,y,z,nx,ny,nz and may have " + list);
  std::vector<Point> points;
  for (const auto& row : table.rows) {
    points.push_back({{row[column[0]], row[column[1]], row[column[2]]},
                      {row[column[3]], row[column[4]], row[column[5]]},
                      depth < 0 ? 0 : row[depth]});
    if (depth >= 0 && !(row[depth] > 0))
      throw FileError(name, "row " + std::to_string(points.size()) + ": depth " + shortest(row[depth]) +
                                " must be greater than 0");
  }
  try {
    return ScalpelPath(points);
  } catch (const InputError& error) {
    throw FileError(name, error.what());
  }
}

std::vector<double> ScalpelPath::given() const {
  std::vector<double> places;
  for (const Sample& sample : samples_)
    if (sample.given) places.push_back(sample.s);
  return places;
}

std::size_t ScalpelPath::interval(double s) const {
  const auto next = std::upper_bound(samples_.begin() + 1, samples_.end() - 1, s,
                                     [](double value, const Sample& sample) { return value < sample.s; });
  return static_cast<std::size_t>(next - samples_.begin()) - 1;
}

/// Within [0, length()]; its tangent is no unit vector.
ScalpelPath::Sample ScalpelPath::sample_at(double s) const {
  const std::size_t i = interval(s);
  const Sample &p = samples_[i], &q = samples_[i + 1];
  const double h = q.s - p.s, a = std::clamp((s - p.s) / h, 0.0, 1.0), b = 1 - a;
  return {std::clamp(s, 0.0, length()),
          b * b * (1 + 2 * a) * p.position + a * a * (3 - 2 * a) * q.position +
              a * b * h * (b * p.tangent - a * q.tangent),
          (6 * a * b / h) * (q.position - p.position) + (b * (b - 2 * a)) * p.tangent +
              (a * (a - 2 * b)) * q.tangent,
          normalized(lerp(p.outward, q.outward, a)), b * p.depth + a * q.depth};
}

PathFrame ScalpelPath::at(double s) const {
  const Sample here = sample_at(s);
  PathFrame frame;
  frame.position = here.position;
  frame.outward = here.outward;
  frame.along = normalized(here.tangent - dot(here.tangent, frame.outward) * frame.outward);
  frame.across = cross(frame.outward, frame.along);
  frame.position += (s - std::clamp(s, 0.0, length())) * frame.along;
  return frame;
}

ScalpelPath ScalpelPath::moved(const Vec3& by) const {
  ScalpelPath result = *this;
  for (Sample& sample : result.samples_) sample.position += by;
  return result;
}

ScalpelPath ScalpelPath::scaled(double by) const {
  ScalpelPath result = *this;
  for (Sample& sample : result.samples_) sample.position *= by, sample.s *= by, sample.depth *= by;
  return result;
}

ScalpelPath ScalpelPath::until(double s) const {
  ScalpelPath part = *this;
  Sample end = sample_at(s);
  end.tangent = normalized(end.tangent);
  std::erase_if(part.samples_, [s](const Sample& sample) { return sample.s >= s; });
  part.samples_.push_back(end);
  return part;
}

double ScalpelPath::extend(double s, const Point& next, double beyond) {
  constexpr int pieces = 4, parts = 8, pieces_beyond = 16;
  Sample from = sample_at(s);
  from.tangent = normalized(from.tangent);
  from.given = true;
  const Vec3 way = next.position - from.position;
  const double chord = norm(way);
  if (!(chord > Limits::same_point * length()))
    throw InputError("a scalpel path: the next place is the one before");
  Sample to{0, next.position, {}, normalized(next.outward), next.depth};
  // Half of what makes it a circle's arc: a hand's tremor then fades, where it would swing on.
  to.tangent = normalized(1.5 / chord * way - 0.5 * from.tangent);
  if (norm(cross(to.tangent, to.outward)) < Limits::least_sine)
    throw InputError("a scalpel path: near arc length " + shortest(s) +
                     " its direction runs along the path; it must point out of the surface");
  std::vector<Sample> added{from};
  const auto place = [&](double a) {
    const double b = 1 - a;
    return b * b * (1 + 2 * a) * from.position + a * a * (3 - 2 * a) * to.position +
           a * b * chord * (b * from.tangent - a * to.tangent);
  };
  for (int k = 1; k <= pieces * parts; ++k) {
    const double a = double(k) / (pieces * parts), b = 1 - a;
    s += norm(place(a) - place(a - 1. / (pieces * parts)));
    if (k % parts != 0) continue;
    const Vec3 tangent =
        6 * a * b * way + chord * (b * (b - 2 * a) * from.tangent + a * (a - 2 * b) * to.tangent);
    added.push_back({s, place(a), normalized(tangent), normalized(lerp(from.outward, to.outward, a)),
                     b * from.depth + a * to.depth, k == pieces * parts});
  }
  for (int k = 1; k <= pieces_beyond; ++k) {
    Sample ahead = added.back();
    ahead.given = false;
    ahead.s += beyond / pieces_beyond;
    ahead.position += beyond / pieces_beyond * ahead.tangent;
    added.push_back(ahead);
  }
  while (!samples_.empty() && samples_.back().s >= from.s - Limits::same_point * (1 + from.s))
    samples_.pop_back();
  samples_.insert(samples_.end(), added.begin(), added.end());
  return s;
}

double ScalpelPath::depth(double s) const {
  const std::size_t i = interval(s);
  const Sample &p = samples_[i], &q = samples_[i + 1];
  const double a = std::clamp((s - p.s) / (q.s - p.s), 0.0, 1.0);
  return (1 - a) * p.depth + a * q.depth;
}

double ScalpelPath::largest_depth() const {
  double depth = samples_.front().depth;
  for (const Sample& sample : samples_) depth = std::max(depth, sample.depth);
  return depth;
}

double ScalpelPath::smallest_depth() const {
  double depth = samples_.front().depth;
  for (const Sample& sample : samples_) depth = std::min(depth, sample.depth);
  return depth;
}

void ScalpelPath::set_depth(double depth) {
  for (Sample& sample : samples_) sample.depth = depth;
}

}  // namespace cleft
