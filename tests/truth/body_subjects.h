// The bodies of cleft-truth-bodies: surfaces, paths and bone, by name. Lengths in mm.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/bodies/subjects.h"

namespace cleft::testing {

struct NamedSubject {
  std::string name;  ///< what it is, without commas
  std::function<Subject()> make;
};

/// Skin goes `margin` beyond the cuts.
std::vector<NamedSubject> body_subjects(double margin);

/// Straight cuts in flat skin, named by their text: LENGTH,ANGLE,X,Y[,DEPTH] of each, with blanks between
/// them; degrees, the place of the middle, and the depth of all. Throws InputError.
NamedSubject straight_cuts(const std::string& text, double margin);

}  // namespace cleft::testing
