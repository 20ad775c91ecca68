// Draws the state of a session into a render window: one view, or up to four cases side by side.
#pragma once

#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include <memory>
#include <vector>

#include "explorer/session/session.h"
#include "explorer/view/furniture.h"
#include "explorer/view/overlay_view.h"
#include "explorer/view/pixel_bound.h"
#include "explorer/view/scalpel_view.h"
#include "explorer/view/wound_view.h"
#include "haptic/loop.h"

namespace cleft {

class Stage {
 public:
  /// A pixel of the picture is `samples` pixels of the window wide.
  explicit Stage(vtkRenderWindow* window, double samples = 1);
  ~Stage();

  /// Updates everything to the session's state; what has not changed is not rebuilt.
  void show(Session& session);

  /// Draws a scene instead of that of the shown case, with a scalpel if one is given; null: the case again.
  void set_live(std::shared_ptr<const WoundScene> scene, const HapticState* scalpel);

  /// Whether what is in space is drawn at half the resolution; off but in motions with slow pictures.
  void set_coarse(bool coarse);
  /// Whether edges are smoothed; off during motions with slow pictures.
  void set_smooth(bool smooth);

  int views() const { return static_cast<int>(views_.size()); }
  WoundView& view(int i) { return *views_.at(i).view; }
  int view_at(int x, int y) const;  ///< pixels from the lower left; -1: none
  /// Size of a pixel in a view, mm, in the plane through the middle of its scene.
  double mm_a_pixel(int view) const;
  /// The camera of all views.
  CameraState::Pose camera() const;

 private:
  struct View {
    std::unique_ptr<WoundView> view;
    std::unique_ptr<Furniture> furniture;
    std::unique_ptr<OverlayView> overlay = nullptr;
    std::shared_ptr<const WoundScene> whole = nullptr;
    std::pair<Vec3, Vec3> box = {};  // of what moves in it
    double detail = 0;               // mm, that it is drawn with
  };
  /// What the views were last made for.
  struct Shown {
    Coloring coloring = Coloring::tissue;
    const Field* reference = nullptr;
    std::pair<double, double> range{0, 0};
    std::string map;
    CameraState camera;
    Vec3 middle;
    bool dark = false;
  };
  std::shared_ptr<const WoundScene> scene_of(Session& session, int shown) const;
  bool take_scenes(Session& session);
  void follow_camera();
  PixelBound pixel_bound(const View& view) const;
  double detail_of(const View& view) const;
  void tell_detail(Session& session) const;
  void make_views(std::size_t count);
  void color(Session& session, bool fresh);
  void aim(const CameraState& camera, bool fresh);
  void lay_over(Session& session);
  void label(Session& session);
  void draw_scalpel(const WoundView& view);

  vtkSmartPointer<vtkRenderWindow> window_;
  std::vector<View> views_;
  std::vector<std::shared_ptr<const WoundScene>> scenes_;
  std::shared_ptr<const WoundScene> live_;
  std::optional<HapticState> scalpel_;
  std::unique_ptr<ScalpelView> scalpel_view_;
  const SurfaceMesh* mesh_ = nullptr;  // that the camera was aimed at; null: a patch
  std::string caption_;                // of what lies over the scene
  Shown shown_;
  std::optional<Detail> detail_;
  double warp_ = 1;
  unsigned long camera_observer_;
  bool smooth_ = true, coarse_ = false;
  double samples_;
};

}  // namespace cleft
