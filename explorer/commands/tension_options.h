// --tension and --prestress, alike in all commands that open cuts.
#pragma once

#include <vector>

#include "base/command/command.h"

namespace cleft {

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
