// Runs the cases of a study in processes on this machine.
#pragma once

#include <string>
#include <vector>

#include "params/study_folder.h"

namespace cleft {

struct LocalOptions {
  int jobs = 1;   ///< cases at a time
  int ranks = 1;  ///< MPI ranks of each solve
};

struct RunReport {
  int cases = 0, already_published = 0, published = 0, superseded = 0, failed = 0, interrupted = 0;
};

/// Brings every case of the list to its published state; a failed case keeps its logs and never stops the
/// others. Progress goes to stderr, a line a case. SIGINT and SIGTERM stop it cleanly: what runs is given up,
/// nothing is lost.
RunReport run_local(const StudyFolder& folder, const std::vector<Case>& cases, const LocalOptions& options);

}  // namespace cleft
