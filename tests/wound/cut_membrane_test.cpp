// Cuts in a membrane against closed forms.
#include "explorer/wound/cut_membrane.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

namespace cleft {

namespace {

constexpr double nu = 0.4, stiff = 1 / (1 - nu * nu), shear = 1 / (2 * (1 + nu));  // of a sheet with E = 1
constexpr int usual_pieces = 120;

/// Corners at places of the plane that are a function of 0 to 1.
std::vector<Eigen::Vector2d> along(int count, const std::function<Eigen::Vector2d(double)>& place) {
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i <= count; ++i) corners.push_back(place(double(i) / count));
  return corners;
}

/// How a straight cut from -half to half opens in its middle, under unit tension across it and unit shear;
/// turned by an angle.
std::array<double, 2> middle_openings(double reach, double half, double angle = 0,
                                      const CutMembrane::Springs& springs = {}, int pieces = usual_pieces) {
  const auto cut = along(pieces, [&](double part) -> Eigen::Vector2d {
    return half * (2 * part - 1) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  });
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(2 * pieces, 2);
  for (int i = 0; i < pieces; ++i) loads(2 * i + 1, 0) = loads(2 * i, 1) = 1;
  const Eigen::MatrixXd opened = CutMembrane(reach, nu, springs).openings(cut, loads);
  EXPECT_NEAR(opened(pieces, 0), 0, 1e-9 * half) << "a straight cut under tension does not slide";
  EXPECT_NEAR(opened(pieces + 1, 1), 0, 1e-9 * half);
  return {opened(pieces + 1, 0), opened(pieces, 1)};
}

/// How an endless straight cut opens under a unit load, in a sheet of modulus `modulus` whose springs are k
/// for long waves and k (1 + more w^2 / (w^2 + 1 / l^2)) for others: the jump spreads as exp(-rate x), with
/// rates whose squares solve x^2 - (1 / l^2 + k (1 + more) / modulus) x + k / (modulus l^2) = 0.
double endless_opening(double modulus, double k, double more, double l) {
  const double q = 1 / (l * l), sum = q + k * (1 + more) / modulus, product = k * q / modulus;
  const double greater = sum / 2 + std::sqrt(sum * sum / 4 - product), less = sum - greater;
  const double share = (q - less) / (greater - less);
  return 2 / (modulus * (share * std::sqrt(less) + (1 - share) * std::sqrt(greater)));
}

}  // namespace

TEST(CutMembrane, WithoutSpringsACutOpensAsGriffiths) {
  for (const double angle : {0., 0.7, 2.5})
    for (const double opened : middle_openings(1e6, 15, angle)) EXPECT_NEAR(opened, 4 * 15, 0.01 * 4 * 15);
}

TEST(CutMembrane, ALongCutOpensAsAnEndlessOne) {
  const double reach = 5, k = stiff / (reach * reach);
  {
    // (lambda + 2 mu) u'' = k u beside it under tension, mu u'' = k u in shear.
    const auto [tension, sheared] = middle_openings(reach, 30, 0, {0, 0, 0.2});
    EXPECT_NEAR(tension, 2 / std::sqrt(stiff * k), 0.01 * tension);
    EXPECT_NEAR(sheared, 2 / std::sqrt(shear * k), 0.01 * sheared);
  }
  for (const CutMembrane::Springs& springs :
       {CutMembrane::Springs{}, CutMembrane::Springs{-0.8, 3, 0.15}, CutMembrane::Springs{2, -0.5, 0.2}}) {
    const auto [tension, sheared] = middle_openings(reach, 30, 0.4, springs, 4 * usual_pieces);
    EXPECT_NEAR(tension, endless_opening(stiff, k, springs.dilating, springs.length * reach), 0.01 * tension);
    EXPECT_NEAR(sheared, endless_opening(shear, k, springs.shearing, springs.length * reach), 0.01 * sheared);
  }
}

