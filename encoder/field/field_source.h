// Where imported data come from, and which piece of a body with several breaks a field stands for.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/turned.h"
#include "encoder/field/break_map.h"

namespace cleft {

/// The part of a piece's plane v = 0 that its break takes up, in the piece's own coordinates.
struct BreakExtent {
  Interval along, height;  ///< u and w of the pairs that part; around a round front only `along` counts
  /// Whether another break begins at along.front, along.back, height.front, height.back.
  std::array<bool, 4> joined{};
  /// Of all pieces: how far their breaks are away, mm. 0: they meet, or it is this one.
  std::vector<double> gaps = {};

  /// 8 numbers and the gaps, for files, and back; throws InputError if they are no such extent.
  std::vector<double> numbers() const;
  static BreakExtent from(const std::vector<double>& numbers);
};

/// So that imported data can be written as they were. Points x of that space are at (u, v, w) = axes (x -
/// origin); a break that is no plane, or lies below parts of the body, has a map from there to the field's
/// own coordinates.
struct FieldSource {
  std::string file = {};                   ///< the series' name, without folders
  Vec3 origin = {};                        ///<
  AxesInSpace axes = same_axes;            ///< unit vectors of u, v, w, right-handed
  std::vector<double> times = {};          ///< of the frames, in the source
  std::vector<std::string> fields = {};    ///< SOURCE:NAME or SOURCE:NAME[UNIT]: SourceName
  std::optional<BreakMap> map = {};        ///<
  std::optional<BreakExtent> extent = {};  ///< of one of several breaks

  /// The field's own coordinates of a point in the source's space.
  Vec3 canonical(const Vec3& x) const {
    const Vec3 placed = turned(x - origin, axes);
    return map ? map->canonical(placed) : placed;
  }
};

/// "S:stress[MPa]": what a field is called in the source, what it is called here, and its unit, "" where that
/// is not told. Without a colon both are the whole text, brackets included.
struct SourceName {
  explicit SourceName(const std::string& text);
  std::string there, here, unit = {};
};
/// The unit of the field that is called `name` here; "" where it is not told.
std::string unit_of(const FieldSource& source, const std::string& name);

/// How much the field of each of several pieces, whose breaks are at `sources`, counts at a point of the
/// source's space; the weights sum to 1, and change smoothly. A piece counts where its break is the nearest:
/// between two breaks at distances a and b both count where |a - b| is less than a fifth of the gap between
/// them, or of a + b where they meet. Distances beyond an end at which another break begins count four times,
/// so that where breaks meet each has its sectors to itself.
void piece_weights(std::span<const FieldSource* const> sources, const Vec3& x, std::span<double> out);

/// Points just inside the cells of each node, N: by them a node at a break is on the side of its cells.
std::vector<Vec3> places_inside_cells(const std::vector<Vec3>& points,
                                      const std::vector<std::int64_t>& offsets,
                                      const std::vector<std::int64_t>& connectivity);

}  // namespace cleft
