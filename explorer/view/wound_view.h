// Draws a wound scene with VTK: skin, the walls of the wound by depth, lights, camera.
#pragma once

#include <vtkNew.h>
#include <vtkProp.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <memory>
#include <optional>
#include <vector>

#include "explorer/view/surface_part.h"
#include "explorer/view/wound_scene.h"

namespace cleft {

/// Where the camera stands: at 0, 0 it looks at the middle of the cut along its mean normal.
struct ViewAngles {
  double azimuth = 0, elevation = 0;  ///< degrees, towards the picture's right and up
  double zoom = 1;                    ///< at 1 the whole scene is in the picture
};

class WoundView {
 public:
  WoundView();
  ~WoundView();

  /// Replaces the scene and draws its end; the camera stays unless this is the first one.
  void show(std::shared_ptr<const WoundScene> scene);

  /// Moves the points to the length cut t, mm (clamped). Nothing else is rewritten.
  void set_time(double t);
  double time() const { return time_; }
  double duration() const { return scene_->duration(); }

  void aim(const ViewAngles& angles);

  const std::vector<Vec3>& points() const { return points_; }  ///< as drawn
  vtkRenderer* renderer() const { return renderer_; }

 private:
  void add_lights();
  void add_actors();
  void add_prop(vtkProp* prop);

  vtkNew<vtkRenderer> renderer_;
  std::vector<vtkSmartPointer<vtkProp>> props_;  // what the scene put into the renderer
  std::shared_ptr<const WoundScene> scene_;
  std::optional<SurfacePart> skin_, walls_;
  std::vector<Vec3> points_;
  double time_ = 0;
};

}  // namespace cleft