namespace {

struct Straight {
  Eigen::Vector2d begin, end;
};

/// From a joint, in pieces that are ever longer: acute corners bend within their last millimetre. `backward`:
/// from the far end to the joint.
std::vector<Straight> from_joint(double degrees, double length, bool backward = false) {
  constexpr double finest = 0.15, growth = 1.5, coarsest = 0.6;
  const double angle = degrees * std::numbers::pi / 180;
  const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
  std::vector<Straight> result;
  double from = 0;
  for (double piece = finest; from < length; piece = std::min(coarsest, growth * piece)) {
    const double to = from + 1.5 * piece < length ? from + piece : length;
    result.push_back({from * along, to * along});
    from = to;
  }
  if (backward) {
    std::ranges::reverse(result);
    for (Straight& piece : result) std::swap(piece.begin, piece.end);
  }
  return result;
}

std::vector<Straight> joined(std::vector<Straight> pieces, const std::vector<Straight>& more) {
  pieces.insert(pieces.end(), more.begin(), more.end());
  return pieces;
}

/// How pieces open in skin with a tension along each axis, along and across each.
Eigen::VectorXd opened(const CutMembrane& membrane, const std::vector<Straight>& cuts,
                       const Eigen::Vector2d& tension) {
  const auto count = static_cast<Eigen::Index>(cuts.size());
  Eigen::MatrixXd taken(2 * count, 2 * count);
  Eigen::VectorXd tractions(2 * count);
  for (Eigen::Index to = 0; to < count; ++to) {
    const Eigen::Vector2d middle = (cuts[to].begin + cuts[to].end) / 2,
                          along = (cuts[to].end - cuts[to].begin).normalized();
    Eigen::Matrix2d frame;
    frame << along.x(), -along.y(), along.y(), along.x();
    tractions.segment<2>(2 * to) = frame.transpose() * tension.cwiseProduct(frame.col(1));
    for (Eigen::Index from = 0; from < count; ++from)
      taken.block<2, 2>(2 * to, 2 * from) = membrane.relief(frame.transpose() * (cuts[from].begin - middle),
                                                            frame.transpose() * (cuts[from].end - middle));
  }
  return taken.partialPivLu().solve(tractions);
}

/// The reach of the default skin with cuts 3 mm deep.
constexpr double default_reach = 17;
/// Pieces from a joint to the one whose middle is 0.54 mm from it, and to that at 1.22 mm.
constexpr Eigen::Index half_a_mm = 2, one_mm = 3;

}  // namespace

/// Two cuts that cross in their middles in skin that is pulled 1 : 3, the second across the first one.
/// Simulated with elements of 0.5 mm, beside the crossing they open by these parts of what they open alone.
TEST(CutMembrane, CutsThatCrossOpenAsSimulated) {
  struct Simulated {
    double degrees, length, first, second;
  };
  const CutMembrane membrane(default_reach, nu);
  for (const Simulated& s : {Simulated{45, 30, 0.83, 0.27},
                             {45, 50, 0.77, 0.36},
                             {45, 20, 0.88, 0.19},
                             {60, 30, 0.93, 0.15},
                             {75, 30, 0.99, 0.02}}) {
    const Eigen::Vector2d tension(0.01, 0.03);
    std::array<std::vector<Straight>, 2> cuts;
    for (const int cut : {0, 1})
      cuts[cut] = joined(from_joint(180 + cut * s.degrees, s.length / 2, true),
                         from_joint(cut * s.degrees, s.length / 2));
    const Eigen::VectorXd both = opened(membrane, joined(cuts[0], cuts[1]), tension);
    const auto of_one = static_cast<Eigen::Index>(cuts[0].size());
    const auto over_alone = [&](int cut) {
      const Eigen::Index beside = 2 * (of_one / 2 + half_a_mm) + 1;
      return both(2 * cut * of_one + beside) / opened(membrane, cuts[cut], tension)(beside);
    };
    EXPECT_NEAR(over_alone(0), s.first, 0.05) << s.degrees << " degrees, " << s.length << " mm";
    EXPECT_NEAR(over_alone(1), s.second, 0.05) << s.degrees << " degrees, " << s.length << " mm";
  }
}

