#include "haptic/surface_dent.h"

#include <algorithm>
#include <cmath>

namespace cleft {

namespace {

constexpr int samples = 240;  // an eighth of a millimetre: between them the rim of the disc is off by 0.2 %

std::vector<double> distances() {
  std::vector<double> all;
  for (int k = 0; k <= samples; ++k) all.push_back(dent_reach * k / samples);
  return all;
}

/// Over the middle's, and to nothing at the reach.
std::vector<double> profile(std::vector<double> sunk) {
  const std::vector<double> at = distances();
  for (std::size_t k = sunk.size(); k-- > 0;)
    sunk[k] *= std::pow(1 - std::pow(at[k] / dent_reach, 2), 2) / sunk[0];
  return sunk;
}

std::vector<double> half_space() {
  std::vector<double> sunk;
  for (const double distance : distances()) sunk.push_back(half_space_profile(distance));
  return sunk;
}

}  // namespace

SurfaceDent::SurfaceDent() : table_(profile(half_space())) {}

SurfaceDent::SurfaceDent(const SkinLayer& layer) : table_(profile(layer_compliances(layer, distances()))) {}

SurfaceDent::SurfaceDent(const Field& field) {
  const auto layer = skin_layer(field);
  *this = layer ? SurfaceDent(*layer) : SurfaceDent();
}

double SurfaceDent::at(double distance) const {
  const double place = distance / dent_reach * samples;
  if (place >= samples) return 0;
  const std::size_t k = place;
  return std::lerp(table_[k], table_[k + 1], place - static_cast<double>(k));
}

}  // namespace cleft
