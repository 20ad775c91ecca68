// The options of a body below a surface, and its figures: of cleft body and cleft cut --simulate.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/command/command.h"
#include "explorer/body/body_maker.h"
#include "explorer/body/simulated_wounds.h"

namespace cleft {

struct BodyOptions {
  std::string bone, case_file, lines;
  std::vector<std::string> assignments;
  std::vector<double> direction;
  double reach = 40;  ///< mm

  void add_to(CommandLine& app);
  /// The first of these options that was given; empty if none was. --bone may not count.
  std::string first_given(bool but_bone) const;

  bool given(const std::string& name) const { return app_->count(name) > 0; }

  /// Without skin, paths and bone, of a mesh whose unit is `scale` mm. `of_field`: parameters in place of the
  /// defaults.
  BodyRequest request(double scale, const RecordedParameters& of_field = {}) const;
  /// As bone_below(); null if none was given.
  std::shared_ptr<const SurfaceIndex> read_bone(double scale, const Vec3& origin) const;

 private:
  CommandLine* app_ = nullptr;
};

/// In mm.
SurfaceMesh scaled(SurfaceMesh mesh, double scale);

/// The surface of a mesh file, in mm, relative to `origin`, mesh units.
std::shared_ptr<const SurfaceIndex> bone_below(const std::string& file, double scale, const Vec3& origin);

Json figures_of(const BodyReport& report);

Json figures_of(const ReplayOff& off, double scale);

}  // namespace cleft
