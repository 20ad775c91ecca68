// Draws a wound scene with VTK: skin, the walls of the wound by depth, lights, camera.
#pragma once

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkProp.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkSmartPointer.h>

#include <memory>
#include <optional>
#include <tuple>
#include <vector>

#include "explorer/scene/wound_scene.h"
#include "explorer/session/session_state.h"
#include "explorer/view/coarse_pass.h"
#include "explorer/view/open_sky.h"
#include "explorer/view/section_line.h"
#include "explorer/view/surface_part.h"
#include "haptic/pose.h"

namespace cleft {

class WoundView {
 public:
  WoundView();
  ~WoundView();

  /// Replaces the scene and draws it at t, by default its end; the camera is reset only for the first scene.
  void show(std::shared_ptr<const WoundScene> scene, std::optional<double> t = {});

  /// Moves the points to the length cut t, mm (clamped). Nothing else is rewritten.
  void set_time(double t);
  double time() const { return time_; }
  double duration() const { return scene_->duration(); }

  /// Sets the colouring; `reference` is the field that `difference` is relative to. Without a range: from 0
  /// to the largest value of all times. `map`: its name; empty: the usual one.
  void color_by(const Coloring& coloring, std::shared_ptr<const Field> reference = nullptr,
                std::optional<std::pair<double, double>> range = std::nullopt, const std::string& map = "");

  /// Opacity of the skin, 0 to 1, so that an overlay is visible through it.
  void set_opacity(double opacity);

  /// Whether its colours are those of a guess; the legend's too.
  void set_faded(bool faded);

  /// Displacements are drawn so many times as large as they are.
  void set_warp(double factor);
  void set_edges(bool visible);
  /// Whether skin and wound look as they do in light (lifelike.h), of skin only where it has its own colours
  /// and no edges: colours of values, and lines, are read more easily in plain light.
  void set_lifelike(bool on);
  /// The shade of a scalpel in that light, before every picture; null: there is none.
  void shade_under(const ScalpelPose* scalpel);
  void set_clip(const std::optional<ClipState>& clip);

  void aim(const CameraState& camera);
  void set_dark(bool dark);
  /// Whether edges are smoothed, which takes a fifth of a picture's time in software.
  void set_smooth(bool smooth) { renderer_->SetUseFXAA(smooth); }
  /// Whether the scene is drawn at half the resolution; labels never are.
  void set_coarse(bool coarse);
  /// Whether the legend is shown: in one of several views with the same colours.
  void set_legend(bool visible) { has_legend_ = visible; }
  /// The ends of the colours where no range is given: from 0 to the largest value of all times, for strain
  /// the 99th percentile; of a quantity from the least value to the greatest; of what has a sign as far to
  /// either side of 0. With percentiles: those of the values of all points that move, at all times.
  std::pair<double, double> range_of(
      const Coloring& coloring, const Field* reference,
      const std::optional<std::pair<double, double>>& percentiles = std::nullopt);

  /// A place of the skin at rest.
  struct Place {
    Vec3 position, outward;
  };
  /// The place under a pixel of the window, counted from the lower left; none outside the skin.
  std::optional<Place> skin_at(int x, int y);

  const std::vector<Vec3>& points() const { return points_; }  ///< as drawn
  vtkRenderer* renderer() const { return renderer_; }

 private:
  void add_lights();
  void add_actors();
  bool paint_skin();
  void set_background();
  void show_opacity();
  void show_edges();
  void show_section();
  void show_light();
  std::vector<double> values_over_time(const Coloring& coloring, const Field* reference);
  double distance_to_see_all(const Vec3& middle, double view_angle) const;
  void add_prop(vtkProp* prop);

  vtkNew<vtkRenderer> renderer_;
  vtkNew<CoarsePass> coarse_;
  std::vector<vtkSmartPointer<vtkProp>> props_;                      // what the scene put into the renderer
  vtkSmartPointer<vtkActor> skin_actor_, still_actor_, wall_actor_;  // still: the skin that never moves
  std::shared_ptr<const WoundScene> scene_;
  std::optional<SurfacePart> skin_, walls_;
  std::vector<Vec3> points_;
  Coloring coloring_ = Coloring::tissue;
  std::shared_ptr<const Field> reference_;
  std::optional<std::pair<double, double>> range_;
  /// As last asked for.
  struct KnownRange {
    Coloring coloring;
    const Field* reference;
    std::optional<std::pair<double, double>> percentiles;
    std::pair<double, double> range;
  };
  std::optional<KnownRange> known_range_;
  vtkSmartPointer<vtkScalarBarActor> legend_;
  bool dark_ = false, is_faded_ = false, has_legend_ = true;
  std::string map_;
  double opacity_ = 1, warp_ = 1;
  bool edges_ = false, lifelike_ = false, lit_ = false;  // lit_: light_ is of the scene
  std::unique_ptr<SurfaceLight> light_;                  // as last needed
  std::vector<SurfaceLight::Light> lights_;
  std::optional<ClipState> clip_;
  std::optional<SectionLine> section_;
  std::vector<double> values_;
  double time_ = 0;
};

}  // namespace cleft
