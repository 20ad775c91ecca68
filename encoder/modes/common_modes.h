// All cases of a study as sums of a few common modes: what they have in common is stored once.
#pragma once

#include <vector>

#include "encoder/field/file/study_file.h"

namespace cleft {

/// What study.dffd is written from.
struct PackedStudy {
  std::vector<StudyRecord> cases;
  CodedModes modes = {};
};
std::size_t coefficient_bytes(const PackedStudy& study);  ///< of its file, about

/// The same cases as sums of modes, if that costs less than half the bytes; else as they are. Modes are the
/// leading left singular vectors of the cases, on common knots, each over its largest displacement, compared
/// where meshes have nodes. A case becomes a sum of them where it is then off nowhere there by more than
/// `error` times its largest displacement. So many modes are taken as make the fewest bytes. Cases with
/// further quantities or derivatives, and those whose parameters another case has too, stay as they are.
/// Throws InputError as CommonCases does.
PackedStudy with_common_modes(const PackedStudy& own, double error);

}  // namespace cleft
