#include "explorer/wound/beside_cut.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "explorer/wound/touched_at.h"

namespace cleft {

namespace {
/// Depths of the cut from its lips, over which what they lean falls by e.
constexpr double leaning_reach = 2. / 3;
/// Depths of the cut from it, up to which corners part beside one that opens into it, and so many times as
/// far along it; of how far that one leads away, at most so much.
constexpr double corners_to = 1.5, along_it = 2, most_of_branch = 0.5;

}  // namespace

double Crossing::reach() const { return branch == 0 ? fades : along_it * fades; }

BesideCut::BesideCut(const ActiveVertex& vertex, const Wound& wound)
    : s(vertex.s), along(vertex.along), outward(vertex.outward) {
  const CanonicalCut& cut = wound.field.shape().cut();
  across = std::exp(-std::abs(vertex.uvw.y) / (leaning_reach * cut.depth)) * vertex.across;
}

namespace {

/// The sine of the angle at which `cut` goes at s mm of its path to v > 0 of another one, there at other_s.
double sine_at(const Wound& cut, double s, const Wound& other, double other_s) {
  return dot(cut.volume.skin_frame(s / cut.scale()).along,
             other.volume.skin_frame(other_s / other.scale()).across);
}

void add_crossings(std::size_t i, std::size_t j, const std::vector<const Wound*>& cuts,
                   std::vector<Crossing>& found) {
  const Wound &cut = *cuts[i], &other = *cuts[j];
  const double depth = other.field.shape().cut().depth;
  for (const double s : touched_at(cut, other)) {
    const Vec3 place = cut.scale() / other.scale() * cut.incision->path().at(s / cut.scale()).position;
    const double other_s = other.scale() * other.incision->path().coordinates(place).s;
    const double sine = sine_at(cut, s, other, other_s);
    if (std::abs(sine) < turned_away) continue;
    const double fades = lean_fades * depth / std::abs(sine);
    const auto inside = [fades](double at, double length) { return fades < at && at < length - fades; };
    if (inside(s, cut.complete()) && inside(other_s, other.complete()))
      found.push_back({i, j, s, other_s, fades, sine > 0 ? 1. : -1.});
  }
}

void add_mouths(std::size_t i, std::size_t j, const std::vector<const Wound*>& cuts,
                std::vector<Crossing>& found) {
  const Wound &cut = *cuts[i], &later = *cuts[j];
  for (const bool at_end : {false, true}) {
    const std::optional<double> s = cut.mouth_of(later, at_end);
    if (!s) continue;
    const IncisionVolume::Mouth& mouth = *later.volume.mouth(at_end);
    const double other_s = at_end ? mouth.s - mouth.opens_on : mouth.opens_on, branch = mouth.right ? 1 : -1,
                 sine = std::max(turned_away, std::abs(sine_at(cut, *s, later, other_s))),
                 way = std::min(corners_to * cut.field.shape().cut().depth / sine,
                                most_of_branch * later.complete());
    found.push_back({i, j, *s, other_s, way * sine, at_end ? branch : -branch, branch, at_end, way});
  }
}

/// The side of a cut on which a vertex is, -1 or 1.
double side_of(const ActiveVertex& vertex) {
  return vertex.side == Side::left ? -1 : vertex.side == Side::right ? 1 : vertex.uvw.y < 0 ? -1 : 1;
}

}  // namespace

std::vector<Crossing> crossings_of(const std::vector<const Wound*>& cuts) {
  std::vector<Crossing> found;
  for (std::size_t i = 0; i < cuts.size(); ++i)
    for (std::size_t j = 0; j < cuts.size(); ++j) {
      if (i == j) continue;
      add_crossings(i, j, cuts, found);
      add_mouths(i, j, cuts, found);
    }
  return found;
}

void BesideCut::keep_with_own_piece(const ActiveVertex& vertex, int nearest, std::size_t cut,
                                    const std::vector<const Wound*>& cuts,
                                    std::span<const Crossing> crossings) {
  std::size_t mouths = 0;
  for (const Crossing& crossing : crossings) {
    if (crossing.cut != cut) continue;
    const std::size_t number = crossing.branch == 0 ? mouths : mouths++;
    const double from = vertex.s - crossing.s,
                 away = std::hypot(from / crossing.reach(), vertex.uvw.y / crossing.fades);
    if (away >= 1 || crossing.branch * side_of(vertex) < 0) continue;
    const std::optional<ActiveVertex> in_other = cuts[crossing.other]->volume.locate(nearest);
    if (!in_other) continue;
    const double behind = crossing.toward * side_of(*in_other);
    if (crossing.branch == 0) {
      // Both cuts part the corners: half of how far these are apart is due to each. Along a lip the part of
      // the other cut falls as that of its own grows.
      s += (1 - away) * corner_part * behind * crossing.fades;
      continue;
    }
    side = crossing.side(), corner_s = corner == 0 ? s : corner_s;
    corner_s = behind < 0 ? std::min(corner_s, crossing.before()) : std::max(corner_s, crossing.behind());
    if (const double part = 1 - away * away; part > corner) corner = part, mouth = number;
  }
}

}  // namespace cleft
