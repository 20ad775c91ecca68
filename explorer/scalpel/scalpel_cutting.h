// The mesh under the haptic scalpel: cut along the scalpel's motion, opened by the field, and passed to the
// haptic surface. It runs at the rate of graphics on a thread of its own; the haptic thread never waits for
// it. Paper, 3.4 to 3.6. With a path the scalpel determines the progress of the cut. Without one it cuts
// where it is: a cut lasts from the puncture until the blade leaves the skin.
#pragma once

#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "explorer/incision/incision.h"
#include "explorer/incision/places_before.h"
#include "explorer/scalpel/carried_vectors.h"
#include "explorer/scalpel/guard_finder.h"
#include "explorer/wound/cut_fields.h"
#include "explorer/wound/live_wounds.h"
#include "haptic/contact_query.h"
#include "haptic/loop.h"

namespace cleft {

/// Figures of all steps so far; times in seconds.
struct CuttingFigures {
  int steps = 0, cuts = 0;          ///< cuts: steps in which the mesh was cut
  std::size_t triangles_cut = 0;    ///< triangles that cuts changed or added, counted once for each step
  TimeHistogram cut, open, update;  ///< the mesh; the field's displacements; the voxel grid after a cut
  std::size_t waiting = 0;          ///< vertices that moved and are passed on in the next steps
  int guards = 0;                   ///< those that were found beside the steps, and taken over
  std::string stopped;              ///< why the last cut could not continue; "" while it can
};

class ScalpelCutting {
 public:
  /// Lengths in mesh units; `scale`: mm per mesh unit. Without a field cuts stay closed.
  struct Setup {
    std::optional<ScalpelPath> path;  ///< the only path that the scalpel cuts
    std::vector<ScalpelPath> made;    ///< existing cuts
    std::optional<CutFields> fields;
    double scale = 1;
    double depth = 0;  ///< mm, of cuts without a path; 0: as deep as the scalpel
    /// The guard of a cut that has ended is found on a thread of its own, and taken over between two steps:
    /// by the next one, which waits for it, so that a virtual clock gives the same on every machine; or by
    /// the first one after it is found.
    bool wait_for_guard = true;
    /// Of a place of the skin at rest, mm: its stiffness over that of the force's parameters; null: 1.
    std::function<double(const Vec3& place)> firmness = {};
    /// The displacements of all vertices, mm, with the existing cuts, complete, as a simulation has them, in
    /// place of the fields'; later cuts open in addition. Null: the fields' own.
    std::function<std::vector<Vec3>(const std::vector<const Incision*>& made)> opened = {};
  };
  /// Throws InputError if a path does not meet the mesh.
  ScalpelCutting(const SurfaceMesh& mesh, Setup setup);

  const ContactSurface& surface() const { return *surface_; }     ///< in mm
  std::size_t incisions() const { return cuts_.size() - made_; }  ///< without the existing ones
  double cut_length() const;  ///< mm, of all cuts without the existing ones
  const CuttingFigures& figures() const { return figures_; }
  /// The wounds of all cuts, including existing ones; none without a field.
  std::vector<Validity> validity() const;
  const CutMesh& mesh() const { return mesh_; }
  int original_points() const { return original_points_; }
  /// The mesh's own, carried to each vertex as it is now; empty where it has none.
  std::vector<PointColor> colors();
  /// That of the newest cut; null if there is none.
  const Incision* incision() const { return cuts_.empty() ? nullptr : cuts_.back().get(); }
  /// Places of the cuts that the scalpel has made without a path.
  const std::vector<std::vector<ScalpelPath::Point>>& free_cuts() const { return free_cuts_; }
  bool cutting() const { return cutting_; }  ///< whether the last of them may continue
  /// The position of a vertex in the haptic surface, mesh units.
  Vec3 position(int vertex) const { return 1 / setup_.scale * surface_->position(vertex); }

  /// Cuts to the position of the scalpel, if it cuts, and opens the wounds.
  void step(const HapticState& scalpel);
  /// The same for all ticks of the loop since the last call, so that the complete motion is cut.
  void step(TickQueue<HapticState>& ticks);
  /// Cuts to a place of a blade without force feedback, on the skin at rest, mesh units, from the previous
  /// one.
  void cut_at(const ScalpelPath::Point& place);
  /// The blade leaves the cut: its path is known now, and with the next step it opens as it would have if it
  /// had been known before. One that ends next to a wound is led into it.
  void end_cut();
  /// Takes the guard over that is being found, and passes all motion on.
  void settle();

 private:
  /// Largest number of vertices whose motion is passed on in one step: the others wait, so that no step takes
  /// long.
  static constexpr std::size_t most_moved = 4000;

  void add_cut(const ScalpelPath& path, const IncisionOptions& options, std::size_t entering);
  void take_simulation();
  Vec3 displacement(int vertex) const { return wounds_.displacement(vertex) + beyond_fields_.at(vertex); }
  float firmness_at(int vertex) const;
  double reached(const HapticState& scalpel) const;
  std::optional<ScalpelPath::Point> contact(const HapticState& scalpel);
  void follow_path(const HapticState& scalpel, double least);
  void follow_scalpel(const HapticState& scalpel);
  void cut_on_to(const ScalpelPath::Point& at);
  void begin_cut(ScalpelPath::Point first, const ScalpelPath::Point& next);
  void extend(ScalpelPath::Point next);
  void end_path();
  void open_anew(bool wait);
  std::optional<double> way_into_wound(const ScalpelPath& path, bool start, std::size_t earlier) const;
  bool leads_on(const ScalpelPath::Point& next) const;
  template <class Change>
  void cut(const Change& change);
  void collect_changes();
  void open();
  void take_guard(bool wait);
  bool is_under_way() const;
  void tell_touched();
  void tell(const std::vector<int>& vertices);

  Setup setup_;
  CutMesh mesh_;
  int original_points_;
  std::vector<PointColor> own_colors_;  // of the mesh before
  std::optional<PlacesBefore> places_;  // none without colours
  std::vector<std::unique_ptr<Incision>> cuts_;
  LiveWounds wounds_;             // of all cuts; none without a field
  std::size_t made_ = 0;          // existing cuts
  CarriedVectors beyond_fields_;  // mm: by what their simulation differs from the fields
  std::unique_ptr<ContactSurface> surface_;
  std::optional<ContactReader> reader_;
  bool cutting_ = false;
  bool opens_anew_ = false;                    // the newest cut, since its path has ended
  std::optional<ScalpelPath::Point> entered_;  // the place of the puncture
  std::vector<std::vector<ScalpelPath::Point>> free_cuts_;
  std::vector<Vec3> displacements_;  // mm, of vertices, as in the haptic surface
  std::deque<int> pending_;          // vertices that have moved since and are not passed on yet
  std::vector<int> moved_before_;    // by wounds that opened anew: passed on when all have entered these
  std::vector<bool> is_pending_;
  std::vector<ContactSurface::Moved> moved_;
  std::vector<ContactSurface::Changed> changed_;
  std::vector<int> vertices_;
  CuttingFigures figures_;
  // Read the wounds, the cuts and the mesh: end first.
  std::future<Wound> known_;  // of the newest cut, which opens anew
  GuardFinder finder_;
};

}  // namespace cleft
