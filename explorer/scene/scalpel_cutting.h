// The mesh under the haptic scalpel: cut where the scalpel goes, opened as the field says, and felt as it is
// then. It runs at the rate of graphics on a thread of its own; the haptic thread never waits for it.
// Paper, 3.4 to 3.6.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "explorer/incision/incision.h"
#include "explorer/scene/cut_fields.h"
#include "explorer/scene/live_replay.h"
#include "haptic/contact_surface.h"
#include "haptic/loop.h"

namespace cleft {

/// Of all steps so far; times in seconds.
struct CuttingFigures {
  int steps = 0, cuts = 0;          ///< cuts: steps in which the mesh was cut
  std::size_t triangles_cut = 0;    ///< triangles that cuts changed or added, counted once a step
  TimeHistogram cut, open, update;  ///< the mesh; the field's displacements; the voxel grid after a cut
  std::size_t waiting = 0;          ///< vertices that moved and are told in the next steps
  std::string stopped;              ///< why the path could not go on; "" while it can
};

class ScalpelCutting {
 public:
  /// Without a path the mesh is felt and never cut; without fields cuts stay closed. `scale`: mm per mesh
  /// unit. Throws InputError where the path does not meet the mesh.
  ScalpelCutting(const SurfaceMesh& mesh, const std::optional<ScalpelPath>& path,
                 std::optional<CutFields> fields, double scale);

  const ContactSurface& surface() const { return *surface_; }  ///< in mm
  double cut_length() const;                                   ///< mm
  const CuttingFigures& figures() const { return figures_; }
  const Incision* incision() const { return incision_ ? &*incision_ : nullptr; }

  /// Cuts to where the scalpel is, if it cuts, and opens the wound.
  void step(const HapticState& scalpel);

 private:
  /// Most vertices that are told to move in one step: the others wait, so that no step takes long.
  static constexpr std::size_t most_moved = 4000;

  double reached(const HapticState& scalpel) const;
  void cut_to(double s);
  void open();
  void tell();

  double scale_;
  std::optional<CutFields> fields_;
  std::optional<VaryingField> field_;  // of the path
  std::optional<Incision> incision_;
  std::unique_ptr<ContactSurface> surface_;
  std::unique_ptr<LiveReplay> opening_;  // from the first cut on
  std::vector<Vec3> displacements_;      // mm, of vertices, as told to the surface
  std::deque<int> untold_;               // vertices that have moved since
  std::vector<bool> is_untold_;
  std::vector<ContactSurface::Moved> moved_;
  std::vector<ContactSurface::Changed> changed_;
  std::vector<int> vertices_;
  CuttingFigures figures_;
};

}  // namespace cleft
