// Cases of one K and one release: solved together, and each written to its snapshot.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "solver/case_loads.h"
#include "solver/case_output.h"

namespace cleft {

/// All calls are collective.
class CaseBatch {
 public:
  /// `members`: numbers of the job's cases. Keeps references to all but these.
  CaseBatch(SharedStiffness& shared, const Release& release, const std::vector<std::size_t>& members);

  /// Solves and writes block after block of frames. Cases whose figures are bad are reported and not written.
  void solve();

 private:
  struct Member {
    std::size_t number;            // among all cases
    const CaseLoads::Case* loads;  // the loads that it is a sum of
    std::unique_ptr<CaseOutput> output;
  };

  /// Frames of a block for a range of loads, load by load.
  struct LoadFrames {
    std::size_t begin, end;  // the loads
    Block displacements, left_over;
  };

  std::vector<std::string> derivatives() const;
  void solve_block(int first, int count);
  void solve_block(int first, int count, std::size_t part);
  void finish_block(Member& member, int first, Eigen::Index count, const LoadFrames& loads);
  Block sensitivity(const Member& member, const std::string& name,
                    const std::vector<FrameSolver::Frame>& opened, const Block& frames);
  std::vector<FrameSolver::Frame> frames_of(const std::vector<FrameSolver::Column>& columns,
                                            const Block& displacements) const;

  SharedStiffness& shared_;
  const SolveOptions& options_;
  const PatchSystem& system_;
  FrameSolver& solver_;
  const Release& release_;
  const CaseLoads loads_;
  std::vector<Member> members_;
  std::map<std::string, std::unique_ptr<PatchSystem::Derivative>> derivatives_;
};

}  // namespace cleft
