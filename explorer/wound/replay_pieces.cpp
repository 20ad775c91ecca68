#include "explorer/wound/replay_pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace cleft {

namespace {

/// Of the longest time: times that differ by less are the same but for rounding.
constexpr double rounding = 1e-9;
/// The part of a sample's pieces that may be divided: a frame evaluates those one by one, and all others four
/// at a time.
constexpr std::size_t one_divided_in = 20;
/// Parts of a knot's span in time at most: histories take memory in proportion.
constexpr int most_parts = 8;

std::vector<double> subdivided(const std::vector<double>& times, int parts) {
  std::vector<double> result{times.front()};
  for (std::size_t i = 1; i < times.size(); ++i) {
    for (int k = 1; k < parts; ++k) result.push_back(times[i - 1] + (times[i] - times[i - 1]) * k / parts);
    result.push_back(times[i]);
  }
  return result;
}

/// The fields' knots in time, as far as the blade goes.
std::vector<double> knot_times(std::span<const Field* const> fields) {
  std::vector<double> times;
  for (const Field* field : fields)
    for (const double t : field->knot_times()) times.push_back(t);
  std::sort(times.begin(), times.end());
  const double last = std::min(fields[0]->duration(), fields[0]->cut().length);
  const auto same = [last](double a, double b) { return b - a <= rounding * last; };
  times.erase(std::unique(times.begin(), times.end(), same), times.end());
  while (times.size() > 1 && times.back() >= last * (1 - rounding)) times.pop_back();
  times.push_back(last);
  return times;
}

/// Whether one cubic a span is not enough in too many of the spans.
bool are_divided(const Field& field, double tolerance, const std::vector<double>& times) {
  const Interval u = field.domain(0), v = field.domain(1);
  History history;
  std::size_t spans = 0, divided = 0;
  for (const double along : {0.1, 0.25, 0.35, 0.45, 0.55, 0.65, 0.75, 0.9})
    for (const double across : {0.05, 0.3, 0.46, 0.49, 0.51, 0.54, 0.7, 0.95})
      for (const double height : {0., -0.5}) {
        const Vec3 place{u.front + along * (u.back - u.front), v.front + across * (v.back - v.front),
                         height * field.cut().depth};
        field.contract(place, Side::both, tolerance, times, history);
        spans += times.size() - 1;
        auto next = history.breaks.begin();
        for (std::size_t span = 0; span + 1 < times.size(); ++span) {
          next = std::upper_bound(next, history.breaks.end(), times[span]);
          divided += next != history.breaks.end() && *next < times[span + 1];
        }
      }
  return divided > spans / one_divided_in;
}

}  // namespace

std::vector<double> replay_times(std::span<const Field* const> fields, double tolerance) {
  const std::vector<double> knots = knot_times(fields);
  for (int parts = 1;; parts *= 2) {
    const std::vector<double> times = subdivided(knots, parts);
    const bool enough = std::none_of(fields.begin(), fields.end(), [&](const Field* field) {
      return field->parametrization().moves() && are_divided(*field, tolerance, times);
    });
    if (enough || parts == most_parts) return times;
  }
}

ReplayPieces::ReplayPieces(std::vector<double> times, std::vector<double> offsets, std::vector<int> vertices,
                           double reach)
    : times_(std::move(times)),
      offsets_(std::move(offsets)),
      vertices_(std::move(vertices)),
      bounds_(vertices_.size()),
      reach_(reach),
      blocks_a_span_((vertices_.size() + 3) / 4),
      blocks_(spans() * blocks_a_span_),
      divided_(spans()) {
  CLEFT_CHECK(offsets_.size(), ==, vertices_.size());
  offsets_.resize(4 * blocks_a_span_, offsets_.empty() ? 0 : offsets_.back());  // blocks are read whole
}

void ReplayPieces::append(const History& history) {
  append(history, history, -std::numeric_limits<double>::infinity());
}

