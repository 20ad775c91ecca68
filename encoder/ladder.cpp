#include "encoder/ladder.h"

#include <algorithm>
#include <cmath>

namespace cleft {

namespace {

constexpr int degree = 3;

// Knots in an order that served cuts in default, deep and soft tissue; no claim that it is the best.
const std::vector<double> before_order = {0.5, 0.75, 0.25};
const std::vector<double> along_order = {0.5,    0.75,  0.25,  0.875,   0.125,  0.9375,
                                         0.0625, 0.625, 0.375, 0.96875, 0.03125};
const std::vector<double> after_order = {0.5, 0.75, 0.25};
// Where the direction of the cut turns, what opens changes along all of it.
const std::vector<double> bent_order = {0.5,   0.75,   0.25,   0.875,   0.125,  0.625,
                                        0.375, 0.9375, 0.0625, 0.96875, 0.03125};
// Where it turns on and on, at even distances before those next to the ends, which nodes seldom determine.
const std::vector<double> winding_order = {0.5,    0.75,   0.25,   0.875,  0.125,  0.625,  0.375, 0.9375,
                                           0.0625, 0.5625, 0.4375, 0.6875, 0.3125, 0.8125, 0.1875};
// Where lengths next to the front are measured as displacements grow.
const std::vector<double> beyond_front_order = {0.25, 0.0625, 0.5, 0.75};
const std::vector<double> across_order = {0.5, 0.25, 0.875, 0.625, 0.1875, 0.96875, 0.375, 0.75};
// Beside the cut at distances at which coarse meshes have their first nodes.
const std::vector<double> close_order = {0.25, 0.5625, 0.34375, 0.4375};
const std::vector<double> above_order = {0.5, 0.25, 0.75};
const std::vector<double> below_order = {0.25};

// Ahead of a front that waits while others move there: at nearly even distances.
const std::vector<double> waiting_order = {0.5, 0.75, 0.875, 0.25, 0.625, 0.9375, 0.8125};

/// The first `count` of an order, which continues with all halves, quarters, eighths, ... that it lacks;
/// sorted.
std::vector<double> first_of(std::vector<double> order, int count) {
  for (int denominator = 2; static_cast<int>(order.size()) < count; denominator *= 2)
    for (int i = 1; i < denominator; i += 2)
      if (const double place = static_cast<double>(i) / denominator;
          std::find(order.begin(), order.end(), place) == order.end())
        order.push_back(place);
  order.resize(std::max(count, 0));
  std::sort(order.begin(), order.end());
  return order;
}

/// The first spans - 1 of 1/2, 1/4, 3/4, 1/8, 3/8, ..., sorted.
std::vector<double> halved(int spans) { return first_of({}, spans - 1); }

double crowded(double s) { return s * s; }  // toward 0

struct Knots {
  std::vector<double> list;
  void repeat(double knot, int times) { list.insert(list.end(), times, knot); }
  BSplineBasis basis(int p = degree) { return {p, std::move(list)}; }
};

/// Each kink divides it; spans are shared out by the time between them.
BSplineBasis time_basis(int spans, double front, double back, int frames,
                        const std::vector<TimeKink>& kinks = {}) {
  const int p = std::min(degree, frames - 1);
  Knots knots;
  knots.repeat(front, p + 1);
  std::vector<TimeKink> ends = kinks;
  ends.push_back({frames - 1, back});
  TimeKink from{0, front};
  for (const TimeKink& to : ends) {
    const double share = (to.parameter - from.parameter) / (back - front);
    const int wanted = kinks.empty() ? spans : static_cast<int>(std::ceil(spans * share));
    for (const double s : halved(std::clamp(wanted, 1, to.frame - from.frame + 1 - p)))
      knots.list.push_back(from.parameter + (to.parameter - from.parameter) * s);
    knots.repeat(to.parameter, &to == &ends.back() ? p + 1 : p);
    from = to;
  }
  return knots.basis(p);
}

std::array<BSplineBasis, 4> following_tip(const Rung& rung, const Parametrization& parametrization,
                                          int frames) {
  const FieldGeometry& geometry = parametrization.geometry();
  const bool front_resolved = parametrization.resolves_front();
  const auto [front, back] = geometry.domain[0];
  Knots along, across, height;
  if (geometry.cut.start > front) {
    along.repeat(0, degree + 1);
    const std::vector<double> s =
        first_of(front_resolved ? beyond_front_order : before_order, rung.before - 1);
    for (auto i = s.rbegin(); i != s.rend(); ++i) along.list.push_back(1 - *i);
    along.repeat(1, degree);
  } else {
    along.repeat(1, degree + 1);
  }
  for (const double s : first_of(rung.winds   ? winding_order
                                 : rung.bends ? bent_order
                                              : along_order,
                                 rung.along - 1))
    along.list.push_back(1 + s);
  if (geometry.tip.positions.front() < back) {
    along.repeat(2, degree);
    const auto& order = rung.waits ? waiting_order : front_resolved ? beyond_front_order : after_order;
    for (const double s : first_of(order, rung.after - 1)) along.list.push_back(2 + s);
    along.repeat(3, degree + 1);
  } else {
    along.repeat(2, degree + 1);
  }

  const std::vector<double> beside = first_of(rung.close ? close_order : across_order, rung.across - 1);
  across.repeat(-1, degree + 1);
  for (auto i = beside.rbegin(); i != beside.rend(); ++i) across.list.push_back(-crowded(*i));
  across.repeat(0, degree + 1);
  for (const double s : beside) across.list.push_back(crowded(s));
  across.repeat(1, degree + 1);

  if (geometry.cut.depth < -geometry.domain[2].front) {
    height.repeat(-2, degree + 1);
    const std::vector<double> s = first_of(below_order, rung.below - 1);
    for (auto i = s.rbegin(); i != s.rend(); ++i) height.list.push_back(-1 - *i);
    height.repeat(-1, degree);
  } else {
    height.repeat(-1, degree + 1);
  }
  for (const double s : first_of(above_order, rung.above - 1)) height.list.push_back(-1 + s);
  height.repeat(0, degree + 1);
  return {along.basis(), across.basis(), height.basis(), time_basis(rung.time, 0, 1, frames, rung.kinks)};
}

std::array<BSplineBasis, 4> fixed(const Rung& rung, const FieldGeometry& geometry, int frames) {
  const auto axis = [&](int i, int spans) {
    const auto [front, back] = geometry.domain[i];
    Knots knots;
    knots.repeat(front, degree + 1);
    for (const double s : halved(spans)) knots.list.push_back(front + (back - front) * s);
    knots.repeat(back, degree + 1);
    return knots.basis();
  };
  Knots across;
  const auto [left, right] = geometry.domain[1];
  across.repeat(left, degree + 1);
  for (const double s : halved(rung.across)) across.list.push_back(left * (1 - s));
  across.repeat(0, degree + 1);
  for (const double s : halved(rung.across)) across.list.push_back(right * s);
  across.repeat(right, degree + 1);
  return {axis(0, rung.along), geometry.cut.length > 0 ? across.basis() : axis(1, 2 * rung.across),
          axis(2, rung.above),
          time_basis(rung.time, geometry.domain[3].front, geometry.domain[3].back, frames)};
}

/// Knots within (from, to), mm, at even distances, as `parameter` of a place has them.
template <class Parameter>
void evenly(Knots& knots, double from, double to, int spans, const Parameter& parameter) {
  for (int i = 1; i < spans; ++i) knots.list.push_back(parameter(from + (to - from) * i / spans));
}

constexpr int around = 3;  // spans of an angle for each of a height

/// The first rung of a ladder for a series.
Rung rung_for(const LadderOf& series, Rung rung) {
  if (series.round) rung.above *= around;
  rung.waits = series.waits, rung.bends = series.bends, rung.winds = series.winds;
  if (series.waits) rung.after = static_cast<int>(waiting_order.size()) + 1;
  return rung;
}

/// Further spans along a cut that bends or winds.
int of_bends(const LadderOf& series) { return series.winds ? 12 : series.bends ? 2 : 0; }

}  // namespace

std::array<BSplineBasis, 4> bases_of(const Rung& rung, const Parametrization& parametrization, int frames) {
  return parametrization.moves() ? following_tip(rung, parametrization, frames)
                                 : fixed(rung, parametrization.geometry(), frames);
}

std::array<BSplineBasis, 4> even_bases(const EvenSpans& spans, const Parametrization& parametrization,
                                       int frames) {
  const FieldGeometry& geometry = parametrization.geometry();
  const double last = geometry.domain[3].back, start = geometry.cut.start, tip = geometry.tip.at(last);
  const bool follows = parametrization.moves();
  const auto u = [&](double x) { return parametrization.along(x, last).value; };
  const auto v = [&](double x) { return parametrization.across(x).value; };
  const auto w = [&](double x) { return parametrization.height(x).value; };
  std::array<Knots, 3> knots;
  const auto whole = [&](Knots& list, const Interval& domain, int of_axis, const auto& parameter) {
    list.repeat(parameter(domain.front), degree + 1);
    evenly(list, domain.front, domain.back, of_axis, parameter);
    list.repeat(parameter(domain.back), degree + 1);
  };
  const auto [front, back] = geometry.domain[0];
  const bool starts = follows && start > front, ends = follows && tip < back;
  if (follows) {
    if (starts) {
      knots[0].repeat(0, degree + 1);
      evenly(knots[0], front, start, spans.before, u);
    }
    knots[0].repeat(1, starts ? degree : degree + 1);
    evenly(knots[0], start, tip, spans.along, u);
    knots[0].repeat(2, ends ? degree : degree + 1);
    if (ends) {
      evenly(knots[0], tip, back, spans.after, u);
      knots[0].repeat(3, degree + 1);
    }
  } else {
    whole(knots[0], geometry.domain[0], spans.along, u);
  }
  if (geometry.cut.length > 0) {
    knots[1].repeat(v(geometry.domain[1].front), degree + 1);
    evenly(knots[1], geometry.domain[1].front, 0, spans.across, v);
    knots[1].repeat(0, degree + 1);
    evenly(knots[1], 0, geometry.domain[1].back, spans.across, v);
    knots[1].repeat(v(geometry.domain[1].back), degree + 1);
  } else {
    whole(knots[1], geometry.domain[1], spans.across, v);
  }
  if (follows) {
    const double bottom = geometry.domain[2].front, depth = geometry.cut.depth;
    const bool below = depth < -bottom;
    if (below) {
      knots[2].repeat(-2, degree + 1);
      evenly(knots[2], bottom, -depth, spans.below, w);
    }
    knots[2].repeat(-1, below ? degree : degree + 1);
    evenly(knots[2], below ? -depth : bottom, 0, spans.above, w);
    knots[2].repeat(0, degree + 1);
  } else {
    whole(knots[2], geometry.domain[2], spans.above, w);
  }
  Knots time;
  const int p = std::min(degree, frames - 1);
  const double from = parametrization.time(geometry.domain[3].front).value,
               to = parametrization.time(last).value;
  time.repeat(from, p + 1);
  evenly(time, from, to, std::clamp(spans.time, 1, frames - p), [](double x) { return x; });
  time.repeat(to, p + 1);
  return {knots[0].basis(), knots[1].basis(), knots[2].basis(), time.basis(p)};
}

std::vector<Rung> ladder_of(const Parametrization& parametrization, const LadderOf& series) {
  std::vector<Rung> rungs;
  if (parametrization.moves()) {
    // Where lengths next to the front are measured as displacements grow, six spans along the cut are needed
    // at once: with five, openings next to the front are off by twice as much.
    const bool front = parametrization.resolves_front();
    Rung r = front ? Rung{2, 4, 2, 3, 2, 1, 8} : Rung{1, 3, 2, 3, 2, 1, 8};
    r = rung_for(series, r);
    rungs.push_back(r);
    using Steps = std::vector<int Rung::*>;
    const Steps of_tip = {&Rung::across, &Rung::across, &Rung::along,  &Rung::across, &Rung::along,
                          &Rung::along,  &Rung::across, &Rung::before, &Rung::across, &Rung::below,
                          &Rung::after,  &Rung::above,  &Rung::along,  &Rung::before, &Rung::along,
                          &Rung::after,  &Rung::across};
    // Found by trying, of default cuts in finer meshes, deep and long ones, the step that gains most for its
    // control points.
    const Steps of_front = {&Rung::along,  &Rung::along,  &Rung::across, &Rung::across, &Rung::across,
                            &Rung::after,  &Rung::before, &Rung::along,  &Rung::above,  &Rung::along,
                            &Rung::across, &Rung::across, &Rung::below,  &Rung::across, &Rung::across,
                            &Rung::along,  &Rung::after,  &Rung::above,  &Rung::before, &Rung::along};
    Steps steps = front ? of_front : of_tip;
    // With its twelve steps a cut that winds has all sixteenths before nodes become too few for more.
    if (front) steps.insert(steps.begin(), of_bends(series), &Rung::along);
    for (int Rung::*const step : steps) {
      r.*step += series.round && step == &Rung::above ? around : 1;
      r.time = 8 + static_cast<int>(rungs.size()) / 2;
      rungs.push_back(r);
    }
    return rungs;
  }
  // The axis with the longest spans next.
  Rung r;
  r.time = 8;
  const auto& domain = parametrization.domain();
  while (r.along * r.across * r.above < 4000) {
    rungs.push_back(r);
    const double u = (domain[0].back - domain[0].front) / r.along,
                 v = (domain[1].back - domain[1].front) / (2 * r.across),
                 w = (domain[2].back - domain[2].front) / r.above;
    const double longest = std::max({u, v, w});
    // A third more at a time: a search should not take a fit a span.
    const auto grow = [](int& spans) { spans += std::max(1, spans / 3); };
    r.time = std::min(r.time + 1, most_time_spans);
    grow(longest == u ? r.along : longest == v ? r.across : r.above);
  }
  return rungs;
}

// Found by trying, of the cases of tests/accuracy: with fewer spans across or along, the first nodes ahead of
// the front are off by more; in time few are as good as many.
std::vector<Rung> close_rungs_of(const LadderOf& series) {
  Rung rung = rung_for(series, {2, 6, 2, 3, 2, 1, 5});
  rung.along += of_bends(series), rung.close = true;
  std::vector<Rung> rungs;
  for (const int across : {3, 4, 5}) {
    rung.across = across;
    rungs.push_back(rung);
  }
  return rungs;
}

}  // namespace cleft
