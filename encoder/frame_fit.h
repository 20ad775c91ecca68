// The contribution of a frame to a fit in space: its nodes, and cell centroids where nodes are too sparse.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "encoder/front_centres.h"
#include "encoder/series.h"
#include "encoder/space_fit.h"

namespace cleft {

/// Where knots are closer than nodes, the nodes leave the spline free between them: next to the cut, and
/// between its start and a tip that is still near, because all knots of the canonical cut are there at any
/// time. There the least squares also use collocation at cell centroids: the finite elements' own values,
/// with the weight of nodes. Of imported data with few nodes the middles of edges hold the spline there too,
/// with a weight that bends it little at the nodes.
class FrameFit {
 public:
  /// Whether edges hold the spline as much as close knots need, whatever the data are; or as little as nodes
  /// need that nearly determine it, which centroids and edges would draw to the means of a wave.
  enum class Hold { as_usual, firm, slight };

  /// Of the places and times of `series`, not of its displacements. Keeps references to `series` and
  /// `parametrization`.
  FrameFit(const Series& series, const Parametrization& parametrization,
           const std::array<BSplineBasis, 3>& bases, Hold hold = Hold::as_usual);

  const ControlTies& ties() const { return nodes_.ties(); }
  const SpaceFit& space() const { return nodes_; }
  /// B^T B + strength R of a frame, and ties^T B^T d for its displacements d.
  SpaceFit::Normal normal(std::size_t frame, double strength) const;
  Eigen::MatrixX3d project(std::size_t frame, const Eigen::Ref<const Eigen::MatrixX3d>& d) const;
  /// B ties x at the nodes.
  Eigen::MatrixX3d values(const Eigen::MatrixX3d& x, std::size_t frame) const;
  double bytes() const;  ///< that the spaces take

 private:
  struct Group {
    CellCentres centres;
    SpaceFit fit;
    std::vector<bool> of_frame;
    std::optional<FrontCentres> fronts;  // of quadratic elements
    double weight = 1;                   // over that of nodes
  };
  void add_lips(const std::vector<std::size_t>& edges, const std::vector<bool>& sparse);
  void add_group(const CellCentres& all, const std::vector<std::size_t>& cells, std::vector<bool> of_frame,
                 double weight = 1);

  const Series& series_;
  const Parametrization& parametrization_;
  std::array<BSplineBasis, 3> bases_;
  SpaceFit nodes_;
  std::vector<Group> groups_;
};

}  // namespace cleft
