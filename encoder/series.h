// A snapshot's time series in memory, as the fit uses it.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "encoder/cell_centres.h"
#include "encoder/field/parametrization.h"
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

/// Sets scale and middle from the frames and `largest`.
void set_scale(SeriesQuantity& quantity);

/// Norms of the rows: Euclidean; of six components, of the symmetric tensor XX YY ZZ XY YZ XZ, whose norm
/// does not depend on the axes.
Eigen::VectorXd norms_of(const Eigen::MatrixXd& rows);

/// The derivative of the displacement from frame 0 by a parameter, mm per unit of the parameter.
struct SeriesDerivative {
  std::string parameter;
  std::vector<Eigen::MatrixX3d> frames;  ///< F: N x 3; frame 0 is zero
  double largest = 0;                    ///< Euclidean norm, of all
};

struct Series {
  std::vector<double> times;    ///< F, mm
  std::vector<Sample> samples;  ///< N
  /// Of the samples, the first ones: nodes of the snapshot, at which errors are measured. Further ones are
  /// places at which a shaped patch's displacements are known too; they are fitted alike.
  std::size_t nodes = 0;
  StoredFrames<3> frames;           ///< F: N x 3, displacement from frame 0, mm; frame 0 is zero
  std::vector<double> largest;      ///< F: largest displacement of the frame, mm
  double largest_displacement = 0;  ///< mm, of all
  CellCentres centres;
  /// Of imported data: the fields besides the displacement, and `at_start`, the displacement of frame 0 in
  /// all frames, where it is not 0.
  std::vector<SeriesQuantity> quantities;
  static constexpr const char* at_start = "displacement_at_start";
  std::vector<SeriesDerivative> derivatives;  ///< of a simulation: those that the snapshot holds
  FieldGeometry geometry;
  bool arm = false;                                ///< whether the break ends at others
  bool round = false;                              ///< whether w is an angle around a round front
  std::vector<std::array<std::int32_t, 2>> pairs;  ///< left and right node, in release order
  std::vector<std::int32_t> released;              ///< F: number of open pairs

  /// Reads all frames, 24 N F bytes, into memory or into a file. Throws InputError if there are fewer than
  /// two frames, or the cut is not in the plane v = 0; FileError that names frame and node if a displacement
  /// is not finite.
  explicit Series(const SnapshotReader& reader, const std::shared_ptr<SpillFile>& file = nullptr);
};

/// Tolerances of the pieces of one body are relative to the body's largest values, not to each piece's.
void share_scales(std::vector<Series>& pieces);

}  // namespace cleft