// The corner between a branch and the cut that it leaves is thin, and bends toward either. Openings of the
// simulated default case with elements of 0.5 mm, over that in the middle of a cut of 30 mm in skin that is
// pulled by 0.03 MPa across it (5.51 mm).
TEST(CutMembrane, AcuteCornersOfABranchMoveAsSimulated) {
  const CutMembrane membrane(default_reach, nu);
  const std::vector<Straight> before = from_joint(180, 15, true), behind = from_joint(0, 15),
                              branch = from_joint(45, 20), whole = joined(before, behind);
  const auto middle = static_cast<Eigen::Index>(before.size());
  const double usual = opened(membrane, whole, {0.01, 0.03})(2 * middle + 1);
  const Eigen::VectorXd all = opened(membrane, joined(whole, branch), {0.03, 0.01}) / usual;
  const auto at = [&](Eigen::Index piece) -> Eigen::Vector2d { return all.segment<2>(2 * piece); };
  const Eigen::Vector2d of_cut = at(middle + one_mm), of_branch = at(2 * middle + one_mm);
  EXPECT_NEAR(of_cut.x(), 2.505 / 5.51, 0.05);
  EXPECT_NEAR(of_cut.y(), 0.995 / 5.51, 0.05);
  EXPECT_NEAR(of_branch.x(), -2.657 / 5.51, 0.05);
  EXPECT_NEAR(of_branch.y(), 3.557 / 5.51, 0.05);
}

TEST(CutMembrane, NearTheEndsOfAnArcItSlidesAndOpensAsItsStressIntensities) {
  // An arc of half an angle a, pulled alike in all directions: K_II / K_I = tan(a / 2) (Muskhelishvili).
  for (const double half_angle : {0.3, 0.8, 1.3}) {
    const auto cut = along(usual_pieces, [&](double part) {
      const double a = half_angle * (2 * part - 1);
      return Eigen::Vector2d(20 * std::sin(a), 20 * (1 - std::cos(a)));
    });
    Eigen::MatrixXd load = Eigen::MatrixXd::Zero(2 * usual_pieces, 1);
    for (int i = 0; i < usual_pieces; ++i) load(2 * i + 1, 0) = 1;
    const Eigen::MatrixXd opened = CutMembrane(1e6, nu).openings(cut, load);
    // The ratio at the end, from those at two pieces next to it.
    const auto ratio = [&](int piece) { return std::abs(opened(2 * piece, 0) / opened(2 * piece + 1, 0)); };
    EXPECT_NEAR(1.5 * ratio(3) - 0.5 * ratio(10), std::tan(half_angle / 2), 0.04 * std::tan(half_angle / 2))
        << half_angle;
  }
}

TEST(CutMembrane, WorkOfOneLoadThroughTheOpeningOfAnotherIsMutual) {
  // Betti: of any path, with springs.
  const auto cut = along(40, [](double part) { return Eigen::Vector2d(30 * part, 5 * std::sin(10 * part)); });
  Eigen::MatrixXd loads(80, 2);
  for (int i = 0; i < 80; ++i) loads(i, 0) = std::sin(0.3 * i), loads(i, 1) = std::cos(0.17 * i * i);
  const Eigen::MatrixXd opened = CutMembrane(12, nu).openings(cut, loads);
  double one = 0, other = 0, own = 0;
  for (int i = 0; i < 40; ++i) {
    const double length = (cut[i + 1] - cut[i]).norm();
    for (int c = 0; c < 2; ++c) {
      one += length * loads(2 * i + c, 0) * opened(2 * i + c, 1);
      other += length * loads(2 * i + c, 1) * opened(2 * i + c, 0);
      own += length * loads(2 * i + c, 0) * opened(2 * i + c, 0);
    }
  }
  EXPECT_NEAR(one, other, 0.02 * own);
  EXPECT_GT(own, 0);
}

}  // namespace cleft
