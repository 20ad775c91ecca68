// What is known of a cut that its field may not know, and the error of its opening that follows from it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "explorer/guard/guard.h"
#include "explorer/wound/opening_error.h"
#include "explorer/wound/wound.h"

namespace cleft {

/// Lengths in mm.
struct Validity {
  double smallest_radius =
      0;  ///< of the path's bends, or half the way to another part of it; infinite: straight
  double largest_tilt = 0;   ///< degrees: of the blade against the skin's normal
  double length_defect = 0;  ///< excess of an endless cut's opening over the field's, relative to it
  double nearest_cut = 0;    ///< least distance from another cut's path; infinite if there is none
  /// Where it meets another cut: the largest ratio of the tension along that cut to the tension across it;
  /// none if it meets none.
  std::optional<double> junction_tension;
  /// By how much the displacement of the lips may be less than the field's, at most and where, mm: they must
  /// not pass through each other where the path bends or comes back.
  double held_back = 0, held_back_at = 0;
  /// Vertices that move otherwise than the fields say, because the skin would turn over or tear: how many
  /// there are, by how much at most with the cuts complete, and where along the path, mm.
  int guarded_vertices = 0;
  double guarded = 0, guarded_at = 0;
  /// Triangles of the skin that turn over, shrink below a fifth of their area or tear in spite of that, each
  /// once: where along the path, mm, and where in the mesh, at rest and in its units; and where the blade is
  /// then: mm of a cut, counted from 0. In a live cut, those with the cuts complete alone.
  struct Unsound {
    double at;
    Vec3 place;
    std::size_t blade_in;
    double blade_at;
    bool torn;  ///< otherwise turned over or shrunk
  };
  std::vector<Unsound> unsound;
  /// The expected error of the opening against a simulation of the body, over the largest opening: along the
  /// path, and its largest.
  OpeningError expected_error;
  /// One sentence where that is above a tenth, and one where triangles are unsound.
  std::vector<std::string> warnings;
};

/// The validity of every cut. `turned`: whether their fields follow the tension.
std::vector<Validity> validity_of(const std::vector<const Wound*>& cuts, bool turned,
                                  const Guard& guard = {});

}  // namespace cleft
