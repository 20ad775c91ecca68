// The skin next to a cut while the blade passes it. A lip opens all of a sudden when the blade comes by, so
// that a small triangle may turn over between two positions of the blade at which all of the skin was looked
// at. Here each triangle next to the path is looked at while the blade passes that very triangle.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "explorer/wound/wound.h"

namespace cleft {

class GuardPassage {
 public:
  /// Vertices that the complete cut moves, and s of each of them, mm. All of the skin is looked at each
  /// `step` mm of the blade's way, without it.
  GuardPassage(const Wound& wound, const std::vector<std::pair<int, double>>& vertices, double step);

  /// What is left of a triangle of the skin with the blade at s: its area seen along its normal at rest, over
  /// that at rest, or `unsound` where it is not sound.
  using Left = std::function<double(int triangle, double s)>;
  static constexpr double unsound = -std::numeric_limits<double>::infinity();

  /// A triangle next to the path, and s of those of its corners that are, mm, ascending.
  struct Beside {
    int triangle;
    std::vector<double> s;
  };
  const std::vector<Beside>& beside() const { return beside_; }

  /// Tells of the positions of the blade, mm, at which the triangle is not sound: of each that is looked at,
  /// and of the worst where the least that is left of it lies between these. From `first` to `last` no other
  /// position is nearer. Whoever is told may mend it: left is asked anew for each position. Whether it has
  /// told of any. The positions differ from round to round.
  using Tell = std::function<void(double s, double first, double last)>;
  bool look(const Beside& one, int round, const Left& left, const Tell& tell) const;
  /// mm of the blade's way over which displacements next to the tip change quickly.
  double near_tip() const { return near_; }

 private:
  std::vector<double> looks(const Beside& one, int round) const;

  std::vector<Beside> beside_;
  double reached_, near_;  // mm: where the cut ends; how far from the blade displacements change quickly
  double way_;             // mm: before and after it passes a triangle
};

}  // namespace cleft
