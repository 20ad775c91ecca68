// The mesh under the haptic scalpel: cut where the scalpel goes, opened as the field says, and felt as it is
// then. It runs at the rate of graphics on a thread of its own; the haptic thread never waits for it.
// Paper, 3.4 to 3.6.
//
// Along a path the scalpel says how far the cut has come. Without one it cuts where it is: from the skin
// giving way until the blade is out again is a cut, and so on.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "explorer/incision/incision.h"
#include "explorer/wound/cut_fields.h"
#include "explorer/wound/live_wounds.h"
#include "haptic/contact_query.h"
#include "haptic/loop.h"

namespace cleft {

/// Of all steps so far; times in seconds.
struct CuttingFigures {
  int steps = 0, cuts = 0;          ///< cuts: steps in which the mesh was cut
  std::size_t triangles_cut = 0;    ///< triangles that cuts changed or added, counted once a step
  TimeHistogram cut, open, update;  ///< the mesh; the field's displacements; the voxel grid after a cut
  std::size_t waiting = 0;          ///< vertices that moved and are told in the next steps
  std::string stopped;              ///< why the last cut could not go on; "" while it can
};

class ScalpelCutting {
 public:
  /// Lengths in mesh units; `scale`: mm per mesh unit. Without a field cuts stay closed.
  struct Setup {
    std::optional<ScalpelPath> path;  ///< where alone the scalpel cuts
    std::vector<ScalpelPath> made;    ///< cuts that are there already
    std::optional<CutFields> fields;
    double scale = 1;
    double depth = 0;  ///< mm, of cuts without a path; 0: as deep as the scalpel is
  };
  /// Throws InputError where a path does not meet the mesh.
  ScalpelCutting(const SurfaceMesh& mesh, Setup setup);

  const ContactSurface& surface() const { return *surface_; }     ///< in mm
  std::size_t incisions() const { return cuts_.size() - made_; }  ///< but those made before
  double cut_length() const;                                      ///< mm, of all cuts but those made before
  const CuttingFigures& figures() const { return figures_; }
  /// Of every cut, those made before too; none without a field.
  std::vector<Validity> validity() const;
  const CutMesh& mesh() const { return mesh_; }
  int original_points() const { return original_points_; }
  /// The newest cut's; null where there is none.
  const Incision* incision() const { return cuts_.empty() ? nullptr : cuts_.back().get(); }
  /// Places of the cuts that the scalpel has made without a path, as they were led.
  const std::vector<std::vector<ScalpelPath::Point>>& led() const { return led_; }
  bool cutting() const { return cutting_; }  ///< whether the last of them may go on
  /// Of a vertex, mesh units, as it is felt.
  Vec3 position(int vertex) const { return 1 / setup_.scale * surface_->position(vertex); }

  /// Cuts to where the scalpel is, if it cuts, and opens the wounds.
  void step(const HapticState& scalpel);
  /// The same for all that the loop has done since the last time: the way between is known.
  void step(TickQueue<HapticState>& ticks);
  /// A place of a blade that nobody feels, of the skin at rest, mesh units: cuts there from the one before.
  void cut_at(const ScalpelPath::Point& place);
  void end_cut();

 private:
  /// Most vertices that are told to move in one step: the others wait, so that no step takes long.
  static constexpr std::size_t most_moved = 4000;

  void add_cut(const ScalpelPath& path, const IncisionOptions& options, std::size_t entering);
  double reached(const HapticState& scalpel) const;
  std::optional<ScalpelPath::Point> contact(const HapticState& scalpel);
  void follow_path(const HapticState& scalpel, double least);
  void follow_scalpel(const HapticState& scalpel);
  void cut_on_to(const ScalpelPath::Point& at);
  void begin_cut(const ScalpelPath::Point& first, const ScalpelPath::Point& next);
  void lead_on(ScalpelPath::Point next);
  bool leads_on(const ScalpelPath::Point& next) const;
  template <class Change>
  void cut(const Change& change);
  void take_in_changes();
  void open();
  void tell_touched();
  void tell(const std::vector<int>& vertices);

  Setup setup_;
  CutMesh mesh_;
  int original_points_;
  std::vector<std::unique_ptr<Incision>> cuts_;
  LiveWounds wounds_;     // of all cuts; none without a field
  std::size_t made_ = 0;  // cuts that were there before
  std::unique_ptr<ContactSurface> surface_;
  std::optional<ContactReader> reader_;
  bool cutting_ = false;
  std::optional<ScalpelPath::Point> entered_;  // where the skin gave way
  std::vector<std::vector<ScalpelPath::Point>> led_;
  std::vector<Vec3> displacements_;  // mm, of vertices, as told to the surface
  std::deque<int> untold_;           // vertices that have moved since
  std::vector<bool> is_untold_;
  std::vector<ContactSurface::Moved> moved_;
  std::vector<ContactSurface::Changed> changed_;
  std::vector<int> vertices_;
  CuttingFigures figures_;
};

}  // namespace cleft
