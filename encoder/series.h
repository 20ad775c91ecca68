// A snapshot's time series in memory, as the fit uses it.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "encoder/cell_centres.h"
#include "encoder/field/parametrization.h"
#include "encoder/front_kinks.h"
#include "encoder/node_values.h"
#include "encoder/node_work.h"
#include "encoder/norms.h"
#include "encoder/own_coordinates.h"
#include "encoder/stored_frames.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

/// A further quantity at the nodes: its own values, not from frame 0.
struct SeriesQuantity {
  std::string name;
  StoredFrames<Eigen::Dynamic> frames;  ///< F: N x components
  double largest = 0;                   ///< largest norm (norms_of), at any node and frame
  /// What a tolerance is relative to: `largest`, or the range of the values where they vary about something
  /// else than 0 and that is less (a pressure of 101325 +- 10 Pa has 20). Of a vector or tensor, twice the
  /// largest norm of its difference from its mean.
  double scale = 0;
  Eigen::RowVectorXd middle;  ///< what the values vary about; 0 where `scale` is `largest`
};

/// Sets scale and middle from `largest` and the values of each frame, at all nodes.
void set_scale(SeriesQuantity& quantity, const std::function<Eigen::MatrixXd(std::size_t frame)>& values);

/// The derivative of the displacement from frame 0 by a parameter, mm per unit of the parameter.
struct SeriesDerivative {
  std::string parameter;
  std::vector<Eigen::MatrixX3d> frames;  ///< F: N x 3; frame 0 is zero
  double largest = 0;                    ///< Euclidean norm, of all
};

/// How a series is held.
struct SeriesStorage {
  std::shared_ptr<SpillFile> file = {};  ///< where the values are; none: in memory
  /// Samples that are fitted, about, where there are more (fitted_nodes.h).
  std::size_t most = static_cast<std::size_t>(-1);
  std::size_t block = CodedResidual::most_nodes;  ///< nodes that are worked on together
  /// Then makes the work over all nodes; none: it is done in this process.
  std::function<std::shared_ptr<const NodeWork>(std::shared_ptr<const NodeValues> values,
                                                std::span<const Sample> nodes, std::span<const double> times,
                                                std::size_t block)>
      spread = {};
};

struct Series {
  std::vector<double> times;    ///< F, mm
  std::vector<Sample> samples;  ///< N
  /// Of the samples, the first ones: nodes of the snapshot. Further ones are places at which a shaped patch's
  /// displacements are known too; they are fitted alike.
  std::size_t nodes = 0;
  /// All nodes of the snapshot, at which errors are measured, where the samples are a part of them.
  std::shared_ptr<const std::vector<Sample>> all_nodes;
  std::shared_ptr<const NodeValues> node_values;  ///< and their values
  std::shared_ptr<const NodeWork> elsewhere;      ///< where work over them is done; none: here
  std::size_t block = CodedResidual::most_nodes;  ///< nodes that are worked on together
  StoredFrames<3> frames;           ///< F: N x 3, displacement from frame 0, mm; frame 0 is zero
  std::vector<double> largest;      ///< F: largest displacement of the frame, mm
  double largest_displacement = 0;  ///< mm, of all
  CellCentres centres;
  /// With few nodes: middles of edges, which hold fits on close knots.
  CellCentres middles;
  bool middles_hold = false;               ///< all fits, and show errors between nodes: of imported data
  bool from_zero = true;                   ///< whether frame 0 is no part of the fit
  std::vector<std::int32_t> beside_jumps;  ///< samples next to which the cut's coordinates jump
  bool quadratic = false;                  ///< simulated with quadratic elements, of which cells are parts
  /// Of imported data: the fields besides the displacement, and `at_start`, the displacement of frame 0 in
  /// all frames, where it is not 0.
  std::vector<SeriesQuantity> quantities;
  static constexpr const char* at_start = "displacement_at_start";
  std::vector<SeriesDerivative> derivatives;  ///< of a simulation: those that the snapshot holds
  FieldGeometry geometry;
  bool arm = false;                                ///< whether the break ends at others
  FrontKinks front_kinks;                          ///< of one of several breaks
  std::vector<TimeKink> kinks;                     ///< and those of all, once they are shared
  bool round = false;                              ///< whether w is an angle around a round front
  bool surface_only = false;                       ///< of imported data: no solid, and no plane
  bool in_parts = false;                           ///< of imported data: bodies that share no nodes
  double turning = 0;                              ///< of the direction of the break, radians
  Bend tightest;                                   ///< where it does so most
  bool bends = false;                              ///< whether it turns much
  bool winds = false;                              ///< or very much
  std::vector<std::array<std::int32_t, 2>> pairs;  ///< left and right node, in release order
  std::vector<std::int32_t> released;              ///< F: number of open pairs

  /// Reads all frames; 24 N F bytes are in memory or in a file. Throws InputError if there are fewer than two
  /// frames, or the cut is not in the plane v = 0; FileError that names frame and node if a displacement is
  /// not finite.
  explicit Series(const SnapshotReader& reader, const SeriesStorage& storage = {});

  /// All nodes of the snapshot.
  std::span<const Sample> node_samples() const {
    return all_nodes ? std::span(*all_nodes) : std::span(samples.data(), nodes);
  }
  /// Values of a field (NodeSpline::field) at count of them from `first` on.
  Eigen::MatrixXd values(int field, std::size_t frame, std::size_t first, std::size_t count) const;
};

/// What the front of one break does, the pieces of others feel.
void share_kinks(std::vector<Series>& pieces);

/// Tolerances of the pieces of one body are relative to the body's largest values, not to each piece's.
void share_scales(std::vector<Series>& pieces);

}  // namespace cleft
