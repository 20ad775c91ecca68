// A block with a cut from its top that grows along u, in closed form; of any kind of solid cells.
#pragma once

#include <functional>
#include <map>
#include <tuple>

#include "tests/import/source_series.h"

namespace cleft {

/// The block is [-16, 16] x [-6, 6] x [-5, 0] of cubes of 2 x 2 x 1. Nodes with |u| <= 8, v = 0, w >= -2 are
/// doubled.
class Plate {
 public:
  enum class Cells { hexahedra, tetrahedra, wedges, quadratic_hexahedra };

  static constexpr double half_cut = 8, depth = 2;
  /// By frame: columns at smaller u are open.
  static constexpr double tips[] = {-100, -7, -3, 1, 9};
  static constexpr std::size_t frames = 5;

  Plate(Cells cells, const Pose& pose);
  virtual ~Plate() = default;

  /// In (u, v, w), of a node.
  std::vector<Vec3> local;
  std::vector<int> side;  ///< -1 and 1 of doubled nodes, else 0

  Vec3 displacement(std::size_t node, std::size_t frame) const;
  std::vector<double> stress(std::size_t node, std::size_t frame) const;
  double temperature(std::size_t node, std::size_t frame) const;
  /// With displacement, stress and temperature, at times 3, 3.5, 4.25, 5, 8.
  SourceSeries series() const;
  static bool is_doubled(const Vec3& p) {
    return p.y == 0 && -half_cut <= p.x && p.x <= half_cut && p.z >= -depth;
  }
  /// Of a doubled node.
  static bool is_open(const Vec3& p, std::size_t frame) { return p.x < tips[frame]; }

 private:
  std::int32_t node(const Vec3& p, int side_of_cell);
  void fill(Cells cells);

  Pose pose_;
  SourceSeries mesh_;
  std::map<std::tuple<double, double, double, int>, std::int32_t> numbers_;
};

}  // namespace cleft