void ReplayPieces::append(const History& closed, const History& open, double s) {
  CLEFT_CHECK(next_, <, vertices_.size());
  // Own time of the passage; what the clamping leaves at an end happens in the span there. The rounding of
  // s + offset must not decide: near the passage both histories are kept.
  const double passage = std::clamp(s + offsets_[next_], times_.front(), times_.back()),
               close = rounding * (times_.back() - times_.front());
  const bool passes = &closed != &open;
  const double first = std::clamp(offsets_[next_], times_.front(), times_.back()),
               last = std::clamp(reach_ + offsets_[next_], times_.front(), times_.back());
  double longest = 0;  // squared
  for (std::size_t span = 0; span < spans(); ++span) {
    const bool before = passes && passage > times_[span] - close,
               after = !passes || passage < times_[span + 1] + close;
    auto& [exceptions, pieces] = divided_[span];
    Exception exception{next_, s, pieces.size(), 0, 0};
    if (before) collect(closed, span);
    exception.open = pieces.size();
    if (after) collect(open, span);
    exception.last = pieces.size();
    const bool reached = times_[span] <= last + close && times_[span + 1] >= first - close;
    for (std::size_t i = exception.first; reached && i < exception.last; ++i)
      for (const Vec3& d : pieces[i].control) longest = std::max(longest, squared_norm(d));
    if (exception.last == exception.first + 1) {
      set(span, pieces.back().control);
      pieces.pop_back();
    } else {
      exceptions.push_back(exception);
      ++exception_count_;
    }
  }
  bounds_[next_] = std::sqrt(longest);
  ++next_;
}

ReplayPieces ReplayPieces::of(const std::vector<std::size_t>& chosen) const {
  CLEFT_CHECK(next_, ==, vertices_.size());
  std::vector<double> offsets;
  std::vector<int> vertices;
  for (const std::size_t i : chosen) offsets.push_back(offsets_[i]), vertices.push_back(vertices_[i]);
  ReplayPieces few(times_, std::move(offsets), std::move(vertices), reach_);
  for (std::size_t k = 0; k < chosen.size(); ++k) few.bounds_[k] = bounds_[chosen[k]];
  for (std::size_t span = 0; span < spans(); ++span) choose(chosen, span, few);
  few.next_ = chosen.size();
  return few;
}

void ReplayPieces::choose(const std::vector<std::size_t>& chosen, std::size_t span, ReplayPieces& out) const {
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const PieceBlock& from = blocks_[span * blocks_a_span_ + chosen[k] / 4];
    PieceBlock& to = out.blocks_[span * out.blocks_a_span_ + k / 4];
    for (int m = 0; m < 4; ++m)
      for (int d = 0; d < 3; ++d) to.control[m][d][k % 4] = from.control[m][d][chosen[k] % 4];
  }
  const auto& [exceptions, pieces] = divided_[span];
  auto& [kept, kept_pieces] = out.divided_[span];
  auto at = chosen.begin();
  for (const Exception& e : exceptions) {
    at = std::lower_bound(at, chosen.end(), e.vertex);
    if (at == chosen.end()) break;
    if (*at != e.vertex) continue;
    const std::size_t first = kept_pieces.size();
    kept.push_back({static_cast<std::size_t>(at - chosen.begin()), e.closed_until, first,
                    first + e.open - e.first, first + e.last - e.first});
    for (std::size_t i = e.first; i < e.last; ++i) kept_pieces.push_back(pieces[i]);
  }
  out.exception_count_ += kept.size();
}

/// Appends the history's pieces within a span to that span's.
void ReplayPieces::collect(const History& history, std::size_t span) {
  const auto& breaks = history.breaks;
  const auto first = std::lower_bound(breaks.begin(), breaks.end(), times_[span]) - breaks.begin();
  CLEFT_CHECK(breaks[first], ==, times_[span]);
  for (auto i = static_cast<std::size_t>(first); breaks[i] < times_[span + 1]; ++i) {
    CLEFT_CHECK(breaks[i + 1], <=, times_[span + 1]);
    divided_[span].pieces.push_back({breaks[i], breaks[i + 1], history.controls[i]});
  }
}

void ReplayPieces::set(std::size_t span, const std::array<Vec3, 4>& control) {
  PieceBlock& block = blocks_[span * blocks_a_span_ + next_ / 4];
  for (int m = 0; m < 4; ++m)
    for (int d = 0; d < 3; ++d) block.control[m][d][next_ % 4] = control[m][d];
}

