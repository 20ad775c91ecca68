// Nodes in the coordinates of their cut, of a body or a shaped patch.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "encoder/cell_centres.h"
#include "encoder/field/break_map.h"
#include "encoder/field/parametrization.h"
#include "params/cut_curve.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

/// Of a patch along u and v: its grid's, whatever its shape; of others, what the nodes take up.
std::optional<std::array<Interval, 2>> own_domain(const Snapshot& snapshot);

/// A place of the cut in space, and the radius on which the cut turns there within the skin, mm.
struct Bend {
  double radius = std::numeric_limits<double>::infinity();
  Vec3 at = {};
};

/// The nodes of a body or a shaped patch in the coordinates of its cut, and the directions of these there. A
/// node beside a curved cut may have several places (curved_places.h): the first ones are those of all nodes.
struct OwnCoordinates {
  std::vector<Vec3> places;
  std::vector<std::array<Vec3, 3>> frames;  ///< of all places
  std::vector<std::size_t> node;            ///< of all places
  std::vector<std::size_t> kept;            ///< the places of the series
  std::size_t nodes = 0;                    ///< of these, the first ones: of nodes, one for each
  std::optional<BreakMap> around;           ///< a front, of which w is the angle then
  double turn = 0;                          ///< a whole turn of it, in mm; 0: it has none

  explicit OwnCoordinates(const SnapshotReader& reader);

  /// Of a displacement at a place.
  Vec3 components(std::size_t place, const Vec3& d) const {
    return {dot(frames[place][0], d), dot(frames[place][1], d), dot(frames[place][2], d)};
  }
  /// Radians between the directions of the cut that differ most, as they turn within the skin.
  double turning(const std::vector<std::array<std::int32_t, 2>>& pairs) const;
  /// Where the cut turns most tightly.
  Bend tightest_bend(const Snapshot& s) const;
  /// The snapshot in these coordinates, of the nodes that are kept. Cells are left out where the coordinates
  /// jump, as they do beyond the middle of a curved cut's circle.
  Snapshot of(const Snapshot& s) const;
  /// Moves the middles of cells to where they are around a front; others stay.
  void place_around_front(const Snapshot& s, CellCentres& middles) const;
  /// The nodes of the cells that are left out so, in increasing order of their numbers there.
  std::vector<std::int32_t> beside_jumps(const Snapshot& s) const;

 private:
  std::vector<std::int64_t> numbers() const;
  bool jumps(const Snapshot& s, std::span<const std::int64_t> cell) const;
  void add_turned_places(const BreakMap& map);
  void add_further_places(const CutCurve& cut);
  std::array<Interval, 2> extent() const;
  void fill_gaps(const std::array<Interval, 2>& domain);
};

}  // namespace cleft
