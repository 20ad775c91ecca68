// A case's snapshot while its frames are solved, and the figures of its report.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "solver/shared_stiffness.h"
#include "solver/snapshot_output.h"

namespace cleft {

/// All calls are collective. Frames are written in their order.
class CaseOutput {
 public:
  /// Begins the snapshot. `number`: of the case in the job. `derivatives`: parameters by which the series is
  /// differentiated. Keeps references to the first two.
  CaseOutput(SharedStiffness& shared, const Release& release, std::size_t number,
             const std::vector<std::string>& derivatives);

  const Parameters& parameters() const;
  SolveReport& report() const;
  /// Whether the case continues: none of its figures was bad.
  bool continues() const { return writing_ != nullptr; }

  /// Figures of the next frames. A bad one ends the case, whose report then has the failure.
  void add_figures(const std::vector<FrameFigures>& figures);
  /// Of the unknowns' columns, which are the frames from `first` on.
  void write_frames(int first, const Block& frames);
  void write_derivative(const std::string& name, int first, const Block& frames);
  void finish();

 private:
  std::vector<Vec3> at_nodes(const double* column) const;
  void add_largest(const std::vector<Vec3>& nodes);

  SharedStiffness& shared_;
  const std::size_t number_;
  std::unique_ptr<SnapshotOutput> writing_;
  std::vector<Vec3> closed_;  // frame 0, this rank's nodes
};

}  // namespace cleft
