// Where the lips of a body's cuts are, for a mesh with the same cuts.
#pragma once

#include <map>
#include <vector>

#include "explorer/incision/incision.h"
#include "solver/body/body.h"

namespace cleft {

/// By node of a body: the first one of those at its place.
std::vector<int> first_at_place(const Body& body);

/// The nodes of a body on both lips of one of its cuts, along its path, and how far they are from the lips of
/// a mesh, which follow the same path otherwise.
class BodyLips {
 public:
  /// `scale` is mm per mesh unit.
  BodyLips(const Body& body, int number, const Incision& cut, double scale);

  /// The node nearest to s of the path, mesh units, on one lip; -1 where cuts meet, or there is none.
  int node(double s, bool right) const;
  /// From the lips of the mesh at s of the path to those of the body, mm; beyond where both are open, as at
  /// the nearest such place.
  Vec3 offset(double s) const;

 private:
  struct Station {
    int left, right;
    Vec3 at;     // mm
    bool alone;  // on this cut alone
  };
  void add_earlier_passes(const Incision& cut);

  double scale_;
  std::map<double, Station> stations_;  // by mm of the path
  std::vector<double> s_;               // increasing
  std::vector<Vec3> offset_;            // by s_
};

/// A body is cut beyond the ends of a path, up to nodes that stay closed, because its opening is then that of
/// the path (params/meshed_cut.h). The mesh ends at these nodes: what is near its ends is moved there.
class EndShift {
 public:
  EndShift(const Body& body, const std::vector<const Incision*>& cuts, double scale);

  Vec3 at(const Vec3& x) const;  ///< of a place; both in mm
  double reach() const;          ///< the largest from an end, mm

 private:
  struct End {
    Vec3 at, by;
    double reach;
  };
  std::vector<End> ends_;
};

}  // namespace cleft
