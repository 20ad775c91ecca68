// The state of the explorer as plain values that a file can hold. Lengths in mm.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "explorer/incision/scalpel_path.h"
#include "explorer/scene/coloring.h"
#include "explorer/wound/detail.h"
#include "explorer/wound/prestress_fields.h"

namespace cleft {

/// The camera. At the angles 0, 0 it looks at the middle of the cut along its mean normal, and at zoom 1
/// everything is in the picture. After dragging with the mouse it has a pose.
struct CameraState {
  double azimuth = 0, elevation = 0;  ///< degrees, towards the picture's right and up
  double zoom = 1;
  struct Pose {
    Vec3 position, focal_point, up;
    double view_angle = 24;  ///< degrees
    friend bool operator==(const Pose&, const Pose&) = default;
  };
  std::optional<Pose> pose;
  /// What the angles count from: the place looked at, its normal, and the direction along the cut.
  struct Frame {
    Vec3 middle, outward, along;
    friend bool operator==(const Frame&, const Frame&) = default;
  };
  /// In a mesh that of the cut at which the angles were said, so that further cuts do not turn the picture;
  /// none: of the first cut.
  std::optional<Frame> frame;
  friend bool operator==(const CameraState&, const CameraState&) = default;
};

struct CutState {
  std::vector<ScalpelPath::Point> points;  ///< depth 0: as deep as the shown case
};

/// A point of the patch whose motion is plotted; on the cut, on one side of it.
struct ProbeState {
  Vec3 uvw;
  Side side = Side::both;
};

/// The place around which the simulation's nodes are drawn: those within `radius` mm.
struct ZoomState {
  Vec3 place;
  double radius = 5;
};

/// A change of the tension, with the number of cuts at that time.
struct TensionChange {
  std::size_t cuts;
  std::optional<SkinTension> tension;  ///< before it; of one that is undone, after it
};

/// A change of a cut that was made already, with the numbers of cuts and of changes of the tension then.
struct CutChange {
  std::size_t cuts, tensions, index;
  CutState cut;  ///< before it; of one that is undone, after it
};

/// What lies where `ahead` points from `place` is not drawn.
struct ClipState {
  Vec3 place, ahead;
  friend bool operator==(const ClipState&, const ClipState&) = default;
};

struct SessionState {
  std::string study;  ///< study folder, study.dffd or case.dffd; empty: nothing is open
  int shown = 0;      ///< case, from 0
  std::map<std::string, double> parameters;  ///< values of `set`
  bool between =
      true;  ///< whether a field for these parameters is interpolated; else the nearest case is shown

  std::string mesh;  ///< file of the surface mesh to cut; empty: the canonical patch
  double scale = 1;  ///< mm in a unit of the mesh
  std::string bone;  ///< file of the surface of the bone below it, in the same unit; empty: none is known
  std::vector<CutState> cuts, undone;
  std::optional<SkinTension> tension;  ///< of the mesh; none: that of the shown case, along every cut
  std::vector<TensionChange> tensions, tensions_undone;  ///< oldest first; last undone last
  std::vector<CutChange> edits, edits_undone;            ///< likewise
  int handled = -1;  ///< the cut whose handles are shown, from 0; -1: none

  bool simulate = false;  ///< whether the cuts in the mesh are simulated as they are; else replayed

  double time = 0;  ///< length cut
  bool playing = false, loop = false;
  double speed = 10;  ///< mm of cut a second

  Coloring coloring = Coloring::displacement;
  std::optional<std::pair<double, double>> range;  ///< of colours; none: from 0 to the largest of all times
  std::optional<std::pair<double, double>> percentiles;  ///< whose values are the ends; none: as above
  std::string map;                ///< of colours (color_maps.h); empty: the usual one for what is shown
  double warp = 1;                ///< by which displacements are multiplied where they are drawn
  bool edges = false;             ///< whether the edges of triangles are drawn
  bool lifelike = false;          ///< whether skin and wounds are shaded as they look, else plainly
  std::optional<ClipState> clip;  ///< none: everything is drawn
  int reference = -1;             ///< the case that `difference` is relative to
  /// Cases outside these ranges of parameters and figures are faded.
  std::map<std::string, std::pair<double, double>> brushes;
  std::string where;          ///< cases in which this condition holds nowhere are faded too; empty: none
  std::string analyzed;       ///< figure whose analysis is shown; empty: none
  bool filtered = false;      ///< whether lists leave out the cases that are faded
  bool wall = false;          ///< whether the pictures of all cases are shown
  std::string sorted_by;      ///< parameter or figure by which lists are sorted; empty: as cases are numbered
  bool descending = false;    ///< whether they begin with the largest
  std::vector<int> selected;  ///< cases that are marked in lists and plots, ascending; empty: none
  std::vector<int> compared;  ///< two to four cases side by side; empty: one view
  CameraState camera;
  std::optional<ProbeState> probe;
  std::optional<ZoomState> zoom;
  std::vector<Vec3> ruler;  ///< places of the skin between which is measured, at rest; empty: none
  std::string figure;       ///< of how the method works, over the scene; empty: none
  bool dark = false;
  std::optional<Detail> detail;  ///< of the wounds in a mesh; none: everything is evaluated
};

/// The line that makes a cut, as `cut` or `recut`: places to a micrometre, short enough to be read.
std::string cut_line(const std::string& command, const CutState& cut);

/// As JSON, and back. Throws InputError naming what is missing or wrong.
std::string state_to_json(const SessionState& state);
SessionState state_from_json(const std::string& json);

}  // namespace cleft
