// One run of the whole chain with one setting: simulation, field and opening.
#pragma once

#include <string>

#include "encoder/field/field.h"
#include "params/parameters/parameters.h"
#include "tradeoff/opening.h"

namespace cleft {

/// A simulation and its field, made by `cleft solve` and `cleft encode`.
class Chain {
 public:
  /// Solves in `folder`, which must outlive it; a later object overwrites its files. Throws
  /// std::runtime_error if a command fails.
  Chain(const Parameters& parameters, std::string folder);

  std::string snapshot() const { return folder_ + "/case.h5"; }
  Opening opening() const;
  double nodes() const { return nodes_; }
  double unknowns() const { return unknowns_; }
  double solve_seconds() const { return solve_seconds_; }  ///< of all processors together
  double wall_seconds() const { return wall_seconds_; }    ///< to solve, by the solver's own clock

  struct Encoded {
    Field field;
    double bytes, seconds;  ///< of all processors together
  };
  Encoded encoded(double tolerance) const;

 private:
  std::string folder_;
  double nodes_, unknowns_, solve_seconds_, wall_seconds_;
};

}  // namespace cleft
