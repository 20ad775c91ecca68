#include "haptic/surface_stiffness.h"

#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "base/error.h"

namespace cleft {

namespace {

constexpr double radius = stiffness_radius;

/// One of the four solutions in a layer for the wave number x: displacements U sin(x r), W cos(x r) in a
/// plane (J1 and J0 about an axis), their derivatives in z, and lambda times the divergence.
struct Mode {
  double u, w, du, dw, lambda_div;
};

/// Two that decay downward from z = 0, two that decay upward from z = -height.
std::array<Mode, 4> modes(const SkinLayer& layer, double x, double z) {
  const double nu = layer.poisson_ratio, kappa = 3 - 4 * nu;
  const double mu = layer.young_modulus / (2 * (1 + nu)), s = x * z;
  const double down = std::exp(s), up = std::exp(-s - x * layer.height);
  return {{{-down, down, -x * down, x * down, 0},
           {-s * down, (s - kappa) * down, -x * (s + 1) * down, x * (s - kappa + 1) * down,
            -4 * mu * nu * x * down},
           {-up, -up, x * up, x * up, 0},
           {s * up, (s + kappa) * up, x * (1 - s) * up, x * (1 - s - kappa) * up, -4 * mu * nu * x * up}}};
}

/// Gaussian elimination with pivots; the last column is the right-hand side.
std::array<double, 4> solved(std::array<std::array<double, 5>, 4> a) {
  for (std::size_t i = 0; i < 4; ++i) {
    std::size_t pivot = i;
    for (std::size_t r = i + 1; r < 4; ++r)
      if (std::abs(a[r][i]) > std::abs(a[pivot][i])) pivot = r;
    std::swap(a[i], a[pivot]);
    for (std::size_t r = i + 1; r < 4; ++r)
      for (std::size_t c = 5; c-- > i;) a[r][c] -= a[r][i] / a[i][i] * a[i][c];
  }
  std::array<double, 4> x{};
  for (std::size_t i = 4; i-- > 0;) {
    x[i] = a[i][4];
    for (std::size_t c = i + 1; c < 4; ++c) x[i] -= a[i][c] * x[c];
    x[i] /= a[i][i];
  }
  return x;
}

/// x times how far the skin sinks under the pressure cos(x r), or J0.
double sinking(const SkinLayer& layer, double x) {
  const double mu = layer.young_modulus / (2 * (1 + layer.poisson_ratio));
  const auto top = modes(layer, x, 0), bottom = modes(layer, x, -layer.height);
  std::array<std::array<double, 5>, 4> a{};
  for (std::size_t i = 0; i < 4; ++i) {
    const Mode &t = top[i], &b = bottom[i];
    a[0][i] = t.lambda_div + 2 * mu * t.dw;
    a[1][i] = mu * (t.du - x * t.w) + layer.membrane * x * x * t.u;
    a[2][i] = b.lambda_div + 2 * mu * b.dw - layer.foundation * b.w;
    a[3][i] = mu * (b.du - x * b.w) - layer.foundation * b.u;
  }
  a[0][4] = -1;
  const auto part = solved(a);
  double w = 0;
  for (std::size_t i = 0; i < 4; ++i) w += part[i] * top[i].w;
  return -x * w;
}

}  // namespace

double half_space_profile(double distance) {
  const double x = distance / radius;
  const double sunk = x <= 1
                          ? std::comp_ellint_2(x)
                          : x * (std::comp_ellint_2(1 / x) - (1 - 1 / (x * x)) * std::comp_ellint_1(1 / x));
  return 2 / std::numbers::pi * sunk;
}

std::vector<double> layer_compliances(const SkinLayer& layer, std::span<const double> distances) {
  // The pressure of the disc is a J1(a x) / x. Short waves only feel what is near, and sink as 1 / x: theirs
  // is the closed form, and the rest falls as x^-2.5 or faster.
  constexpr int pieces = 2000;
  constexpr double farthest = 120;  // over a
  const double near = sinking(layer, 1e3 * farthest / radius);
  std::vector<double> sums;
  for (const double distance : distances) sums.push_back(near * half_space_profile(distance));
  for (int i = 0; i < pieces; ++i) {
    const double part = (i + 0.5) / pieces, x = farthest * part * part;
    const double wave =
        (sinking(layer, x / radius) - near) * std::cyl_bessel_j(1., x) / x * 2 * farthest * part / pieces;
    for (std::size_t k = 0; k < sums.size(); ++k)
      sums[k] += wave * (distances[k] > 0 ? std::cyl_bessel_j(0., x * distances[k] / radius) : 1);
  }
  for (double& sum : sums) sum *= radius;
  return sums;
}

double layer_compliance(const SkinLayer& layer) {
  const double middle = 0;
  return layer_compliances(layer, std::span(&middle, 1)).front();
}

double punch_stiffness(const SkinLayer& layer, double radius) {
  // The punch sinks by the work of its pressure, P / (2 pi a sqrt(a^2 - r^2)), over P: P / (2 pi) times the
  // integral of sinking(x) (sin(a x) / (a x))^2. Of short waves as above.
  constexpr int pieces = 100;
  constexpr double farthest = 20;  // over a
  const double near = sinking(layer, 1e5 / radius);
  double sum = near * std::numbers::pi / 2;
  for (int i = 0; i < pieces; ++i) {
    const double part = (i + 0.5) / pieces, x = farthest * part * part, wave = std::sin(x) / x;
    sum += (sinking(layer, x / radius) - near) * wave * wave * 2 * farthest * part / pieces;
  }
  return 2 * std::numbers::pi * radius / sum;
}

double stiffness_from_compliance(double compliance) {
  if (!(compliance > 0))
    throw InputError("a compliance of " + std::to_string(compliance) + " mm/MPa is none");
  return std::numbers::pi * radius * radius / compliance;
}

double surface_stiffness(const Field& field) {
  const CanonicalCut& cut = field.cut();
  for (std::size_t i = 0; i < field.quantities.size(); ++i) {
    if (field.quantities[i].name != "compliance" || field.quantities[i].components != 1) continue;
    double compliance = 0;
    field.quantity(i, {cut.start + cut.length / 2, 0, 0}, Side::both, 0, std::span(&compliance, 1));
    return stiffness_from_compliance(compliance);
  }
  const double modulus = field.parameters->tissue.young_modulus, nu = field.parameters->tissue.poisson_ratio;
  if (std::isnan(modulus) || std::isnan(nu))
    throw InputError("the field knows neither a compliance nor its tissue's modulus: give --stiffness");
  const auto layer = skin_layer(field);
  return stiffness_from_compliance(layer ? layer_compliance(*layer) : 2 * radius * (1 - nu * nu) / modulus);
}

std::optional<SkinLayer> skin_layer(const Field& field) { return skin_layer(*field.parameters); }

std::optional<SkinLayer> skin_layer(const Parameters& p) {
  const double skin_nu = p.skin.poisson_ratio;
  const SkinLayer layer{p.tissue.young_modulus, p.tissue.poisson_ratio, p.patch.height,
                        p.foundation.stiffness,
                        p.skin.young_modulus * p.skin.thickness / (1 - skin_nu * skin_nu)};
  const bool known = layer.young_modulus > 0 && !std::isnan(layer.poisson_ratio) && layer.height > 0 &&
                     layer.foundation > 0 && !std::isnan(layer.membrane);
  return known ? std::optional(layer) : std::nullopt;
}

}  // namespace cleft
