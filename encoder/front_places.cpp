#include "encoder/front_places.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace cleft {

namespace {

constexpr double columns = 2.5;        // behind the last open one, whose openings count
constexpr std::size_t fewest = 3;      // places along u among them
constexpr double off_the_line = 0.04;  // of the mean of squares: root of the mean square, at most
constexpr double nearly_there = 0.8;   // of the way to the first closed column: the front stands there
constexpr double least = 0.1;          // of that way, to be ahead of what is open

struct Square {
  double u, value;
};

/// Where the line of least squares is 0, if they are on one that falls.
std::optional<double> zero_of_line(const std::vector<Square>& squares) {
  const auto count = static_cast<double>(squares.size());
  double u = 0, value = 0, uu = 0, uv = 0;
  for (const Square& s : squares) u += s.u / count, value += s.value / count;
  for (const Square& s : squares)
    uu += (s.u - u) * (s.u - u) / count, uv += (s.u - u) * (s.value - value) / count;
  if (!(uu > 0 && uv < 0)) return std::nullopt;
  const double slope = uv / uu;
  double off = 0;
  for (const Square& s : squares) off += std::pow(s.value - value - slope * (s.u - u), 2) / count;
  if (std::sqrt(off) > off_the_line * value) return std::nullopt;
  return u - value / slope;
}

std::size_t places(std::vector<Square> squares, double tiny) {
  std::sort(squares.begin(), squares.end(), [](const Square& a, const Square& b) { return a.u < b.u; });
  std::size_t count = squares.empty() ? 0 : 1;
  for (std::size_t i = 1; i < squares.size(); ++i)
    if (squares[i].u - squares[i - 1].u > tiny) ++count;
  return count;
}

}  // namespace

void place_fronts(std::vector<double>& tip, const OpenPairs& open) {
  for (std::size_t j = 1; j < tip.size(); ++j) {
    const auto u_of = [&](std::size_t p) { return open.samples[open.pairs[p][0]].uvw.x; };
    const auto count = static_cast<std::size_t>(open.released[j]);
    double last = -std::numeric_limits<double>::infinity();
    for (std::size_t p = 0; p < count; ++p) last = std::max(last, u_of(p));
    const double column = tip[j] - last;
    if (!(column > 0) || !std::isfinite(column)) continue;
    const auto d = open.frames[j];
    std::vector<Square> squares;
    for (std::size_t p = 0; p < count; ++p)
      if (u_of(p) > last - columns * column)
        squares.push_back({open.round ? u_of(p) * u_of(p) : u_of(p),
                           (d.row(open.pairs[p][1]) - d.row(open.pairs[p][0])).squaredNorm()});
    open.frames.forget(j);
    if (places(squares, 0.1 * column * (open.round ? last : 1)) < fewest) continue;
    std::optional<double> front = zero_of_line(squares);
    if (front && open.round) front = std::sqrt(*front);
    if (!front || *front > last + nearly_there * column) continue;
    tip[j] = std::max(*front, last + least * column);
  }
  for (std::size_t j = 1; j < tip.size(); ++j) tip[j] = std::max(tip[j], tip[j - 1]);
}

}  // namespace cleft
