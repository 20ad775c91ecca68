#include <algorithm>
#include <map>
#include <tuple>

#include "encoder/space_fit_parts.h"

namespace cleft {

/// The place of a sample's limit, known or new.
int SpaceFit::Parts::place_of(const Vec3& uvw, Limit limit, double share,
                              std::map<std::array<double, 4>, int>& known) {
  const auto [at, is_new] =
      known.try_emplace({uvw.y, uvw.z, limit == Limit::from_left ? 0. : 1., share}, int(places.size()));
  if (!is_new) return at->second;
  const auto v = bases[1].evaluate(parametrization.across(uvw.y).value, limit),
             w = bases[2].evaluate(parametrization.height(uvw.z).value);
  Weights& weights = places.emplace_back(Weights{v.first, w.first, share, {}});
  for (int j = 0; j < order; ++j)
    for (int k = 0; k < order; ++k) weights.weight[j * order + k] = v.value[j] * w.value[k];
  return at->second;
}

void SpaceFit::Parts::add_samples(const std::vector<Sample>& samples) {
  const bool ahead_is_tied = ties.size() < bases[0].size() * V * W;
  const FieldGeometry& geometry = parametrization.geometry();
  // The cut's whole extent over time; nothing there is tied in the last frame.
  const auto in_cut = [&](const Vec3& uvw) {
    return uvw.x > geometry.cut.start && uvw.x < geometry.tip.positions.back() && uvw.z > -geometry.cut.depth;
  };
  std::map<std::array<double, 4>, int> known;
  std::map<double, std::vector<std::array<int, 2>>> of_planes;  // place and sample
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const Vec3& uvw = samples[s].uvw;
    const Side side = samples[s].side;
    for (const Limit limit : {Limit::from_left, Limit::from_right}) {
      const bool left = limit == Limit::from_left, uncut_plane = uvw.y == 0 && side == Side::both;
      // Uncut tissue on the plane is both sides' business where nothing ties them.
      const bool tied = ahead_is_tied && !in_cut(uvw);
      if (uncut_plane ? tied && !left : left != (uvw.y < 0 || (uvw.y == 0 && side == Side::left))) continue;
      const int place = place_of(uvw, limit, uncut_plane && !tied ? 0.5 : 1, known);
      of_planes[uvw.x].push_back({place, static_cast<int>(s)});
      // Functions sum to 1, and so do their products: the mean diagonal is about the sum of squares over
      // them.
      for (const double value : places[place].weight) scale += value * value;
    }
  }
  scale /= static_cast<double>(bases[0].size()) * V * W * 2;
  std::map<std::vector<int>, int> known_sections;
  const auto cell_of = [&](int place) {
    return std::array{places[place].first_across, places[place].first_height};
  };
  for (auto& [u, list] : of_planes) {
    std::sort(list.begin(), list.end(), [&](const auto& a, const auto& b) {
      return std::tuple(cell_of(a[0]), a) < std::tuple(cell_of(b[0]), b);
    });
    std::vector<int> key;
    Plane plane{u, 0, {}};
    for (const auto& [place, sample] : list) key.push_back(place), plane.samples.push_back(sample);
    const auto [at, is_new] = known_sections.try_emplace(std::move(key), int(sections.size()));
    if (is_new) add_cells(sections.emplace_back(), at->first);
    plane.section = at->second;
    sections[plane.section].planes.push_back(static_cast<int>(planes.size()));
    planes.push_back(std::move(plane));
  }
}

void SpaceFit::Parts::add_cells(Section& section, const std::vector<int>& sorted) const {
  for (const int place : sorted) {
    const auto& [across, height, share, weight] = places[place];
    if (section.cells.empty() || section.cells.back().first_across != across ||
        section.cells.back().first_height != height)
      section.cells.push_back({across, height, {}, {}});
    Cell& cell = section.cells.back();
    cell.places.push_back(place);
    for (int a = 0; a < cell_size; ++a)
      for (int b = 0; b < cell_size; ++b) cell.normal[a * cell_size + b] += weight[a] * weight[b];
  }
}

}  // namespace cleft
