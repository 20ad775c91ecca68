// Cases of a study as sums of common modes, which are stored once.
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

/// The same cases as sums of modes, if that needs fewer bytes; else unchanged. The modes are
/// the leading left singular vectors of the cases on common knots, each divided by its largest displacement,
/// compared at nodes. A case becomes a sum of modes if it then differs nowhere at nodes by more than `error`
/// times its largest displacement. The number of modes minimises the bytes, to a sixteenth. Cases with
/// further quantities or derivatives, and cases with equal parameters, are unchanged. Throws InputError as
/// CommonCases does.
PackedStudy with_common_modes(const PackedStudy& own, double error);

}  // namespace cleft
