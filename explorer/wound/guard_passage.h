// The skin next to a cut while the blade passes it. A lip opens all of a sudden when the blade comes by, so
// that a small triangle may turn over between two positions of the blade at which all of the skin was looked
// at. Here each triangle next to the path is looked at while the blade passes that very triangle.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "explorer/wound/wound.h"

namespace cleft {

class GuardPassage {
 public:
  /// Vertices that the complete cut moves, and s of each of them, mm.
  GuardPassage(const Wound& wound, const std::vector<std::pair<int, double>>& vertices);

  /// What is left of a triangle of the skin with the blade at s: its area seen along its normal at rest, over
  /// that at rest, or `unsound` where it is not sound.
  using Left = std::function<double(int triangle, double s)>;
  static constexpr double unsound = -std::numeric_limits<double>::infinity();

  /// Positions of the blade, mm, ascending, at which triangles are not sound: one for each of them, but
  /// `most` in all.
  std::vector<double> find(const Left& left, std::size_t most) const;

 private:
  struct Beside {
    int triangle;
    double first, last;  // s of its corners, mm
  };
  std::vector<double> looks(const Beside& one) const;
  static std::optional<double> least(const Left& left, int triangle, const std::vector<double>& looks);

  std::vector<Beside> beside_;
  double reached_, near_;  // mm: where the cut ends; how far from the blade displacements change quickly
};

}  // namespace cleft
