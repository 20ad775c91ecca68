// The picture of the session in the window: turned with the mouse, or cut by pressing and dragging over the
// skin.
#pragma once

#include <QVTKOpenGLNativeWidget.h>

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QTimer>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "explorer/app/handle_drag.h"
#include "explorer/app/panel.h"
#include "explorer/scene/live_scene.h"
#include "explorer/view/stage.h"

namespace cleft {

/// The command of clicks with the ruler.
inline constexpr const char* measuring_picks = "measure add";

class SceneWidget : public QVTKOpenGLNativeWidget, public Panel {
  Q_DECLARE_TR_FUNCTIONS(SceneWidget)

 public:
  SceneWidget(Session& session, Say say);
  ~SceneWidget() override;
  void follow(const Changes& changes) override;

  /// Whether pressing and dragging cuts rather than turns the picture.
  void set_cutting(bool on);
  bool cutting() const { return cutting_; }
  /// Whether pressing and dragging paints a line of the skin's tension.
  void set_painting(bool on);
  /// The command of a click on the skin, with the place: "probe" or "zoom", of the patch, or
  /// measuring_picks; empty: none.
  void set_picking(const std::string& command);
  const std::string& picking() const { return picking_; }
  /// Called with the mm that the blade has moved over the skin where a drag is too short for a cut.
  std::function<void(double)> too_short;
  std::function<void()> missed;  ///< called where such a click is not on the skin
  /// In a motion (turning, scrubbing, sliders, a cut) pictures that take longer than half of this time are
  /// drawn without smoothed edges, and at half the resolution if that is not sufficient; labels keep theirs.
  /// At rest the picture has full quality again.
  void set_slowest(double seconds) { slowest_ = seconds; }
  bool coarse() const { return coarse_; }
  /// Draws the picture in full quality now, if the last one was not.
  void rest();
  /// Depth of the next cuts, mm; 0: that of the shown case.
  void set_depth(double depth) { depth_ = depth; }
  /// Degrees that the blade leans to its left.
  void set_tilt(double tilt) { tilt_ = tilt; }
  /// Time of the last picture, points and drawing.
  double frame_seconds() const { return frame_seconds_; }
  /// From now on cuts do not turn the picture: angles are relative to the first cut.
  void keep_camera() {
    if (!session_.state().camera.pose) say_camera();
  }
  std::function<void()> drawn;  ///< called after every picture
  /// If set, it is called with the place of the skin under the mouse, and whether the button is pressed.
  std::function<void(const std::optional<WoundView::Place>& place, bool pressed)> pointed;

  /// Draws a scene instead of that of the shown case, with a scalpel if one is given; null: the case again.
  void show_live(std::shared_ptr<const WoundScene> scene, const HapticState* scalpel);

  Stage& stage() { return *stage_; }

 protected:
  bool event(QEvent* event) override;

 private:
  bool pick(int x, int y);
  bool handle(QEvent* event);
  void turn(vtkObject*, unsigned long what, void*);
  void hurry(double last_seconds);
  void set_coarse(bool coarse);
  std::pair<int, int> pixel(const QMouseEvent& mouse) const;
  bool press(int x, int y);
  void drag(int x, int y);
  void release();
  bool add_point(int x, int y);
  bool points(QEvent* event);
  CutState smoothed() const;
  ScalpelCutting& live_cutting();
  void show_live(ScalpelCutting& cutting);
  void draw();
  void say_camera();

  Session& session_;
  Say say_;
  std::unique_ptr<Stage> stage_;
  HandleDrag handles_;
  bool cutting_ = false, painting_ = false, pressed_ = false, own_ = false;
  double depth_ = 0, tilt_ = 0, frame_seconds_ = 0;
  std::pair<int, int> pressed_at_, dragged_to_;  // pixels, of a drag of the scalpel
  std::optional<CameraState::Pose> begun_at_;    // the camera when a motion of the mouse began
  std::string picking_;
  double slowest_ = 0.066;
  bool coarse_ = false, smooth_ = true;
  QElapsedTimer since_picture_;
  QTimer resting_;
  int last_x_ = 0, last_y_ = 0;
  int view_ = -1;                        // that the blade is in
  std::vector<WoundView::Place> blade_;  // where it has been since the button was pressed
  QElapsedTimer since_drawn_;
  // The cut while it is drawn; what comes of it is a cut of the session.
  std::unique_ptr<ScalpelCutting> live_;
  std::shared_ptr<const CuttingMoment> moment_;
  std::shared_ptr<LiveScene> live_scene_;
};

}  // namespace cleft
