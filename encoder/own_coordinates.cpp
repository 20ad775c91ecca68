#include "encoder/own_coordinates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

#include "encoder/curved_places.h"
#include "params/meshed_cut.h"

namespace cleft {

namespace {

/// Of a cut that curves; none where its snapshot does not say that it does, and how long it is.
std::optional<CutCurve> curve_of(const RecordedParameters& recorded) {
  Parameters parameters = *recorded;
  for (double* member : {&parameters.cut.curvature, &parameters.cut.curvature_rate})
    if (std::isnan(*member)) *member = 0;  // not recorded
  if (!is_curved(parameters) || !(meshed_cut(parameters).length > 0)) return std::nullopt;
  return CutCurve(parameters);
}

bool within(const Interval& range, double x) {
  const double slack = 1e-9 * (range.back - range.front);
  return range.front - slack <= x && x <= range.back + slack;
}

}  // namespace

std::optional<std::array<Interval, 2>> own_domain(const Snapshot& s) {
  const auto& patch = s.parameters->patch;
  if (!s.coordinates || s.source || !s.parameters.has(patch.length) || !s.parameters.has(patch.width))
    return {};
  return {{{{-patch.length / 2, patch.length / 2}, {-patch.width / 2, patch.width / 2}}}};
}

OwnCoordinates::OwnCoordinates(const SnapshotReader& reader) {
  places = reader.coordinates();
  const std::vector<double> axes = reader.point_array(frame_array, 0);
  frames.resize(axes.size() / 9);
  for (std::size_t i = 0; i < axes.size(); ++i) frames[i / 9][i % 9 / 3][static_cast<int>(i % 3)] = axes[i];
  node.resize(places.size());
  std::iota(node.begin(), node.end(), std::size_t{0});
  const auto domain = own_domain(reader.snapshot());
  const auto curve = curve_of(reader.snapshot().parameters);
  if (domain && curve) add_further_places(*curve);
  if (const auto& source = reader.snapshot().source; source && !source->break_map.empty())
    add_turned_places(BreakMap::from(source->break_map));
  for (std::size_t n = 0; n < places.size(); ++n)
    if (!domain || (within((*domain)[0], places[n].x) && within((*domain)[1], places[n].y)))
      kept.push_back(n), nodes += node[n] == n;
  if (domain && curve) fill_gaps(*domain);
  if (!reader.snapshot().body.empty() && !beside_jumps(reader.snapshot()).empty()) fill_gaps(extent());
}

/// Of all places, along and across.
std::array<Interval, 2> OwnCoordinates::extent() const {
  std::array<Interval, 2> extent{{{places[0].x, places[0].x}, {places[0].y, places[0].y}}};
  for (const Vec3& place : places)
    for (int axis = 0; axis < 2; ++axis) {
      extent[axis].front = std::min(extent[axis].front, place[axis]);
      extent[axis].back = std::max(extent[axis].back, place[axis]);
    }
  return extent;
}

/// Around a front, the angle of a node near its ends is known with a turn more or less, and a node on the
/// axis is at all angles.
void OwnCoordinates::add_turned_places(const BreakMap& map) {
  constexpr double on_axis = 1e-3, apart = 0.4;  // of the radius; radians
  if (!map.round()) return;
  around = map;
  turn = map.round()->whole_circle() ? 2 * std::numbers::pi * map.round()->radius : 0;
  for (std::size_t n = 0, count = places.size(); n < count; ++n)
    if (const auto again = map.again(places[n]))
      places.push_back(*again), frames.push_back(frames[n]), node.push_back(n);
  const auto [first, last] = std::minmax_element(places.begin(), places.end(),
                                                 [](const Vec3& a, const Vec3& b) { return a.z < b.z; });
  const Interval angles{first->z, last->z};
  const auto steps =
      static_cast<int>(std::ceil((angles.back - angles.front) / (apart * map.round()->radius)));
  for (std::size_t n = 0, count = frames.size(); n < count && node[n] == n; ++n)
    for (int i = 0; places[n].x < on_axis * map.round()->radius && i <= steps; ++i) {
      places.push_back({places[n].x, places[n].y, angles.front + (angles.back - angles.front) * i / steps});
      frames.push_back(frames[n]), node.push_back(n);
    }
}

/// Frames depend on the place along the cut alone.
void OwnCoordinates::add_further_places(const CutCurve& cut) {
  std::vector<std::size_t> along(places.size());
  std::iota(along.begin(), along.end(), std::size_t{0});
  std::sort(along.begin(), along.end(),
            [this](std::size_t a, std::size_t b) { return places[a].x < places[b].x; });
  for (std::size_t n = 0, count = places.size(); n < count; ++n)
    for (const Vec3& place : further_places(cut, places[n])) {
      const auto after = std::lower_bound(along.begin(), along.end(), place.x,
                                          [this](std::size_t a, double u) { return places[a].x < u; });
      if (after == along.begin() || after == along.end()) continue;
      const std::size_t a = *(after - 1), b = *after;
      const double part = (place.x - places[a].x) / (places[b].x - places[a].x);
      std::array<Vec3, 3> frame;
      for (int k = 0; k < 3; ++k) frame[k] = normalized(lerp(frames[a][k], frames[b][k], part));
      places.push_back(place), frames.push_back(frame), node.push_back(n);
    }
}

/// Beyond the edges of a patch or a body, which are no lines of these coordinates, and within bends of a
/// body, where no node is, displacements are as at the nearest column of nodes: what a fit would have there
/// is neither known nor bounded.
void OwnCoordinates::fill_gaps(const std::array<Interval, 2>& domain) {
  constexpr int gaps = 24;  // that the domain is divided into, along and across
  std::map<std::pair<double, double>, std::vector<std::size_t>> columns;
  for (const std::size_t n : kept) columns[{places[n].x, places[n].y}].push_back(n);
  const double along = (domain[0].back - domain[0].front) / gaps,
               across = (domain[1].back - domain[1].front) / gaps;
  for (int i = 0; i <= gaps; ++i)
    for (int j = 0; j <= gaps; ++j) {
      const double u = domain[0].front + i * along, v = domain[1].front + j * across;
      const std::vector<std::size_t>* nearest = nullptr;
      double least = std::numeric_limits<double>::infinity();
      for (const auto& [at, column] : columns)
        if (const double off = std::hypot((at.first - u) / along, (at.second - v) / across); off < least)
          least = off, nearest = &column;
      if (!nearest || least < 1) continue;
      for (const std::size_t n : *nearest) {
        kept.push_back(places.size());
        places.push_back({u, v, places[n].z}), frames.push_back(frames[n]), node.push_back(node[n]);
      }
    }
}

double OwnCoordinates::turning(const std::vector<std::array<std::int32_t, 2>>& pairs) const {
  std::map<double, const std::array<Vec3, 3>*> along;
  for (const auto& [left, right] : pairs) along.emplace(places[left].x, &frames[left]);
  double angle = 0, least = 0, greatest = 0;
  const std::array<Vec3, 3>* before = nullptr;
  for (const auto& [u, frame] : along) {
    if (before) angle += std::asin(std::clamp(dot((*frame)[0], (*before)[1]), -1., 1.));
    least = std::min(least, angle), greatest = std::max(greatest, angle);
    before = frame;
  }
  return greatest - least;
}

Bend OwnCoordinates::tightest_bend(const Snapshot& s) const {
  constexpr std::size_t beside = 2;  // columns of pairs on either side
  std::map<double, std::int32_t> columns;
  for (const auto& [left, right] : s.pairs) columns.emplace(places[left].x, left);
  const std::vector<std::pair<double, std::int32_t>> along(columns.begin(), columns.end());
  Bend tightest;
  for (std::size_t i = beside; i + beside < along.size(); ++i) {
    const auto [from, before] = along[i - beside];
    const auto [to, after] = along[i + beside];
    const double sine = dot(frames[after][0], frames[before][1]);
    const double radius = (to - from) / std::max(std::abs(std::asin(std::clamp(sine, -1., 1.))), 1e-9);
    if (radius < tightest.radius) tightest = {radius, s.points[along[i].second]};
  }
  return tightest;
}

/// Of the places among those that are kept, or -1.
std::vector<std::int64_t> OwnCoordinates::numbers() const {
  std::vector<std::int64_t> number(places.size(), -1);
  for (std::size_t i = 0; i < kept.size(); ++i) number[kept[i]] = static_cast<std::int64_t>(i);
  return number;
}

bool OwnCoordinates::jumps(const Snapshot& s, std::span<const std::int64_t> cell) const {
  constexpr double most_stretched = 4;
  const std::int64_t b = cell[0];
  return std::any_of(cell.begin(), cell.end(), [&](std::int64_t a) {
    if (turn > 0) return std::abs(places[a].z - places[b].z) > turn / 2;
    return norm(places[a] - places[b]) > most_stretched * norm(s.points[a] - s.points[b]);
  });
}

namespace {

std::span<const std::int64_t> cell_of(const Snapshot& s, std::size_t c) {
  return {s.connectivity.begin() + s.cell_offsets[c], s.connectivity.begin() + s.cell_offsets[c + 1]};
}

bool within(std::span<const std::int64_t> cell, const std::vector<std::int64_t>& number) {
  return std::all_of(cell.begin(), cell.end(), [&](std::int64_t n) { return number[n] >= 0; });
}

}  // namespace

std::vector<std::int32_t> OwnCoordinates::beside_jumps(const Snapshot& s) const {
  const std::vector<std::int64_t> number = numbers();
  std::vector<std::int32_t> beside;
  for (std::size_t c = 0; s.has_own_coordinates() && c + 1 < s.cell_offsets.size(); ++c)
    if (const auto cell = cell_of(s, c); within(cell, number) && jumps(s, cell))
      for (const std::int64_t n : cell) beside.push_back(static_cast<std::int32_t>(number[n]));
  std::sort(beside.begin(), beside.end());
  beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
  return beside;
}

void OwnCoordinates::place_around_front(const Snapshot& s, CellCentres& middles) const {
  if (!around) return;
  for (std::size_t c = 0; c < middles.samples.size(); ++c) {
    const std::size_t first = middles.first[c], count = middles.first[c + 1] - first;
    Vec3 middle;
    for (std::size_t k = first; k < first + count; ++k)
      middle += (1. / static_cast<double>(count)) * s.points[node[kept[middles.nodes[k]]]];
    const Vec3 found = around->canonical(middle);
    if (found.x < 1e-6 * around->round()->radius) continue;  // on the axis, which has no angle
    Vec3& place = middles.samples[c].uvw;
    const double turns = turn > 0 ? std::round((place.z - found.z) / turn) : 0;
    place.x = found.x, place.z = found.z + turns * turn;
  }
}

Snapshot OwnCoordinates::of(const Snapshot& s) const {
  Snapshot moved = s;
  const std::vector<std::int64_t> number = numbers();
  moved.points.clear(), moved.cell_types.clear(), moved.connectivity.clear(), moved.cell_offsets = {0};
  for (const std::size_t n : kept) moved.points.push_back(places[n]);
  for (std::size_t c = 0; c + 1 < s.cell_offsets.size(); ++c) {
    const auto cell = cell_of(s, c);
    if (!within(cell, number) || (s.has_own_coordinates() && jumps(s, cell))) continue;
    for (const std::int64_t n : cell) moved.connectivity.push_back(number[n]);
    moved.cell_types.push_back(s.cell_types[c]);
    moved.cell_offsets.push_back(static_cast<std::int64_t>(moved.connectivity.size()));
  }
  for (auto& pair : moved.pairs)
    for (std::int32_t& end : pair) end = static_cast<std::int32_t>(number[end]);
  return moved;
}

}  // namespace cleft
