#include "explorer/wound/membrane_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "explorer/wound/touched_at.h"

namespace cleft {

namespace {

/// Stretches of a cut (canonical_stretch).
constexpr int most_stretches = 90, fewest_stretches = 8;
/// A stretch is one piece; of so many next to a joint each is two, and the one at the joint is four, which
/// end at these parts of it: openings change most there, above all where corners are acute.
constexpr int halved_stretches = 6;
constexpr std::array<double, 3> next_to_joint = {2. / 16, 5. / 16, 9. / 16};
/// Likewise of a stretch by which a cut is led on beyond a joint, to see how it opens alone: openings of the
/// cut alone differ by less than 0.002 of the largest from those with twice as many.
constexpr int pieces_beyond = 4;
/// In stretches: they are longer, and end where cuts touch.
constexpr double shortest_stretch = 0.3;

using Joint = MembraneCut::Joint;

/// Where a cut begins, touches others and ends, without joints that are nearer to each other than
/// `shortest_way` (mm). What is beyond cuts that it begins and ends in opens nothing.
std::vector<Joint> ends_of(const Wound& wound, std::vector<Joint> joints, double shortest_way) {
  std::ranges::sort(joints, {}, &Joint::s);
  Joint start{0, {}}, end{wound.complete(), {}};
  const auto joined = [&](Joint& own, const Joint& joint, bool at_end) {
    own.place = joint.place;
    if (wound.volume.mouth(at_end)) own.s = joint.s;
  };
  if (!joints.empty() && joints.front().s < shortest_way) joined(start, joints.front(), false);
  if (!joints.empty() && end.s - joints.back().s < shortest_way) joined(end, joints.back(), true);
  std::vector<Joint> result = {start};
  for (const Joint& joint : joints)
    if (joint.s - result.back().s >= shortest_way && end.s - joint.s >= shortest_way) result.push_back(joint);
  result.push_back(end);
  return result;
}

/// Where the pieces of a stretch meet, as parts of it, with so many stretches between it and a joint before
/// it and behind it.
std::vector<double> between_pieces(int from_joint, int to_joint) {
  std::vector<double> result;
  for (const double part : next_to_joint) {
    if (from_joint == 0) result.push_back(part);
    if (to_joint == 0) result.push_back(1 - part);
  }
  std::ranges::sort(result);
  if (result.empty() && std::min(from_joint, to_joint) < halved_stretches) result.push_back(0.5);
  return result;
}

}  // namespace

MembraneCut::MembraneCut(const Wound& wound, std::vector<Joint> joints) {
  const double length = wound.complete();
  const double stretch =
      std::clamp(canonical_stretch(wound), length / most_stretches, length / fewest_stretches);
  const std::vector<Joint> ends = ends_of(wound, std::move(joints), shortest_stretch * stretch);
  corners.push_back(ends.front().s);
  ends_in_another = wound.volume.mouth(true).has_value();
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const Joint &from = ends[i], &to = ends[i + 1];
    const int count = std::max(1, static_cast<int>(std::lround((to.s - from.s) / stretch)));
    const std::size_t first = pieces.size();
    for (int k = 0; k < count; ++k) {
      const int from_joint = from.place ? k : halved_stretches,
                to_joint = to.place ? count - 1 - k : halved_stretches;
      add_stretch(wound, std::lerp(from.s, to.s, (k + 1.) / count), between_pieces(from_joint, to_joint));
    }
    if (from.place) pieces[first].begin = *from.place;
    if (to.place) pieces.back().end = *to.place;
  }
}

std::vector<double> MembraneCut::stations() const {
  std::vector<double> result;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) result.push_back((corners[i] + corners[i + 1]) / 2);
  return result;
}

Eigen::VectorXd MembraneCut::means(const Eigen::VectorXd& of_pieces, std::size_t first) const {
  const Eigen::Index begin = first_pieces[first], end = begin + of_pieces.size() / 2;
  std::vector<Eigen::Vector2d> result;
  for (std::size_t i = first; i < stretches() && first_pieces[i] < end; ++i) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    double length = 0;
    for (Eigen::Index k = first_pieces[i]; k < first_pieces[i + 1]; ++k) {
      const Piece& piece = pieces[static_cast<std::size_t>(k)];
      const double part = piece.length();
      sum += part * of_pieces.segment<2>(2 * (k - begin)), length += part;
    }
    result.push_back(sum / length);
  }
  return Eigen::Map<const Eigen::VectorXd>(result.empty() ? nullptr : result.front().data(),
                                           2 * static_cast<Eigen::Index>(result.size()));
}

MembraneCut::Beside MembraneCut::beside(std::size_t piece) const {
  const auto next = std::ranges::upper_bound(first_pieces, static_cast<Eigen::Index>(piece));
  const auto first = static_cast<std::size_t>(next[-1]), last = static_cast<std::size_t>(*next) - 1;
  const auto half = [&](std::size_t i) { return pieces[i].length() / 2; };
  Beside result{std::max(piece, first + 1) - 1, std::min(piece + 1, last), 0};
  double way = 0;
  for (std::size_t i = result.before; i < result.behind; ++i) way += half(i) + half(i + 1);
  if (way > 0) result.part = half(piece) / way;
  return result;
}

MembraneCut MembraneCut::begun_before(int count) const {
  MembraneCut result = *this;
  const double length = first_stretch();
  for (int i = 0; i < count; ++i) {
    for (int piece = 0; piece < pieces_beyond; ++piece) {
      const Piece& next = result.pieces.front();
      const Vec3 back = -length / pieces_beyond * next.frame.along;
      result.pieces.insert(result.pieces.begin(),
                           {next.begin + back, next.begin + 0.5 * back, next.begin, next.frame, next.s});
    }
    result.corners.insert(result.corners.begin(), result.corners.front() - length);
    for (Eigen::Index& first : result.first_pieces) first += pieces_beyond;
    result.first_pieces.insert(result.first_pieces.begin(), 0);
  }
  return result;
}

MembraneCut MembraneCut::run_on(int count, double way) const {
  MembraneCut result = *this;
  for (int i = 0; i < count; ++i) {
    for (int piece = 0; piece < pieces_beyond; ++piece) {
      const Piece& last = result.pieces.back();
      const Vec3 on = way / count / pieces_beyond * last.frame.along;
      result.pieces.push_back({last.end, last.end + 0.5 * on, last.end + on, last.frame, last.s});
    }
    result.end_stretch(result.corners.back() + way / count);
  }
  return result;
}

/// On to `end`, mm, in pieces that meet at these parts of it.
void MembraneCut::add_stretch(const Wound& wound, double end, std::vector<double> parts) {
  const double begin = corners.back(), scale = wound.scale();
  const auto place = [&](double s) { return scale * wound.incision->path().at(s / scale).position; };
  parts.push_back(1);
  double from = begin;
  for (const double part : parts) {
    const double to = std::lerp(begin, end, part), middle = (from + to) / 2;
    pieces.push_back(
        {place(from), place(middle), place(to), wound.volume.skin_frame(middle / scale), middle});
    from = to;
  }
  end_stretch(end);
}

void MembraneCut::end_stretch(double at) {
  corners.push_back(at);
  first_pieces.push_back(static_cast<Eigen::Index>(pieces.size()));
}

}  // namespace cleft
