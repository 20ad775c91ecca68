#include "encoder/tissue_below.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "params/parameters/springs_of_bone.h"

namespace cleft {

namespace {

Vec3 mean(const std::vector<Vec3>& places, auto first, auto last) {
  Vec3 sum;
  for (auto n = first; n != last; ++n) sum += places[static_cast<std::size_t>(*n)];
  return 1. / static_cast<double>(last - first) * sum;
}

/// The face of the tissue's lower side below the middle of the cut.
std::size_t face_below(const Snapshot& s, const std::vector<Vec3>& places, double middle) {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < s.foundation_triangles.size(); ++f) {
    const auto& corners = s.foundation_triangles[f];
    const Vec3 at = mean(places, corners.begin(), corners.end());
    if (const double off = std::hypot(at.x - middle, at.y); off < least) least = off, nearest = f;
  }
  return nearest;
}

/// mm from the face to the skin: coordinates are those of the layers as they were meant, also where bone has
/// made the tissue thinner.
double thickness_over(const Snapshot& s, const std::vector<Vec3>& places, std::size_t face) {
  double sum = 0;
  for (const int corner : s.foundation_triangles[face]) {
    const Vec3& foot = places[static_cast<std::size_t>(corner)];
    double least = std::numeric_limits<double>::infinity(), thickness = 0;
    for (const auto& triangle : s.skin())
      for (const int n : triangle) {
        const Vec3& at = places[static_cast<std::size_t>(n)];
        if (const double off = std::hypot(at.x - foot.x, at.y - foot.y); off < least)
          least = off, thickness = norm(s.points[static_cast<std::size_t>(n)] -
                                        s.points[static_cast<std::size_t>(corner)]);
      }
    sum += thickness / 3;
  }
  return sum;
}

/// Layers of the tissues that wedges above the face are of, and their parts of the height.
std::vector<TissueLayerBelow> layers_over(const Snapshot& s, const std::vector<Vec3>& places,
                                          std::size_t face, const Parameters::Tissue& tissue) {
  if (s.region.empty()) return {{tissue.young_modulus, tissue.poisson_ratio, 1}};
  const auto& corners = s.foundation_triangles[face];
  const Vec3 foot = mean(places, corners.begin(), corners.end());
  constexpr int samples = 200;  // of the height; at each the nearest wedge counts: columns may lean
  std::vector<int> region(samples, -1);
  std::vector<double> nearest(samples, std::numeric_limits<double>::infinity());
  std::size_t wedge = 0;
  for (std::size_t c = 0; c < s.cell_types.size(); ++c) {
    if (s.cell_types[c] != Snapshot::wedge) continue;
    const int own = s.region[wedge++];
    const auto first = s.connectivity.begin() + s.cell_offsets[c],
               last = s.connectivity.begin() + s.cell_offsets[c + 1];
    const Vec3 at = mean(places, first, last);
    const double off = std::hypot(at.x - foot.x, at.y - foot.y);
    double low = 0, high = -std::numeric_limits<double>::infinity();
    for (auto n = first; n != last; ++n) {
      const double w = places[static_cast<std::size_t>(*n)].z;
      low = std::min(low, w), high = std::max(high, w);
    }
    for (int k = 0; k < samples; ++k)
      if (const double w = foot.z * (k + 0.5) / samples; low <= w && w <= high && off < nearest[k])
        nearest[k] = off, region[k] = own;
  }
  std::vector<TissueLayerBelow> layers;
  for (int k = 0; k < samples; ++k) {
    if (region[k] < 0) continue;
    const auto& [e, nu] = s.region_moduli[static_cast<std::size_t>(region[k])];
    if (layers.empty() || layers.back().young_modulus != e || layers.back().poisson_ratio != nu)
      layers.push_back({e, nu, 0});
    layers.back().height += 1. / samples;
  }
  return layers;
}

}  // namespace

std::optional<TissueBelow> tissue_below(const SnapshotReader& reader) {
  const Snapshot& s = reader.snapshot();
  const Parameters& p = *s.parameters;
  const bool known = p.tissue.young_modulus > 0 && !std::isnan(p.tissue.poisson_ratio) &&
                     p.foundation.stiffness > 0 && p.patch.height > 0;
  if (s.source || !known || s.foundation_triangles.empty() || (s.body.empty() && s.support.empty()))
    return {};
  const std::vector<Vec3> places = reader.coordinates();
  const std::size_t face = face_below(s, places, s.cut_start + s.cut_length / 2);
  const double height = thickness_over(s, places, face);
  TissueBelow below{layers_over(s, places, face, p.tissue), p.foundation.stiffness};
  if (!(height > 0) || below.layers.empty()) return {};
  for (TissueLayerBelow& layer : below.layers) layer.height *= height;
  if (!s.support.empty() && s.support[face] == 1) below.foundation = springs_of_bone(p);
  return below;
}

}  // namespace cleft