Vec3 ReplayPieces::displacement(std::size_t i, double s) const {
  const double time = std::clamp(s + offsets_[i], times_.front(), times_.back());
  const auto after = std::upper_bound(times_.begin() + 1, times_.end() - 1, time);
  const auto span = static_cast<std::size_t>(after - times_.begin()) - 1;
  const auto& [exceptions, pieces] = divided_[span];
  const auto e = std::partition_point(exceptions.begin(), exceptions.end(),
                                      [i](const Exception& x) { return x.vertex < i; });
  if (e != exceptions.end() && e->vertex == i) return displacement(*e, pieces, s);
  const PieceBlock& block = blocks_[span * blocks_a_span_ + i / 4];
  const double x = (time - times_[span]) / (times_[span + 1] - times_[span]), r = 1 - x;
  const double weight[4] = {r * r * r, 3 * r * r * x, 3 * r * x * x, x * x * x};
  Vec3 sum;
  for (int m = 0; m < 4; ++m)
    for (int d = 0; d < 3; ++d) sum[d] += weight[m] * block.control[m][d][i % 4];
  return sum;
}

Vec3 ReplayPieces::displacement(const Exception& e, const std::vector<Piece>& pieces, double s) const {
  const double time = std::clamp(s + offsets_[e.vertex], times_.front(), times_.back());
  const bool closed = s <= e.closed_until;
  const auto at = [&](std::size_t i) { return pieces.begin() + static_cast<std::ptrdiff_t>(i); };
  const auto first = at(closed ? e.first : e.open), last = at(closed ? e.open : e.last);
  const auto piece =
      std::upper_bound(first + 1, last, time, [](double t, const Piece& p) { return t < p.begin; }) - 1;
  const double x = std::clamp((time - piece->begin) / (piece->end - piece->begin), 0., 1.), r = 1 - x;
  const auto& c = piece->control;
  return r * r * r * c[0] + 3 * r * r * x * c[1] + 3 * r * x * x * c[2] + x * x * x * c[3];
}

std::pair<std::size_t, std::size_t> ReplayPieces::positions(double before, double s, const Vec3* rest,
                                                            Vec3* out) const {
  const double from = std::min(before, s), to = std::max(before, s),
               close = rounding * (times_.back() - times_.front());
  const auto begin = offsets_.begin(), end = begin + static_cast<std::ptrdiff_t>(vertices_.size());
  const auto first = std::partition_point(
                 begin, end, [&](double offset) { return to + offset < times_.front() - close; }),
             last = std::partition_point(
                 first, end, [&](double offset) { return from + offset <= times_.back() + close; });
  const auto front = static_cast<std::size_t>(first - begin), back = static_cast<std::size_t>(last - begin);
  positions(s, front, back, rest, out);
  return {front, back};
}

void ReplayPieces::positions(double s, std::size_t front, std::size_t last, const Vec3* rest,
                             Vec3* out) const {
  CLEFT_CHECK(next_, ==, vertices_.size());
  // In the order of offsets, and so of their own times: those of one span are neighbours.
  const auto begin = offsets_.begin(), end = begin + static_cast<std::ptrdiff_t>(last);
  while (front < last) {
    const auto after = std::upper_bound(times_.begin() + 1, times_.end() - 1, s + offsets_[front]);
    const auto span = static_cast<std::size_t>(after - times_.begin()) - 1;
    std::size_t back = last;
    if (span + 1 < spans())
      back = static_cast<std::size_t>(
          std::partition_point(begin, end, [&](double offset) { return s + offset < times_[span + 1]; }) -
          begin);
    kernels_->replay(&blocks_[span * blocks_a_span_], offsets_.data(), vertices_.data(), front, back, s,
                     times_[span], times_[span + 1] - times_[span], rest, out);
    const auto& [exceptions, pieces] = divided_[span];
    auto e = std::partition_point(exceptions.begin(), exceptions.end(),
                                  [&](const Exception& x) { return x.vertex < front; });
    for (; e != exceptions.end() && e->vertex < back; ++e)
      out[vertices_[e->vertex]] = rest[vertices_[e->vertex]] + displacement(*e, pieces, s);
    front = back;
  }
}

}  // namespace cleft
