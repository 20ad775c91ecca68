// How far displacements must fall before the coordinates of a cut jump.
#pragma once

#include <vector>

#include "explorer/wound/varying_field.h"

namespace cleft {

/// A distance along a path that changes by no more than the way along it.
class RoomAlong {
 public:
  /// s must increase from call to call.
  void push_back(double s, double room) { s_.push_back(s), room_.push_back(room); }
  /// Reduces rooms to those of other places and the way from there.
  void even_out();
  /// Infinite where nothing limits it.
  double at(double s) const;

 private:
  std::vector<double> s_, room_;
};

/// The distance to the nearest of some places: a k-d tree.
class NearestPlace {
 public:
  NearestPlace() = default;
  explicit NearestPlace(std::vector<Vec3> places);

  /// `least` where none is nearer.
  double distance(const Vec3& x, double least) const;

 private:
  void sort(std::size_t first, std::size_t last);
  void search(std::size_t first, std::size_t last, const Vec3& x, double& least) const;

  std::vector<Vec3> places_;  // the middle one of each range divides it along its widest direction
  std::vector<int> axis_;
};

/// The largest displacement of a field at some distance from the cut or farther, while the blade goes the
/// given length, mm; sampled over the skin.
class LargestDisplacement {
 public:
  LargestDisplacement() = default;
  LargestDisplacement(const VaryingField& field, double length);

  double beside(double v) const;

 private:
  double width_ = 0;
  std::vector<double> largest_;  // at even distances from 0 to width_
};

}  // namespace cleft
