// Runs the cases of a study as job arrays of Slurm.
#pragma once

#include <string>
#include <vector>

#include "params/run/local.h"

namespace cleft {

/// Submits what is missing and waits until all is published or has failed, as local runs do. What stands in
/// the study folder decides, never what the queue says; of the queue it is only asked which tasks are still
/// in it (squeue), so that a run that is started again finds its jobs. What a task did not do is submitted
/// again, three times at most. SIGINT leaves the jobs to themselves.
RunReport run_slurm(const StudyFolder& folder, const Study& study, const std::vector<Case>& cases,
                    const LocalOptions& options, const SlurmSettings& settings);

/// What a task of the array does: the cases of its number in `tasks_file`, as a local run of one process at a
/// time. A signal before the time limit (SIGUSR1) makes it give up what runs and ask to be queued again; a
/// case that the limit is too short for fails.
RunReport run_slurm_task(const StudyFolder& folder, const Study& study, const std::vector<Case>& cases,
                         const LocalOptions& options, const std::string& tasks_file);

}  // namespace cleft
