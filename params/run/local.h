// Runs the cases of a study in processes on this machine.
#pragma once

#include <string>
#include <vector>

#include "params/run/study_folder.h"

namespace cleft {

struct LocalOptions {
  int jobs = 1;                           ///< processes at a time
  int ranks = 1;                          ///< MPI ranks of each solve
  int threads = 1;                        ///< of each process
  double memory = 0;                      ///< bytes that all may hold together, as estimated
  bool retry_failed = false;              ///< run cases again that have failed before
  std::vector<std::string> mpi_launcher;  ///< starts the ranks; empty: mpirun, where they are several
};

struct RunReport {
  int cases = 0, already_published = 0, published = 0, superseded = 0, failed = 0, interrupted = 0;
  int stopped_by = 0;  ///< the signal, where one did
};

/// Brings every case of the list to its published state; a failed case keeps its logs and never stops the
/// others. What happens is told on stderr, a line a case, and a table where that is a terminal. At the first
/// SIGINT, SIGTERM or SIGUSR1 what runs is ended and given up, and nothing is lost; at the second it is
/// killed.
RunReport run_local(const StudyFolder& folder, const Study& study, const std::vector<Case>& cases,
                    const LocalOptions& options);

}  // namespace cleft
