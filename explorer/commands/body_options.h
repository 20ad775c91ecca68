// The options of a body below a surface, and its figures: of cleft body and cleft cut --simulate.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/command/command.h"
#include "explorer/body/body_maker.h"
#include "explorer/incision/incision.h"

namespace cleft {

struct BodyOptions {
  std::string bone, case_file;
  std::vector<std::string> assignments;
  std::vector<double> direction;
  double reach = 40;  ///< mm

  void add_to(CommandLine& app);
  /// The first of these options that was given; empty if none was.
  std::string first_given() const;
  bool given() const { return !first_given().empty(); }

  /// Without skin, paths and bone.
  BodyRequest request() const;
  /// In mm, relative to `origin`, mesh units; none if it was not given.
  std::optional<SurfaceIndex> read_bone(double scale, const Vec3& origin) const;

 private:
  CommandLine* app_ = nullptr;
};

/// In mm.
SurfaceMesh scaled(SurfaceMesh mesh, double scale);

Json figures_of(const BodyReport& report);
/// Prints the report's warnings on stderr as those of `command`.
void warn_of(const BodyReport& report, const char* command);

/// How far replayed positions are from simulated ones, of the vertices of skin, lips and walls, and of the
/// opening along the cuts: the largest distance over the largest displacement and opening of the simulation.
Json replay_off_by(const std::vector<const Incision*>& cuts, double scale, const std::vector<Vec3>& replayed,
                   const std::vector<Vec3>& simulated);

}  // namespace cleft
