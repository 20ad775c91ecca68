// Cases of a study in fewer bytes: as sums of common modes, which are stored once, or in coarser steps.
#pragma once

#include <vector>

#include "encoder/field/file/study_file.h"

namespace cleft {

/// The content of study.dffd.
struct PackedStudy {
  std::vector<StudyRecord> cases;
  CodedModes modes = {};
};
std::size_t coefficient_bytes(const PackedStudy& study);  ///< approximate size of its file

/// The same cases where that needs fewer bytes as sums of modes, or with control points in coarser steps;
/// none then differs at nodes by more than `error` times its largest displacement. The modes are the leading
/// left singular vectors of the cases on common knots, each divided by its largest displacement, compared at
/// nodes; their number minimises the bytes, to a sixteenth. Cases with further quantities or derivatives are
/// unchanged, and cases with equal parameters are no sums. Throws InputError as CommonCases does.
PackedStudy with_common_modes(const PackedStudy& own, double error);

}  // namespace cleft
