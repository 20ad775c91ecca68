// --tension and --prestress, alike in all commands that open cuts.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/command/command.h"
#include "base/error.h"
#include "base/text.h"
#include "explorer/wound/prestress_fields.h"

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
  std::string lines;                           ///< file in place of the direction; empty: not given

  bool given() const { return !prestresses.empty(); }

  /// Of a mesh whose unit is `scale` mm, in coordinates from `origin`, mesh units; none if it was not given.
  std::optional<SkinTension> read(double scale, const Vec3& origin = {}) const {
    if (!given()) return std::nullopt;
    if (lines.empty() && direction.empty())
      throw InputError("--prestress: of which direction? Give --tension or --tension-lines too");
    if (lines.empty()) {
      check_direction("--tension", direction);
      return skin_tension(direction, prestresses);
    }
    std::vector<TensionLine> list = read_tension_lines(lines, scale);
    for (TensionLine& line : list) line.place -= scale * origin;
    const Vec3& first = list.front().direction;
    std::optional<SkinTension> tension = skin_tension({first.x, first.y, first.z}, prestresses);
    tension->lines = std::make_shared<const std::vector<TensionLine>>(std::move(list));
    return tension;
  }

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
    app.add_option(
           "--tension-lines", lines,
           "CSV with columns x,y,z,dx,dy,dz, in the mesh's units: lines of the skin's larger tension, "
           "in place of --tension; between them it has the mean of their directions")
        ->excludes(tension)
        ->needs(prestress);
  }
};

}  // namespace cleft
