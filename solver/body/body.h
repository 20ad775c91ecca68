// The body file body.h5 (docs/formats.md): the mesh of a true body with its cuts, ready to be solved.
// It is also a VTKHDF 2.0 UnstructuredGrid.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/h5/h5.h"
#include "base/vec3.h"
#include "params/region_material.h"

namespace cleft {

/// Version 2: with regions.
inline constexpr FileFormat body_format{"cleft-body", 1, "body", "cleft body", {2}};

/// What holds a face of the tissue's lower side.
enum class Support : std::uint8_t { springs = 0, bone = 1 };

/// Two nodes at one place, on either side of a cut.
struct BodyPair {
  std::int32_t left, right;  ///< a right node is the left one of later pairs only
  std::int32_t cut;          ///< number of the cut that parts them, from 0
  double along;              ///< mm of that cut's path
  double depth;              ///< mm below the skin
  Vec3 normal;               ///< of the cut, unit, from left to right
};

/// N nodes, T triangles of skin. Lengths in mm; the body as it lies, all cuts closed.
struct Body {
  std::vector<Vec3> points;  ///< N
  std::vector<std::array<int, 6>>
      wedges;                            ///< lower triangle, then upper, both counter-clockwise from outside
  std::vector<std::array<int, 3>> skin;  ///< T: triangle t is the upper one of wedge t
  std::vector<Vec3> tension;             ///< T: unit, in the triangle: the direction of skin.prestress_u
  std::vector<std::array<int, 3>> bottom;  ///< faces of the lower side
  std::vector<Support> support;            ///< of each of them
  std::vector<std::array<int, 4>> sides;   ///< faces at the rim, where the body goes on; cyclic
  std::vector<int> skin_above;             ///< N: the node of the skin from which a node hangs
  std::vector<RegionMaterial> materials;   ///< of the regions; none: all is one tissue
  std::vector<std::uint8_t> region;        ///< of each wedge, if there are regions: its number

  std::vector<BodyPair> pairs;         ///< in the order in which they open; each does
  std::vector<std::int32_t> released;  ///< F: number of pairs open in each frame; 0 in frame 0
  std::vector<double> position;        ///< F: place of the tip along the path of the cut being made, mm
  std::vector<double> times;           ///< F: length cut so far, mm
  double length = 0, depth = 0;        ///< of the first cut, mm; its largest depth

  /// Coordinates of the first cut, by node: u along its path from its middle, v across it over the skin, w
  /// above the skin (below: negative), mm; and the unit vectors of these directions, u then v then w.
  std::vector<Vec3> canonical;
  std::vector<std::array<Vec3, 3>> frames;

  std::string hash;  ///< of all numbers above, set by write_body and read_body
};

/// Writes a body completely or not at all; sets its hash.
void write_body(const std::string& path, Body& body);

/// Throws FileError if the file is not a body, is damaged, or is inconsistent: then the message names the
/// list and the row.
Body read_body(const std::string& path);

/// The same checks for a body that was made in memory; `name` stands for the file in messages.
void check_body(const Body& body, const std::string& name);

/// SHA-256 of all numbers, 16 hexadecimal digits.
std::string hash_of(const Body& body);

}  // namespace cleft
