// Files with one bit flipped, or cut short.
#pragma once

#include <random>

#include "tests/faults/study_under_fault.h"

namespace cleft::faults {

struct FlipReport {
  int damages = 0, detected = 0, without_effect = 0;
};

/// Damages a snapshot, a field, the study's file, a manifest and the index in turn: the reader must refuse
/// the file, or read what stands in the sound one (the index is made again where it is refused).
FlipReport flip_at_random(const StudyUnderFault& study, int damages, std::mt19937& random);

}  // namespace cleft::faults
