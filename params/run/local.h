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
  double memory = 0;                      ///< bytes that all may use together, as estimated
  bool retry_failed = false;              ///< run cases again that have failed before
  std::vector<std::string> mpi_launcher;  ///< starts the ranks; empty: mpirun if there are several
};

struct RunReport {
  int cases = 0, already_published = 0, published = 0, superseded = 0, failed = 0, interrupted = 0;
  int stopped_by = 0;  ///< the signal that stopped it, if any
};

/// Publishes all cases of the list; a failed case keeps its logs and does not stop the others. Prints a line
/// for each case on stderr, and a table if that is a terminal. The first SIGINT, SIGTERM or SIGUSR1 ends and
/// abandons running cases without loss of published ones; the second kills them.
RunReport run_local(const StudyFolder& folder, const Study& study, const std::vector<Case>& cases,
                    const LocalOptions& options);

}  // namespace cleft
