#include "haptic/firmness_above_bone.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "haptic/surface_stiffness.h"
#include "params/parameters/springs_of_bone.h"

namespace cleft {

namespace {

constexpr double thinnest = 1. / 20;  // of the whole
constexpr int steps = 48;             // between them a line is off by less than 0.1 %

/// The layer with its tissue this thick in all.
SkinLayer made_thick(SkinLayer layer, double tissue) {
  double all = layer.height;
  for (const TissueLayerBelow& one : layer.below) all += one.height;
  layer.height *= tissue / all;
  for (TissueLayerBelow& one : layer.below) one.height *= tissue / all;
  return layer;
}

}  // namespace

FirmnessAboveBone::FirmnessAboveBone(const Field& field) : whole_(field.parameters->patch.height) {
  const std::optional<SkinLayer> own = skin_layer(field);
  if (!own || !(whole_ > 0)) return;
  const double compliance = layer_compliance(*own);
  SkinLayer layer = *own;
  layer.foundation = field.parameters->foundation.stiffness;
  if (layer.foundation > 0) free_ = compliance / layer_compliance(made_thick(layer, whole_));
  layer.foundation = springs_of_bone(*field.parameters);
  for (int k = 0; k <= steps; ++k) {
    const double part = std::pow(thinnest, 1 - static_cast<double>(k) / steps);
    table_.push_back(compliance / layer_compliance(made_thick(layer, part * whole_)));
  }
}

double FirmnessAboveBone::at(double tissue) const {
  if (table_.empty() || tissue >= whole_) return free_;
  const double part = std::max(tissue / whole_, thinnest);
  const double place = std::clamp(steps * (1 - std::log(part) / std::log(thinnest)), 0., steps - 1e-9);
  const std::size_t k = place;
  return std::lerp(table_[k], table_[k + 1], place - static_cast<double>(k));
}

std::function<double(const Vec3&)> firmness_above_bone(const Field& field,
                                                       std::function<double(const Vec3&)> distance) {
  if (!distance) return {};
  return [firmness = FirmnessAboveBone(field), distance = std::move(distance)](const Vec3& place) {
    return firmness.at(distance(place));
  };
}

}  // namespace cleft
