// How far displacements must fall before the coordinates of a cut jump.
#pragma once

#include <array>
#include <vector>

#include "explorer/incision/incision.h"
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

/// The place on the canonical cut of the place s of a path of length `length` (all mm). `opens_on`: of a cut
/// that begins in another one, which is open at its start; nearer to it than that it opens as there.
struct CanonicalPlace {
  double u, time_offset;
};
CanonicalPlace canonical_place(double s, double length, const CanonicalCut& cut, double opens_on = 0);

/// The displacements of a field at each place of the skin while the blade goes the given length, mm: the
/// largest one, sampled, and of two places next to each other the larger one.
class LargestDisplacement {
 public:
  LargestDisplacement() = default;  ///< of nothing: 0
  LargestDisplacement(const VaryingField& field, double length);

  double at(double u, double v) const;
  double anywhere() const;
  /// The displacement with the blade at each of a few places of the way, linear between the samples.
  static constexpr int samples_in_time = 3;
  using InTime = std::array<Vec3, samples_in_time>;
  InTime in_time(double u, double v) const;

 private:
  /// Of samples at even distances.
  template <class Value, class Sample>
  Value between(double u, double v, const Sample& sample) const;

  Interval u_{}, v_{};
  std::vector<double> largest_;                 // [along][across]
  std::vector<std::array<InTime, 2>> in_time_;  // likewise, of the left and the right side
};

/// The part of a field's displacement that a place beside a cut may take. Displacements are at most a quarter
/// of the distance to where the coordinates jump: neighbours on both sides of a jump then move apart by no
/// more than a quarter of their distance, whatever their coordinates are, and the skin's strain grows by no
/// more. A family's displacements at both sides of a jump are mostly nearly the same, seen from two places of
/// the path: of these only jumps count over which they differ.
class WoundRoom {
 public:
  /// `scale`: mm per mesh unit.
  WoundRoom(const Incision& incision, const VaryingField& field, double scale);
  /// Must be called when the incision's path was extended.
  void follow_path(const Incision& incision);

  /// Lengths in mesh units; side both: on the path, ahead of the blade or at its ends.
  struct Place {
    Vec3 position;
    double s, across;  ///< coordinates
    double straight;   ///< distance from the path in a straight line, on the side of across
    Side side;
  };
  double weight(const Place& at) const;
  /// The part of the field's displacement that the whole cut takes: less than 1 where it is so short that the
  /// field does not resolve it.
  double of_short_cut() const { return short_cut_; }

 private:
  double largest(double s, double across) const;
  double strain(const Surroundings::Irregular& at, const ScalpelPath& path) const;
  double bend(const Place& at, bool right) const;
  void find_bends(const Incision& incision);
  void find_jumps(const Incision& incision);
  void find_ends(const Incision& incision);

  std::array<RoomAlong, 2> bends_;  // to the path's own medial axis, left and right; not of a family
  std::array<NearestPlace, 2> irregular_;
  /// An end of the path, around which both sides hang together, and the lesser of its rooms.
  struct End {
    Vec3 position;
    double room;
  };
  std::vector<End> ends_;
  LargestDisplacement largest_;
  double short_cut_ = 1;
  double scale_, length_;  // mm per mesh unit; of the path as the field was sampled for it, mm
  CanonicalCut cut_;
  bool family_;
};

}  // namespace cleft
