// A disk that is full, and writes that fail.
#pragma once

#include <optional>
#include <random>

#include "tests/faults/study_under_fault.h"

namespace cleft::faults {

struct DiskReport {
  int runs = 0, failed = 0;
};

/// Runs the study on small file systems of random sizes, then gives them room. None where this user may not
/// mount one.
std::optional<DiskReport> fill_the_disk(const StudyUnderFault& study, int runs, std::mt19937& random);

/// Runs it with writes to files, and flushes, that fail at random (failing_writes.cpp).
DiskReport fail_writes(const StudyUnderFault& study, int runs, std::mt19937& random);

}  // namespace cleft::faults
