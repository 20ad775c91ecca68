// kill -9 at random moments.
#pragma once

#include <random>

#include "tests/faults/study_under_fault.h"

namespace cleft::faults {

struct KillReport {
  int kills = 0, drivers = 0, workers = 0, ranks = 0, studies = 0, raced = 0;
};

/// Kills drivers, their workers and MPI ranks until there have been so many kills, starts the run again
/// whenever it has ended, and compares every finished study. Now and then two runs of a study go at once.
KillReport kill_at_random(const StudyUnderFault& study, int kills, std::mt19937& random);

}  // namespace cleft::faults
