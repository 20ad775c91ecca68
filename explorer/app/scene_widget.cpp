#include "explorer/app/scene_widget.h"

#include <vtkCallbackCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkRenderWindowInteractor.h>

#include <QMouseEvent>
#include <cmath>

#include "base/stopwatch.h"
#include "base/text.h"

namespace cleft {

namespace {

constexpr double spacing = 1;           // mm between the places of a cut
constexpr int milliseconds_a_cut = 60;  // while dragging, at most so often

std::string text(const Vec3& x) { return shortest(x.x) + "," + shortest(x.y) + "," + shortest(x.z); }
/// Short enough to be read in a recording: micrometres.
Vec3 rounded(const Vec3& x, double step) {
  return {std::round(x.x / step) * step, std::round(x.y / step) * step, std::round(x.z / step) * step};
}

/// What a mouse has done to the camera becomes a line.
void say_camera(vtkObject*, unsigned long, void* data, void*) {
  (*static_cast<std::function<void()>*>(data))();
}

}  // namespace

SceneWidget::SceneWidget(Session& session, Say say) : session_(session), say_(std::move(say)) {
  setObjectName("scene");
  vtkNew<vtkGenericOpenGLRenderWindow> window;
  window->SetMultiSamples(0);
  setRenderWindow(window);
  stage_ = std::make_unique<Stage>(window);
  setFocusPolicy(Qt::StrongFocus);
  setToolTip("Left: turn, middle or Shift+left: move, wheel or right: zoom");

  vtkNew<vtkInteractorStyleTrackballCamera> style;
  static_cast<vtkRenderWindowInteractor*>(interactor())->SetInteractorStyle(style);
  auto* turned = new std::function<void()>([this] {
    if (stage_->views() == 0) return;
    const CameraState::Pose now = stage_->camera();
    if (session_.state().camera.pose && session_.state().camera.pose->position == now.position) return;
    say_("look " + text(now.position) + " " + text(now.focal_point) + " " + text(now.up) + " " +
         shortest(now.view_angle));
  });
  for (const unsigned long what : {vtkCommand::EndInteractionEvent, vtkCommand::MouseWheelForwardEvent,
                                   vtkCommand::MouseWheelBackwardEvent}) {
    vtkNew<vtkCallbackCommand> after;
    after->SetCallback(say_camera);
    after->SetClientData(turned);
    if (what == vtkCommand::EndInteractionEvent) {
      after->SetClientDataDeleteCallback([](void* f) { delete static_cast<std::function<void()>*>(f); });
      style->AddObserver(what, after);
    } else {
      style->AddObserver(what, after, -1);  // after the style itself
    }
  }
}

SceneWidget::~SceneWidget() { stage_.reset(); }

void SceneWidget::set_cutting(bool on) {
  cutting_ = on;
  setCursor(on ? Qt::CrossCursor : Qt::ArrowCursor);
}

void SceneWidget::follow(const Changes&) { draw(); }

void SceneWidget::draw() {
  Stopwatch watch;
  stage_->show(session_);
  renderWindow()->Render();
  frame_seconds_ = watch.seconds();
  if (drawn) drawn();
}

bool SceneWidget::event(QEvent* event) {
  const auto type = event->type();
  if (cutting_ && session_.mesh() &&
      (type == QEvent::MouseButtonPress || type == QEvent::MouseMove || type == QEvent::MouseButtonRelease)) {
    auto* mouse = static_cast<QMouseEvent*>(event);
    const double ratio = devicePixelRatioF();
    const int x = static_cast<int>(mouse->x() * ratio),
              y = static_cast<int>((height() - 1 - mouse->y()) * ratio);
    if (type == QEvent::MouseButtonPress && mouse->button() == Qt::LeftButton && press(x, y)) return true;
    if (type == QEvent::MouseMove && pressed_) return drag(x, y), true;
    if (type == QEvent::MouseButtonRelease && pressed_) return release(), true;
  }
  return QVTKOpenGLNativeWidget::event(event);
}

bool SceneWidget::press(int x, int y) {
  view_ = stage_->view_at(x, y);
  blade_.clear();
  begun_ = false;
  if (view_ < 0 || !add_point(x, y)) return false;  // beside the skin the picture is turned
  since_cut_.start();
  return pressed_ = true;
}

bool SceneWidget::add_point(int x, int y) {
  const auto place = stage_->view(view_).skin_at(x, y);
  if (!place) return false;
  if (!blade_.empty() && norm(place->position - blade_.back().position) < spacing) return false;
  blade_.push_back(*place);
  return true;
}

void SceneWidget::drag(int x, int y) {
  if (!add_point(x, y) || blade_.size() < 3) return;
  if (begun_ && since_cut_.elapsed() < std::max<qint64>(milliseconds_a_cut, qint64(2000 * frame_seconds_)))
    return;
  since_cut_.restart();
  if (say_(cut_line(begun_ ? "recut" : "cut"))) begun_ = true;
}

void SceneWidget::release() {
  pressed_ = false;
  if (blade_.size() >= 2) say_(cut_line(begun_ ? "recut" : "cut"));
}

/// Normals are those of single triangles under the mouse: the mean of a few makes the blade steady. The blade
/// is in the surface at rest.
std::string SceneWidget::cut_line(const char* command) const {
  constexpr int reach = 3;
  std::string line = command;
  const int count = static_cast<int>(blade_.size());
  const auto at = [&](int i) { return blade_[static_cast<std::size_t>(std::clamp(i, 0, count - 1))]; };
  for (int i = 0; i < count; ++i) {
    Vec3 outward;
    for (int k = -reach; k <= reach; ++k) outward += at(i + k).outward;
    outward = normalized(outward);
    const Vec3 along = at(i + 1).position - at(i - 1).position;
    const Vec3 across = cross(outward, along);
    const double tilt = tilt_ * M_PI / 180;
    if (norm(across) > 0) outward = std::cos(tilt) * outward - std::sin(tilt) * normalized(across);
    line += " " + text(rounded(at(i).position, 1e-3)) + "," + text(rounded(outward, 1e-4));
  }
  return depth_ > 0 ? line + " depth " + shortest(depth_) : line;
}

}  // namespace cleft
