// Cuts in a membrane against closed forms.
#include "explorer/wound/cut_membrane.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <numbers>

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

/// Two cuts that cross in their middles in skin that is pulled 1 : 3, the second across the first one.
/// Simulated with elements of 0.5 mm, beside the crossing they open by these parts of what they open alone.
TEST(CutMembrane, CutsThatCrossOpenAsSimulated) {
  constexpr double reach = 17, piece = 1.2, along_first = 0.01, across_first = 0.03;
  struct Simulated {
    double degrees, length, first, second;
  };
  for (const Simulated& s : {Simulated{45, 30, 0.83, 0.27},
                             {45, 50, 0.77, 0.36},
                             {45, 20, 0.88, 0.19},
                             {60, 30, 0.93, 0.15},
                             {75, 30, 0.99, 0.02}}) {
    struct Straight {
      Eigen::Vector2d begin, end;
    };
    const int of_one = 2 * static_cast<int>(std::lround(s.length / piece / 2));
    std::vector<Straight> cuts;
    for (const double angle : {0., s.degrees * std::numbers::pi / 180})
      for (int i = 0; i < of_one; ++i) {
        const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
        cuts.push_back({s.length * (double(i) / of_one - 0.5) * along,
                        s.length * (double(i + 1) / of_one - 0.5) * along});
      }
    const auto count = static_cast<Eigen::Index>(cuts.size());
    const CutMembrane membrane(reach, nu);
    Eigen::MatrixXd taken(2 * count, 2 * count);
    Eigen::VectorXd tractions(2 * count);
    for (Eigen::Index to = 0; to < count; ++to) {
      const Eigen::Vector2d middle = (cuts[to].begin + cuts[to].end) / 2,
                            along = (cuts[to].end - cuts[to].begin).normalized();
      Eigen::Matrix2d frame;
      frame << along.x(), -along.y(), along.y(), along.x();
      const Eigen::Vector2d across = frame.col(1);
      tractions.segment<2>(2 * to) =
          frame.transpose() * Eigen::Vector2d(along_first * across.x(), across_first * across.y());
      for (Eigen::Index from = 0; from < count; ++from)
        taken.block<2, 2>(2 * to, 2 * from) = membrane.relief(frame.transpose() * (cuts[from].begin - middle),
                                                              frame.transpose() * (cuts[from].end - middle));
    }
    const Eigen::VectorXd both = taken.partialPivLu().solve(tractions);
    const auto over_alone = [&](int cut) {
      const Eigen::Index first = 2 * cut * of_one, beside = of_one + 1;
      const Eigen::VectorXd alone = taken.block(first, first, 2 * of_one, 2 * of_one)
                                        .partialPivLu()
                                        .solve(tractions.segment(first, 2 * of_one));
      return both(first + beside) / alone(beside);
    };
    EXPECT_NEAR(over_alone(0), s.first, 0.05) << s.degrees << " degrees, " << s.length << " mm";
    EXPECT_NEAR(over_alone(1), s.second, 0.05) << s.degrees << " degrees, " << s.length << " mm";
  }
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
