#include "encoder/cell_centres.h"

#include <algorithm>

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

Eigen::MatrixX3d CellCentres::mean(const Eigen::Ref<const Eigen::MatrixX3d>& frame) const {
  Eigen::MatrixX3d means = Eigen::MatrixX3d::Zero(static_cast<Eigen::Index>(samples.size()), 3);
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
