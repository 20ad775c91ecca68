#include "encoder/cell_centres.h"

#include <algorithm>
#include <array>
#include <set>
#include <span>

#include "solver/snapshot/cell_types.h"

namespace cleft {

CellCentres cell_centres(const Snapshot& snapshot, const std::vector<Sample>& samples) {
  CellCentres centres;
  centres.first = {0};
  for (std::size_t c = 0; c + 1 < snapshot.cell_offsets.size(); ++c) {
    const auto begin = snapshot.connectivity.begin() + snapshot.cell_offsets[c],
               end = snapshot.connectivity.begin() + snapshot.cell_offsets[c + 1];
    if (end - begin < 2) continue;
    Vec3 centre;
    double least = 0, greatest = 0;
    bool beside = false;
    for (auto node = begin; node != end; ++node) {
      const Vec3& at = samples[*node].uvw;
      centre += (1. / static_cast<double>(end - begin)) * at;
      least = std::min(least, at.y), greatest = std::max(greatest, at.y);
      beside = beside || at.y == 0;
    }
    if ((least == 0) == (greatest == 0)) continue;
    centres.samples.push_back({centre, side_of(centre.y)});
    centres.touches_plane.push_back(beside);
    centres.nodes.insert(centres.nodes.end(), begin, end);
    centres.first.push_back(centres.nodes.size());
  }
  return centres;
}

CellCentres edge_middles(const Snapshot& snapshot, const std::vector<Sample>& samples) {
  CellCentres middles;
  middles.first = {0};
  std::set<std::array<std::int64_t, 2>> known;
  for (std::size_t c = 0; c < snapshot.cell_types.size(); ++c) {
    const std::int64_t* corners = &snapshot.connectivity[static_cast<std::size_t>(snapshot.cell_offsets[c])];
    for (const auto& [from, to] : edges_of_type(snapshot.cell_types[c])) {
      const auto [a, b] = std::minmax(corners[from], corners[to]);
      const Sample &one = samples[static_cast<std::size_t>(a)], &other = samples[static_cast<std::size_t>(b)];
      const Vec3 middle = 0.5 * (one.uvw + other.uvw);
      const bool on_plane = one.uvw.y == 0 && other.uvw.y == 0;
      if ((one.uvw.y * other.uvw.y < 0) || (on_plane && one.side != other.side)) continue;
      if (!known.insert({a, b}).second) continue;
      middles.samples.push_back({middle, on_plane ? one.side : side_of(middle.y)});
      middles.touches_plane.push_back(one.uvw.y == 0 || other.uvw.y == 0);
      middles.nodes.insert(middles.nodes.end(), {a, b});
      middles.first.push_back(middles.nodes.size());
    }
  }
  return middles;
}

namespace {

/// The corners of a cell's quadrilateral in v = 0 on one side of the cut; none if it has no such.
std::vector<std::int64_t> quadrilateral_on_lip(std::span<const std::int64_t> corners, std::uint8_t type,
                                               const std::vector<Sample>& samples) {
  constexpr std::size_t of_quadrilateral = 4;
  std::vector<std::int64_t> on_plane;
  if (edges_of_type(type).empty()) return on_plane;
  for (const std::int64_t n : corners)
    if (samples[static_cast<std::size_t>(n)].uvw.y == 0) on_plane.push_back(n);
  const auto side = [&](std::int64_t n) { return samples[static_cast<std::size_t>(n)].side; };
  const bool is_one = on_plane.size() == of_quadrilateral && corners.size() > of_quadrilateral &&
                      std::all_of(on_plane.begin(), on_plane.end(), [&](std::int64_t n) {
                        return side(n) == side(on_plane.front()) && side(n) != Side::both;
                      });
  return is_one ? on_plane : std::vector<std::int64_t>();
}

}  // namespace

void add_quadrilaterals_on_lips(CellCentres& middles, const Snapshot& snapshot,
                                const std::vector<Sample>& samples) {
  for (std::size_t c = 0; c < snapshot.cell_types.size(); ++c) {
    const std::vector<std::int64_t> face =
        quadrilateral_on_lip({snapshot.connectivity.begin() + snapshot.cell_offsets[c],
                              snapshot.connectivity.begin() + snapshot.cell_offsets[c + 1]},
                             snapshot.cell_types[c], samples);
    if (face.empty()) continue;
    Vec3 middle;
    for (const std::int64_t n : face) middle += 0.25 * samples[static_cast<std::size_t>(n)].uvw;
    middles.samples.push_back({middle, samples[static_cast<std::size_t>(face[0])].side});
    middles.touches_plane.push_back(true);
    middles.nodes.insert(middles.nodes.end(), face.begin(), face.end());
    middles.first.push_back(middles.nodes.size());
  }
}

Eigen::MatrixXd CellCentres::mean(const Eigen::Ref<const Eigen::MatrixXd>& frame) const {
  Eigen::MatrixXd means = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(samples.size()), frame.cols());
  for (std::size_t c = 0; c < samples.size(); ++c) {
    for (std::size_t k = first[c]; k < first[c + 1]; ++k)
      means.row(static_cast<Eigen::Index>(c)) += frame.row(nodes[k]);
    means.row(static_cast<Eigen::Index>(c)) /= static_cast<double>(first[c + 1] - first[c]);
  }
  return means;
}

CellCentres CellCentres::only(const std::vector<std::size_t>& some) const {
  CellCentres result;
  result.first = {0};
  for (const std::size_t c : some) {
    result.samples.push_back(samples[c]);
    result.touches_plane.push_back(touches_plane[c]);
    for (std::size_t k = first[c]; k < first[c + 1]; ++k) result.nodes.push_back(nodes[k]);
    result.first.push_back(result.nodes.size());
  }
  return result;
}

}  // namespace cleft
