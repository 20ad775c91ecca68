// The picture of the session in the window: turned with the mouse, or cut by pressing and dragging over the
// skin.
#pragma once

#include <QVTKOpenGLNativeWidget.h>
#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <QElapsedTimer>
#include <memory>
#include <vector>

#include "explorer/app/panel.h"
#include "explorer/view/stage.h"

namespace cleft {

class SceneWidget : public QVTKOpenGLNativeWidget, public Panel {
 public:
  SceneWidget(Session& session, Say say);
  ~SceneWidget() override;
  void follow(const Changes& changes) override;

  /// Whether pressing and dragging cuts rather than turns the picture.
  void set_cutting(bool on);
  bool cutting() const { return cutting_; }
  /// mm; 0: as deep as the shown case. Of the cuts to come.
  void set_depth(double depth) { depth_ = depth; }
  /// Degrees that the blade leans to its left.
  void set_tilt(double tilt) { tilt_ = tilt; }
  /// Of the last picture, points and drawing.
  double frame_seconds() const { return frame_seconds_; }
  std::function<void()> drawn;  ///< called after every picture

  Stage& stage() { return *stage_; }

 protected:
  bool event(QEvent* event) override;

 private:
  bool press(int x, int y);
  void drag(int x, int y);
  void release();
  bool add_point(int x, int y);
  std::string cut_line(const char* command) const;
  void draw();

  Session& session_;
  Say say_;
  std::unique_ptr<Stage> stage_;
  bool cutting_ = false, pressed_ = false, begun_ = false;
  double depth_ = 0, tilt_ = 0, frame_seconds_ = 0;
  int view_ = -1;                        // that the blade is in
  std::vector<WoundView::Place> blade_;  // where it has been since the button was pressed
  std::unique_ptr<WoundView::Place> last_;
  QElapsedTimer since_cut_;
};

}  // namespace cleft
