#include "encoder/supported_rungs.h"

#include <algorithm>
#include <array>
#include <utility>

namespace cleft {

bool determined(const BSplineBasis& basis, const std::vector<double>& places) {
  const auto& knots = basis.knots();
  const int p = basis.degree();
  auto place = places.begin();
  for (int i = 0; i < basis.size(); ++i) {
    const double front = knots[i], back = knots[i + p + 1];
    const bool from_front = front == knots[i + p], to_back = knots[i + 1] == back;
    if (from_front) place = std::lower_bound(places.begin(), places.end(), front);
    while (place != places.end() && !from_front && *place <= front) ++place;
    if (place == places.end() || (to_back ? *place > back : *place >= back)) return false;
    ++place;
  }
  return true;
}

namespace {

void sort_each_once(std::array<std::vector<double>, 3>& places) {
  for (std::vector<double>& on_axis : places) {
    std::sort(on_axis.begin(), on_axis.end());
    on_axis.erase(std::unique(on_axis.begin(), on_axis.end()), on_axis.end());
  }
}

constexpr std::pair<int Rung::*, std::size_t> spans_of_axes[] = {{&Rung::before, 0}, {&Rung::along, 0},
                                                                 {&Rung::after, 0},  {&Rung::across, 1},
                                                                 {&Rung::above, 2},  {&Rung::below, 2}};

}  // namespace

std::array<std::vector<double>, 3> places_on_axes(const Series& series,
                                                  const Parametrization& parametrization) {
  const double last = series.times.back();
  std::array<std::vector<double>, 3> places;
  for (const Sample& sample : series.samples) {
    places[0].push_back(parametrization.along(sample.uvw.x, last).value);
    places[1].push_back(parametrization.across(sample.uvw.y).value);
    places[2].push_back(parametrization.height(sample.uvw.z).value);
  }
  sort_each_once(places);
  return places;
}

std::vector<Rung> supported(const std::vector<Rung>& ladder, const Series& series,
                            const Parametrization& parametrization, double nodes_at_front) {
  std::array<std::vector<double>, 3> places = places_on_axes(series, parametrization);
  if (ladder.front().close) {  // edges hold the spline
    for (const Sample& sample : series.middles.samples)
      places[1].push_back(parametrization.across(sample.uvw.y).value);
    sort_each_once(places);
  }
  // The first rung is always allowed, except for knots in height, where levels of nodes are few.
  Rung least = ladder.front();
  while (least.above > 1 && !determined(bases_of(least, parametrization, 2)[2], places[2])) --least.above;
  const auto bases_of_least = bases_of(least, parametrization, 2);
  bool thorough = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
    thorough = thorough && determined(bases_of_least[axis], places[axis]);
  // Nodes for each control point; an axis on which all nodes have one place counts as one control point.
  const bool passes = parametrization.moves() && !parametrization.geometry().tip.still();
  const bool front = parametrization.resolves_front();
  const double nodes_each = passes ? (front ? nodes_at_front : 6) : thorough ? 0 : 2;
  std::vector<Rung> rungs = {least};
  for (const Rung& rung : ladder) {
    Rung next = rungs.back();
    for (const auto& [spans, axis] : spans_of_axes) {
      Rung more = next;
      more.*spans = rung.*spans;
      const auto bases = bases_of(more, parametrization, static_cast<int>(series.times.size()));
      double control_points = 1;
      for (std::size_t on = 0; on < 3; ++on)
        if (places[on].size() > 1) control_points *= bases[on].size();
      if (determined(bases[axis], places[axis]) &&
          nodes_each * control_points <= static_cast<double>(series.samples.size()))
        next = more;
    }
    if (next == rungs.back()) continue;
    next.time = rung.time;
    rungs.push_back(next);
  }
  return rungs;
}

}  // namespace cleft
