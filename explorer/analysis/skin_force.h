// Forces of the skin that are measured: what a punch is pressed in with, and what pulls the lips apart.
#pragma once

#include <string>

#include "params/parameters/recorded.h"

namespace cleft {

/// Of the parameters of a case alone, so that nothing is interpolated.
struct SkinForce {
  enum class Kind {
    /// N: presses a rigid flat punch into the closed skin, far from the edges, to a depth.
    punch,
    /// N/mm: of each millimetre of the closed cut, across it, what holds the lips together. Prestress of the
    /// skin times its thickness, and of the tissue times the cut's depth.
    tension
  };
  Kind kind = Kind::tension;
  double dent = 0, radius = 0;  ///< mm: of the punch

  std::string text() const;
  const char* unit() const { return kind == Kind::punch ? "N" : "N/mm"; }
  /// Throws InputError if the parameters do not tell it: too few are recorded, or the case is none that the
  /// formula is of.
  double of(const RecordedParameters& parameters) const;
  /// The largest error of the formula, relative to the force: what a patch with sides differs from a layer
  /// without (haptic/surface_stiffness.h).
  double relative_error() const { return kind == Kind::punch ? 0.02 : 0; }
};

}  // namespace cleft
