// The paper's parametrisation: the stress-free position and the length cut themselves.
#pragma once

#include "encoder/field/parametrization.h"

namespace cleft {

class FixedParametrization final : public Parametrization {
 public:
  using Parametrization::Parametrization;
  static constexpr const char* id = "fixed";
  std::string name() const override { return id; }
  Along along(double u, double) const override { return {u, 1, 0}; }
  Single across(double v) const override { return {v, 1}; }
  Single height(double w) const override { return {w, 1}; }
  Single time(double t) const override { return {t, 1}; }
  double u_at(double along, double) const override { return along; }
  double v_at(double across) const override { return across; }
  double w_at(double height) const override { return height; }
  double time_at(double parameter) const override { return parameter; }
  bool moves() const override { return false; }
  void map(std::span<const Place> places, BasisPlace* out) const override { map_each(*this, places, out); }
};

}  // namespace cleft
