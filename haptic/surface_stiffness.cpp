#include "haptic/surface_stiffness.h"

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <tuple>
#include <utility>

#include "base/error.h"

namespace cleft {

namespace {

constexpr double radius = stiffness_radius;

/// One of the four solutions in a layer for the wave number x: displacements U sin(x r), W cos(x r) in a
/// plane (J1 and J0 about an axis), and the stresses on a plane of the layer, across it and along it.
struct Mode {
  double u, w, normal, shear;
};

/// Two that decay downward from z = 0, two that decay upward from z = -height.
std::array<Mode, 4> modes(const TissueLayerBelow& layer, double x, double z) {
  const double nu = layer.poisson_ratio, kappa = 3 - 4 * nu;
  const double mu = layer.young_modulus / (2 * (1 + nu)), s = x * z;
  const double down = std::exp(s), up = std::exp(-s - x * layer.height);
  const auto mode = [&](double u, double w, double du, double dw, double lambda_div) {
    return Mode{u, w, lambda_div + 2 * mu * dw, mu * (du - x * w)};
  };
  return {mode(-down, down, -x * down, x * down, 0),
          mode(-s * down, (s - kappa) * down, -x * (s + 1) * down, x * (s - kappa + 1) * down,
               -4 * mu * nu * x * down),
          mode(-up, -up, x * up, x * up, 0),
          mode(s * up, (s + kappa) * up, x * (1 - s) * up, x * (1 - s - kappa) * up, -4 * mu * nu * x * up)};
}

/// Gaussian elimination with pivots; the last column is the right-hand side.
std::vector<double> solved(std::vector<std::vector<double>> a) {
  const std::size_t n = a.size();
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t pivot = i;
    for (std::size_t r = i + 1; r < n; ++r)
      if (std::abs(a[r][i]) > std::abs(a[pivot][i])) pivot = r;
    std::swap(a[i], a[pivot]);
    for (std::size_t r = i + 1; r < n; ++r)
      if (a[r][i] != 0)
        for (std::size_t c = n + 1; c-- > i;) a[r][c] -= a[r][i] / a[i][i] * a[i][c];
  }
  std::vector<double> x(n);
  for (std::size_t i = n; i-- > 0;) {
    x[i] = a[i][n];
    for (std::size_t c = i + 1; c < n; ++c) x[i] -= a[i][c] * x[c];
    x[i] /= a[i][i];
  }
  return x;
}

/// x times how far the skin sinks under the pressure cos(x r), or J0. Between layers displacements and
/// stresses are the same on both sides.
double sinking(const SkinLayer& skin, double x) {
  std::vector<TissueLayerBelow> layers = {{skin.young_modulus, skin.poisson_ratio, skin.height}};
  layers.insert(layers.end(), skin.below.begin(), skin.below.end());
  const std::size_t n = 4 * layers.size();
  // Stresses in units that make all rows alike.
  const double unit = x * skin.young_modulus / (2 * (1 + skin.poisson_ratio));
  std::vector<std::vector<double>> a(n, std::vector<double>(n + 1));
  const auto top = modes(layers.front(), x, 0), bottom = modes(layers.back(), x, -layers.back().height);
  for (std::size_t i = 0; i < 4; ++i) {
    const Mode &t = top[i], &b = bottom[i];
    a[0][i] = t.normal / unit;
    a[1][i] = (t.shear + skin.membrane * x * x * t.u) / unit;
    a[n - 2][n - 4 + i] = (b.normal - skin.foundation * b.w) / unit;
    a[n - 1][n - 4 + i] = (b.shear - skin.foundation * b.u) / unit;
  }
  a[0][n] = -1 / unit;
  for (std::size_t k = 0; k + 1 < layers.size(); ++k) {
    const auto above = modes(layers[k], x, -layers[k].height), below = modes(layers[k + 1], x, 0);
    for (std::size_t i = 0; i < 4; ++i)
      for (const auto& [mode, column, sign] :
           {std::tuple(above[i], 4 * k + i, 1.), std::tuple(below[i], 4 * k + 4 + i, -1.)}) {
        a[4 * k + 2][column] = sign * mode.u, a[4 * k + 3][column] = sign * mode.w;
        a[4 * k + 4][column] = sign * mode.normal / unit, a[4 * k + 5][column] = sign * mode.shear / unit;
      }
  }
  const std::vector<double> part = solved(std::move(a));
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

std::optional<SkinLayer> skin_layer(const Field& field) {
  auto layer = skin_layer(*field.parameters);
  if (!layer || !field.tissue) return layer;
  const std::vector<TissueLayerBelow>& all = field.tissue->layers;
  const TissueLayerBelow& top = all.front();
  return SkinLayer{top.young_modulus,        top.poisson_ratio, top.height,
                   field.tissue->foundation, layer->membrane,   {all.begin() + 1, all.end()}};
}

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
