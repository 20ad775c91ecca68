// --tension and --prestress, alike in all commands that open cuts.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "base/command/command.h"
#include "base/error.h"
#include "base/text.h"

namespace cleft {

/// Throws InputError if the three numbers of an option have no length, or one that is no number.
inline void check_direction(const std::string& option, const std::vector<double>& x) {
  const double length = std::hypot(x[0], x[1], x[2]);
  if (length > 0 && std::isfinite(length)) return;
  throw InputError(option + " " + shortest(x[0]) + "," + shortest(x[1]) + "," + shortest(x[2]) +
                   ": has no length; give a direction within the skin");
}

struct TensionOptions {
  std::vector<double> direction, prestresses;  ///< three numbers; two, MPa; empty: not given

  void add_to(CommandLine& app) {
    auto* tension =
        app.add_option("--tension", direction, "X,Y,Z: direction of the skin's larger tension, in space")
            ->delimiter(',')
            ->expected(3);
    auto* prestress =
        app.add_option("--prestress", prestresses, "LARGER,SMALLER: the skin's principal prestresses, MPa")
            ->delimiter(',')
            ->expected(2)
            ->check(at_least(0));
    tension->needs(prestress);
    prestress->needs(tension);
  }
};

}  // namespace cleft
