// Bodies with cracks in closed form, as another program would leave them: of any shape, anywhere.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/import/source_series.h"

namespace cleft {

/// A grid of hexahedra (of quads, where it has one level) over (a, b, c): along the crack, across it, height.
/// Nodes of the crack are doubled where cells on both sides of it meet.
struct CrackedBody {
  std::string name;
  std::vector<double> a, b, c;  ///< planes of nodes
  std::vector<double> times;
  std::vector<double> cracks = {0};  ///< planes b = const with a crack
  /// Of a node in such a plane: whether it is doubled.
  std::function<bool(const Vec3& abc)> doubled;
  /// The side that the node of a cell is on, by the cell's middle; nodes at one place on other sides are
  /// others. By default that of `cracks`: -1 or 1 where the node is doubled, else 0.
  std::function<int(const Vec3& abc, const Vec3& middle)> side = {};
  /// Of the middle of a cell: whether it is there.
  std::function<bool(const Vec3& abc)> solid = [](const Vec3&) { return true; };
  std::function<Vec3(const Vec3& abc)> place = [](const Vec3& abc) { return abc; };  ///< in space
  /// In space; `side` is that of the crack on which the node is, and else 0.
  std::function<Vec3(const Vec3& abc, int side, double t)> displacement;

  struct Node {
    Vec3 abc;
    int side;  ///< of the crack that it is on: -1, 1 (or others of several cracks); else 0
  };
  std::vector<Node> nodes() const { return mesh().nodes; }
  /// The displacement, as the field `displacement`.
  SourceSeries series() const;

 private:
  struct Mesh {
    std::vector<Node> nodes;
    SourceSeries series;
  };
  Mesh mesh() const;
};

/// front, front + step, ..., back.
std::vector<double> planes(double front, double back, int cells);

/// Displacement, in (a, b), beside the front of a crack of mode I that ends at a = 0 (Williams 1957; nu =
/// 0.3, plane strain): the lips part by 5.6 sqrt(-a).
Vec3 beside_front(double a, double b, int side);

/// Around a slit of half length R along x: Im of sqrt(R^2 - z^2), on the slit +- sqrt(R^2 - x^2), less what
/// is linear far away.
double around_slit(double x, double y, double R, int side);

/// An edge crack that grows from a = 0 to a = 24, through bodies of 40 x 30 x 6, one column of a unit at a
/// time.
CrackedBody edge_crack();

/// The body's places and displacements moved rigidly.
CrackedBody posed(CrackedBody body, const std::string& name, const Pose& pose);

/// The rows of the table: edge_crack() and how it is changed.
std::vector<CrackedBody> cracked_bodies();

/// The same for bodies with several cracks, which may meet.
std::vector<CrackedBody> bodies_of_several_cracks();

/// Adds `at_start` to the first components of the displacement in all frames, and the field S: a symmetric
/// tensor made of the displacement, which tells whether tensors are turned with the body.
void add_start_and_tensor(SourceSeries& series, double at_start);

}  // namespace cleft
