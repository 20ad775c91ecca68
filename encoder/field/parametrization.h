// The parametrisation: from a point of the tissue and a time to the parameters of the field's four bases. A
// new one is one file in parametrization/ and a line in parametrization.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "encoder/field/place.h"

namespace cleft {

/// The canonical cut of a case: from (start, 0, 0) along u, `depth` below the skin, grown to `length` at the
/// last frame. mm; length 0: there is no cut, and the field has no break.
struct CanonicalCut {
  double start = 0, length = 0, depth = 0;

  friend bool operator==(const CanonicalCut&, const CanonicalCut&) = default;
};

/// u of the tip over t, both mm: piecewise linear and never decreasing.
struct TipPath {
  std::vector<double> times, positions;

  bool still() const { return positions.front() == positions.back(); }  ///< whether it never moves
  double at(double t) const;     ///< position, constant outside the times
  double speed(double t) const;  ///< of the piece that begins at t or contains it
  double passes(
      double u) const;  ///< first time at which the tip is at u or beyond; infinity if it never does

  friend bool operator==(const TipPath&, const TipPath&) = default;
};

struct Interval {
  double front = 0, back = 0;

  friend bool operator==(const Interval&, const Interval&) = default;
};

/// The data of a parametrisation, which a field file holds together with its name.
struct FieldGeometry {
  std::array<Interval, 4> domain;  ///< u, v, w (mm) and t
  CanonicalCut cut;
  TipPath tip;

  friend bool operator==(const FieldGeometry&, const FieldGeometry&) = default;
};
/// The same at all times: the tip stands at the end of the cut, a column of nodes; its last front may be
/// within the elements before.
FieldGeometry standing(FieldGeometry geometry);

class Parametrization {
 public:
  explicit Parametrization(FieldGeometry geometry) : geometry_(std::move(geometry)) {}
  virtual ~Parametrization() = default;

  /// The parameter of the first basis, and its derivatives by u and t: the only one that may move with t.
  struct Along {
    double value, by_u, by_t;
  };
  /// A parameter of v, w or t alone, and its derivative.
  struct Single {
    double value, slope;
  };
  virtual std::string name() const = 0;
  virtual Along along(double u, double t) const = 0;
  virtual Single across(double v) const = 0;
  virtual Single height(double w) const = 0;
  virtual Single time(double t) const = 0;
  // Inverses, for the places of knots and control points.
  virtual double u_at(double along, double t) const = 0;
  virtual double v_at(double across) const = 0;
  virtual double w_at(double height) const = 0;
  virtual double time_at(double parameter) const = 0;
  /// Whether along() depends on t. If not, the contraction of a point to a history is exact.
  virtual bool moves() const = 0;
  /// Whether distances from start and tip are measured as displacements grow there: fits need more spans
  /// along the cut, and fewer nodes for each.
  virtual bool resolves_front() const { return false; }
  /// The same at one u; may be true although along() is constant there.
  virtual bool moves_at(double) const { return moves(); }
  /// All four parameters of `places`, which are clamped to the domain; `out` has room for them. Overridden
  /// for speed only: map_each(*this, ...) in a final class calls no virtual function.
  virtual void map(std::span<const Place> places, BasisPlace* out) const { map_each(*this, places, out); }

  /// The two parameters that may move with t, of a place within the domain. Overridden for speed only.
  struct Moving {
    double along, time;
  };
  virtual Moving moving(double u, double t) const { return {along(u, t).value, time(t).value}; }

  const FieldGeometry& geometry() const { return geometry_; }
  const std::array<Interval, 4>& domain() const { return geometry_.domain; }

  /// x clamped to the domain on an axis; NaN stays NaN.
  double inside(double x, int axis) const {
    const auto [front, back] = domain()[axis];
    return x < front ? front : back < x ? back : x;
  }

 protected:
  template <class P>
  static void map_each(const P& p, std::span<const Place> places, BasisPlace* out) {
    for (const Place& place : places) {
      const double t = p.inside(place.t, 3), v = p.inside(place.uvw.y, 1);
      *out++ = {{p.along(p.inside(place.uvw.x, 0), t).value, p.across(v).value,
                 p.height(p.inside(place.uvw.z, 2)).value, p.time(t).value},
                v == 0 ? place.side : side_of(v)};
    }
  }

 private:
  FieldGeometry geometry_;
};

/// "front", "tip", or "fixed" (u, v, w, t themselves; the paper's). Throws InputError for any other name.
std::shared_ptr<const Parametrization> make_parametrization(const std::string& name, FieldGeometry geometry);

/// The names make_parametrization knows, the default first.
const std::vector<std::string>& parametrization_names();

}  // namespace cleft
