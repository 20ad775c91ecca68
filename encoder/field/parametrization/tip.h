// The parametrisation that follows the tip. All parameters are normalised:
//   along   0 patch's edge, 1 start of the cut, 2 tip at time t, 3 far edge; between them monotone and
//   smooth, such
//           that knots lie at nearly the same distances from start and tip while the cut grows
//   across  -1 .. 0 left of the cut, 0 .. 1 right of it
//   height  0 skin, -1 bottom of the cut, -2 bottom of the patch (-1 where the cut goes through)
//   time    0 .. 1
#pragma once

#include "encoder/field/parametrization.h"

namespace cleft {

class TipParametrization final : public Parametrization {
 public:
  using Parametrization::Parametrization;
  static constexpr const char* id = "tip";
  std::string name() const override { return id; }
  Along along(double u, double t) const override;
  Single across(double v) const override;
  Single height(double w) const override;
  Single time(double t) const override;
  double u_at(double along, double t) const override;
  double v_at(double across) const override;
  double w_at(double height) const override;
  double time_at(double parameter) const override;
  bool moves() const override { return true; }
  bool moves_at(double u) const override { return u > geometry().cut.start && u < domain()[0].back; }
  void map(std::span<const Place> places, BasisPlace* out) const override;

 private:
  double scale() const;
  Along along_at(double u, double tip, double speed) const;
};

}  // namespace cleft
