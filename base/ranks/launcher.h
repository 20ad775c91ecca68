// What the environment tells of the program that has started this process together with others: mpirun or
// srun.
#pragma once

#include <sys/prctl.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>

namespace cleft {

/// How many processes the launcher says that it has started; 1 without one.
inline int started_together() {
  int most = 1;
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"})
    if (const char* count = std::getenv(name)) most = std::max(most, std::atoi(count));
  return most;
}

/// Whether MPI can ask a launcher for the other processes, of which there may be none.
inline bool has_launcher() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
    if (std::getenv(name)) return true;
  return false;
}

/// Ends this process with its launcher, also where that is killed.
inline void end_with_launcher() { prctl(PR_SET_PDEATHSIG, SIGKILL); }

}  // namespace cleft
