// Everything that depends on what a session has open, as one value. A line of a user changes it; a line that
// is refused is undone by putting the previous value back, and another study is opened by putting a new value
// in its place. Copies cost little: every large part is shared, and either never changes or only collects
// results.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "explorer/body/body_run.h"
#include "explorer/body/simulated_wounds.h"
#include "explorer/body/surface_index.h"
#include "explorer/incision/cut_surface.h"
#include "explorer/incision/surface_mesh.h"
#include "explorer/scene/skin_ruler.h"
#include "explorer/scene/wound_scene.h"
#include "explorer/session/cut_edit.h"
#include "explorer/session/known_cases.h"
#include "explorer/session/session_state.h"
#include "explorer/study/between_cases.h"
#include "explorer/study/field_on_mesh.h"

namespace cleft {

/// The interpolated field that is shown if no case has exactly the requested parameters.
struct Between {
  std::shared_ptr<BetweenCases> reader;  ///< null until something between the cases is first requested
  std::shared_ptr<const Field> field;    ///< interpolated; null: a case itself is shown
  std::string why_nearest;               ///< why nothing is interpolated; empty if no reason is needed
  bool preparing = false;                ///< the nearest case is shown until the reader is ready
};

/// Data computed for drawing the rest of Opened; they can be computed again at any time.
struct Drawn {
  std::map<double, std::shared_ptr<const CutSurface>> cut_surfaces;  ///< by depth of cuts that state none, mm
  std::map<int, std::shared_ptr<const WoundScene>> scenes;           ///< of the cases in the views
  std::map<int, std::shared_ptr<const FieldOnMesh>> own_meshes;      ///< of cases; null: not there
  std::shared_ptr<const SkinRuler> ruler;                            ///< of the scene that was last measured
};

/// The vertices that a picture leaves out of the shown case's wounds.
struct DetailSeen {
  LeftOut left_out;
  double pixels = 0;  ///< bound of the error; infinite if the camera is among moving vertices
};

/// The simulation of the shown case's cuts in the mesh, where the session asks for it.
struct Simulated {
  std::string of;                                 ///< of which cuts and parameters; empty: of none
  std::shared_ptr<BodyRun> run;                   ///< while it runs
  std::shared_ptr<BodyRun> ended;                 ///< once it has ended well
  std::shared_ptr<const SimulatedWounds> wounds;  ///< likewise, in the mesh that is shown
  std::string note;                               ///< what a view says of it
};

struct Opened {
  SessionState state;
  std::shared_ptr<KnownCases> cases;         ///< null: no study is open
  std::shared_ptr<const SurfaceMesh> mesh;   ///< to be cut, mm; null: the canonical patch is shown
  std::shared_ptr<const Skin> skin;          ///< of the mesh; null until handles are asked for
  std::shared_ptr<const SurfaceIndex> bone;  ///< below its skin, mm; null: none is known
  Between between;
  Simulated simulated;
  Drawn drawn;
  std::vector<Validity> validity;  ///< of each cut of the shown case in a mesh, where fields open it
  std::optional<DetailSeen> seen;  ///< in the last picture; none if anything has changed since
};

}  // namespace cleft
