// One setting of the whole chain, run: simulation, field, and how its opening compares.
#pragma once

#include <string>

#include "encoder/field/field.h"
#include "params/parameters.h"
#include "tradeoff/opening.h"

namespace cleft {

/// A simulation and its field, made by `cleft solve` and `cleft encode`.
class Chain {
 public:
  /// Solves in `folder`, which must outlive it. Throws std::runtime_error where a command fails.
  Chain(const Parameters& parameters, std::string folder);

  const Opening& opening() const { return opening_; }
  double nodes() const { return nodes_; }
  double solve_seconds() const { return solve_seconds_; }  ///< of all processors together

  struct Encoded {
    Field field;
    double bytes, seconds;  ///< of all processors together
  };
  Encoded encoded(double tolerance) const;

 private:
  std::string folder_;
  double nodes_ = 0, solve_seconds_ = 0;
  Opening opening_;
};

}  // namespace cleft
