// What a wound does to the skin around it, counted over the mesh alone.
#pragma once

#include <string>
#include <vector>

#include "explorer/wound/replayed_wounds.h"

namespace cleft::stress {

/// What fields can do at most, found by evaluating them over their domain; mm.
struct FieldLimits {
  explicit FieldLimits(const Field& field);
  /// Of the fields of a family along the paths of wounds.
  explicit FieldLimits(const std::vector<Wound>& wounds);
  double displacement = 0;  ///< largest
  double strain = 0;        ///< largest norm of the displacement's gradient along and across, mm per mm
  std::vector<Vec3> large;  ///< displacements of at least a third of the largest

 private:
  void take(const Derivatives& d);
  void keep_large();
};

/// Counts over all positions of the blade that were looked at. A triangle or an edge counts once.
struct Opened {
  long positions = 0;
  long turned = 0;  ///< skin triangles whose normal turns by more than 90 degrees, or that shrink to a fifth
  long turned_by_field = 0;  ///< others of them that the field turns in its own flat patch
  long unnamed = 0;          ///< of these and the others: that the guard does not name
  long torn = 0;             ///< skin edges below 0.5 mm whose ends move apart by more than 1 mm
  long stretched = 0;        ///< skin edges stretched by more than three times the field's largest strain
  long torn_by_field = 0;    ///< others of either that the field stretches so in its own flat patch
  long spikes = 0;           ///< vertices that move further than the field's largest displacement and a tenth
  long crossed = 0;          ///< pairs of lips that pass each other by more than 0.05 mm
  long unsteady = 0;         ///< positions that are not the same to the bit when time comes back
  double largest = 0;        ///< displacement over the field's largest
  double least_determinant = 1;  ///< of a skin triangle: its area over that at rest, less than 0 if it turns
  double passed = 0;             ///< mm by which lips pass each other at most
  double opening = 0;            ///< mm: sum over the pairs of lips of the complete cuts
  Vec3 first_turned;             ///< where, at rest
  std::string first_is;          ///< its corners

  bool sound() const { return turned + torn + stretched + spikes + crossed + unsteady == 0; }
  void add(const Opened& other);
};

/// Opens the cuts, all in one mesh, at `count` positions of the blade.
Opened look_at_opened(const ReplayedWounds& wounds, const FieldLimits& limits, int count);

std::string text_of(const Opened& opened);

}  // namespace cleft::stress
