// Runs the cases of a study as job arrays of Slurm.
#pragma once

#include <string>
#include <vector>

#include "params/run/local.h"

namespace cleft {

/// Submits the missing cases and waits until all are published or have failed, as local runs do. The study
/// folder is the only authority; the queue is queried (squeue) only for tasks that it still contains, so that
/// a restarted run finds its jobs. Cases that a task did not finish are submitted again, at most three times.
/// SIGINT does not affect the jobs.
RunReport run_slurm(const StudyFolder& folder, const Study& study, const std::vector<Case>& cases,
                    const LocalOptions& options, const SlurmSettings& settings);

/// Runs one task of the array: the cases of its number in `tasks_file`, as a local run with one process at a
/// time. On a signal before the time limit (SIGUSR1) it abandons the running case and requests to be queued
/// again; a case that exceeds the limit fails.
RunReport run_slurm_task(const StudyFolder& folder, const Study& study, const std::vector<Case>& cases,
                         const LocalOptions& options, const std::string& tasks_file);

}  // namespace cleft
