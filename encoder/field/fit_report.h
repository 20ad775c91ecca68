// How good a field is: the report of its fit, and what is known of one that was interpolated.
#pragma once

#include <string>

namespace cleft {

/// The report of the fit that goes with a field; errors are relative to the largest displacement from frame 0
/// unless stated otherwise.
struct FitReport {
  double relative_l2 = 0;    ///< sqrt(sum |error|^2 / sum |d|^2) over nodes and frames
  double node_error = 0;     ///< largest Euclidean error at any node and frame, as stored
  double spline_error = 0;   ///< the same for the spline alone (equal where no residual is stored)
  double between_nodes = 0;  ///< largest error between the nodes that the data show (encoder/between_nodes.h)
  double gape_error = 0;     ///< largest error of the opening of a pair of nodes on the cut
  double false_gap = 0;      ///< largest opening across v = 0 at uncut nodes, where it should be 0
  double largest_displacement = 0;  ///< mm, from frame 0
  double frame_error = 0;           ///< largest error in any frame over that frame's own largest displacement
  double worst_node = 0;            ///< node of spline_error, and its time
  double worst_time = 0;            ///<
  double condition = 0;             ///< of the fit's normal matrices, estimated
  double regularisation = 0;        ///< its strength, if it was given; 0: it was chosen by the data
  double crease = 0;                ///< degrees: largest kink of uncut skin across v = 0
  double overlap = 0;               ///< mm: by how much lips overlap further than those of the data
  double least_volume = 1;  ///< least det(I + grad d) at the nodes: ratio of a small volume to that at rest
  double fit_seconds = 0, measure_seconds = 0;  ///< times of the fit and of the evaluation for this report
  double nodes = 0, frames = 0;                 ///< of the data; 0: not known

  /// Bytes of the data's displacements as 32-bit numbers.
  double raw_bytes() const { return 3 * sizeof(float) * nodes * frames; }
};

/// Data of a field that was interpolated between the fields of other cases.
struct Interpolation {
  std::string method;              ///< chosen by its leave-one-out error
  double cases = 0;                ///< number of cases that it was made from
  double estimated_error = 0;      ///< expected of node_error against a simulation of these parameters
  double interpolation_error = 0;  ///< the same against a field fitted to it, without the error of a fit
  double outside = 0;  ///< distance from the cases' parameters, relative to their spread; 0: between them
};

}  // namespace cleft
