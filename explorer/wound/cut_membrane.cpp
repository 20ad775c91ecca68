#include "explorer/wound/cut_membrane.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "params/material/isotropic.h"

namespace cleft {

namespace {

using Tensor = Eigen::Matrix2d;
using Vector = Eigen::Vector2d;

/// The table is even in the logarithm of the distance over the reach. Nearer, the smooth part is linear in
/// it; beyond, it is what makes the whole 0.
constexpr double nearest = 1e-3, farthest = 30;
constexpr int places = 400;
const double log_step = std::log(farthest / nearest) / places;

/// A point of Gauss's rule on (-1, 1): of four for a piece and those next to it, where the smooth part is
/// logarithmic, of one for others.
struct GaussPoint {
  double place, weight;
};
constexpr std::array<GaussPoint, 4> four_points = {{{-0.8611363115940526, 0.3478548451374538},
                                                    {-0.3399810435848563, 0.6521451548625461},
                                                    {0.3399810435848563, 0.6521451548625461},
                                                    {0.8611363115940526, 0.3478548451374538}}};
constexpr std::array<GaussPoint, 1> one_point = {{{0, 2}}};
constexpr double near_pieces = 1.5;  // lengths of a piece
/// Of half a piece: what is nearer counts as so near.
constexpr double near_part = 0.3;

/// The derivatives of K0(c r) by r, the first to the fourth.
std::array<double, 4> bessel_derivatives(double c, double r) {
  const double z = c * r, k0 = std::cyl_bessel_k(0, z), k1 = std::cyl_bessel_k(1, z);
  return {-c * k1, c * c * (k0 + k1 / z), -c * c * c * (k1 + k0 / z + 2 * k1 / (z * z)),
          c * c * c * c * (k0 + 2 * k1 / z + 3 * k0 / (z * z) + 6 * k1 / (z * z * z))};
}

/// Of a function of the distance, from its derivatives: the second ones along and across the direction to the
/// place.
std::array<double, 2> second_derivatives(const std::array<double, 4>& f, double r) {
  return {f[1], f[0] / r};
}

/// The fourth ones: along four times, along and across twice each, across four times.
std::array<double, 3> fourth_derivatives(const std::array<double, 4>& f, double r) {
  const double g1 = f[0] / r, g2 = f[1] - g1, g3 = r * f[2] - 3 * g2;
  return {f[3], (g3 + g2) / (r * r), 3 * g2 / (r * r)};
}

/// A solution that falls as exp(-rate r), and its share.
struct Decay {
  double rate, share;
};

/// 1 / (w^2 + k (1 + more w^2 / (w^2 + q))) as shares of 1 / (w^2 + rate^2).
std::array<Decay, 2> two_decays(double k, double more, double q) {
  // Of a quadratic in the squares of the rates: their sum and their product.
  const double sum = q + k * (1 + more), product = k * q, root = std::sqrt(sum * sum / 4 - product);
  const double less = product / (sum / 2 + root), greater = sum / 2 + root;
  return {{{std::sqrt(less), (q - less) / (greater - less)},
           {std::sqrt(greater), (greater - q) / (greater - less)}}};
}

/// The stress of an edge dislocation with a jump along each axis, in a sheet without springs, at a place.
std::array<Tensor, 2> dislocation_stress(const Vector& at, double factor) {
  const double x = at.x(), y = at.y(), r4 = at.squaredNorm() * at.squaredNorm();
  const double d = factor / r4, x2 = x * x, y2 = y * y;
  std::array<Tensor, 2> stress;
  stress[0] << -d * y * (3 * x2 + y2), d * x * (x2 - y2), d * x * (x2 - y2), d * y * (x2 - y2);
  stress[1] << d * x * (x2 - y2), d * y * (x2 - y2), d * y * (x2 - y2), d * x * (x2 + 3 * y2);
  return stress;
}

/// Its integral along the first axis of the place.
std::array<Tensor, 2> integrated_stress(const Vector& at, double factor) {
  const double x = at.x(), y = at.y(), r2 = at.squaredNorm();
  const double mixed = x * y / r2, squared = y * y / r2, logarithm = std::log(r2) / 2,
               angle = y == 0 ? 0 : std::atan(x / y);
  std::array<Tensor, 2> stress;
  stress[0] << mixed - 2 * angle, logarithm + squared, logarithm + squared, -mixed;
  stress[1] << logarithm + squared, -mixed, -mixed, logarithm - squared;
  for (Tensor& one : stress) one *= factor;
  return stress;
}

}  // namespace

CutMembrane::CutMembrane(double reach, double poisson_ratio, const Springs& springs) : reach_(reach) {
  const IsotropicSheet sheet(1, poisson_ratio);
  shear_ = sheet.modulus * (1 - poisson_ratio) / 2, lame_ = sheet.modulus * poisson_ratio;
  // Lengths in the reach: k over the modulus of the waves that dilate is 1.
  const double stiff = lame_ + 2 * shear_, soft = shear_ / stiff, q = 1 / (springs.length * springs.length);
  const auto dilating = two_decays(1, springs.dilating, q),
             shearing = two_decays(1 / soft, springs.shearing, q);
  std::vector<Derivatives> table;
  for (int i = 0; i <= places; ++i) {
    const double r = nearest * std::exp(i * log_step);
    std::array<double, 4> transverse{}, both{};
    for (int n = 0; n < 2; ++n) {
      const Decay &shears = shearing[n], &dilates = dilating[n];
      const auto by_shear = bessel_derivatives(shears.rate, r),
                 by_dilation = bessel_derivatives(dilates.rate, r);
      for (int d = 0; d < 4; ++d) {
        transverse[d] += shears.share * by_shear[d];
        both[d] += shears.share / (shears.rate * shears.rate) * by_shear[d] -
                   soft * dilates.share / (dilates.rate * dilates.rate) * by_dilation[d];
      }
    }
    // Without springs: -log r, and -(1 - soft) / 4 r^2 log r.
    const double c = -(1 - soft) / 4, log_r = std::log(r);
    const std::array<double, 4> unheld = {-1 / r, 1 / (r * r), 0, 0},
                                unheld_both = {c * r * (2 * log_r + 1), c * (2 * log_r + 3), 2 * c / r,
                                               -2 * c / (r * r)};
    const auto second = second_derivatives(transverse, r), second_unheld = second_derivatives(unheld, r);
    const auto fourth = fourth_derivatives(both, r), fourth_unheld = fourth_derivatives(unheld_both, r);
    table.push_back({second[0] - second_unheld[0], second[1] - second_unheld[1], fourth[0] - fourth_unheld[0],
                     fourth[1] - fourth_unheld[1], fourth[2] - fourth_unheld[2]});
  }
  table_ = std::make_shared<const std::vector<Derivatives>>(std::move(table));
}

CutMembrane::Derivatives CutMembrane::smooth_part(double distance) const {
  const double place = std::log(distance / reach_ / nearest) / log_step;
  const int before = std::clamp(static_cast<int>(place), 0, places - 1);
  // As 1 / r^2 beyond the table: the smooth part is minus that without springs.
  const double part = std::min(place, double(places)) - before,
               beyond = std::exp(-2 * log_step * std::max(0., place - places));
  Derivatives result;
  for (int n = 0; n < 5; ++n)
    result[n] = beyond * std::lerp((*table_)[before][n], (*table_)[before + 1][n], part) / (reach_ * reach_);
  return result;
}

Eigen::Matrix<double, 2, 4> CutMembrane::linear_relief(const Vector& begin, const Vector& end) const {
  const Vector middle = (begin + end) / 2, along = (end - begin).normalized();
  const double half = (end - begin).norm() / 2, least = near_part * half;
  Tensor frame;  // columns: along and across the opening
  frame << along.x(), -along.y(), along.y(), along.x();
  // A path that turns back within a piece would feel it as much as it is singular.
  const auto not_too_near = [&](const Vector& way) -> Vector {
    return way.norm() < least ? Vector(least * (way.norm() > 0 ? way.normalized() : Vector(1, 0))) : way;
  };
  const double poisson = lame_ / (lame_ + 2 * shear_), kappa = (3 - poisson) / (1 + poisson);
  const double of_dislocation = 2 * shear_ / (std::numbers::pi * (kappa + 1)),
               of_unit_force = 1 / (2 * std::numbers::pi * shear_);
  const Vector across(0, 1), across_there = frame.transpose() * across;
  const Vector from_begin = frame.transpose() * not_too_near(-begin),
               from_end = frame.transpose() * not_too_near(-end);
  const auto at_begin = dislocation_stress(from_begin, of_dislocation),
             at_end = dislocation_stress(from_end, of_dislocation);
  // A linear opening is one of dislocations all along it, and at its ends.
  const auto to_begin = integrated_stress(from_begin, of_dislocation / half),
             to_end = integrated_stress(from_end, of_dislocation / half);
  Eigen::Matrix<double, 2, 4> taken;
  for (int a = 0; a < 2; ++a) {
    taken.col(a) = frame * ((at_begin[a] - at_end[a]) * across_there);
    taken.col(2 + a) = frame * ((to_begin[a] - to_end[a] - at_begin[a] - at_end[a]) * across_there);
  }
  const std::span<const GaussPoint> rule =
      middle.norm() < 2 * near_pieces * half ? std::span<const GaussPoint>(four_points) : one_point;
  for (const auto& [part, weight] : rule) {
    const Vector way = not_too_near(-middle - half * part * along);
    const double distance = way.norm();
    const Derivatives d = smooth_part(distance);
    Tensor polar;  // columns: to the place, and across that
    polar.col(0) = way / distance, polar.col(1) = Vector(-polar(1, 0), polar(0, 0));
    const Tensor source = polar.transpose() * frame;
    const Vector line = polar.transpose() * across, from_across = source.col(1);
    // Of the displacement along i under a unit force along j, by k and l, in the polar frame.
    const auto derivative = [&](int i, int j, int k, int l) {
      const int times_across = i + j + k + l;
      const double fourth = times_across % 2 == 1 ? 0 : d[2 + times_across / 2];
      return of_unit_force * ((i == j && k == l ? d[k] : 0) - fourth);
    };
    for (int a = 0; a < 2; ++a) {
      const Vector jump = source.col(a);
      const Tensor moment = lame_ * jump.dot(from_across) * Tensor::Identity() +
                            shear_ * (jump * from_across.transpose() + from_across * jump.transpose());
      Tensor gradient = Tensor::Zero();  // of the displacement: row p, derivative by q
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q)
          for (int b = 0; b < 2; ++b)
            for (int k = 0; k < 2; ++k) gradient(p, q) += moment(b, k) * derivative(p, b, k, q);
      const Tensor stress =
          lame_ * gradient.trace() * Tensor::Identity() + shear_ * (gradient + gradient.transpose());
      const Vector traction = weight * half * (polar * (stress * line));
      taken.col(a) += traction, taken.col(2 + a) += part * traction;
    }
  }
  return taken;
}

Eigen::MatrixXd CutMembrane::openings(const std::vector<Vector>& corners,
                                      const Eigen::MatrixXd& tractions) const {
  const auto pieces = static_cast<Eigen::Index>(corners.size()) - 1;
  Eigen::MatrixXd taken(2 * pieces, 2 * pieces);
  for (Eigen::Index to = 0; to < pieces; ++to) {
    const Vector middle = (corners[to] + corners[to + 1]) / 2,
                 along = (corners[to + 1] - corners[to]).normalized();
    Tensor frame;
    frame << along.x(), -along.y(), along.y(), along.x();
    const auto seen = [&](const Vector& corner) -> Vector { return frame.transpose() * (corner - middle); };
    for (Eigen::Index from = 0; from < pieces; ++from)
      taken.block<2, 2>(2 * to, 2 * from) = relief(seen(corners[from]), seen(corners[from + 1]));
  }
  return taken.partialPivLu().solve(tractions);
}

}  // namespace cleft
