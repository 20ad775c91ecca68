#include "explorer/app/scene_widget.h"

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkRenderWindowInteractor.h>

#include <QMouseEvent>
#include <algorithm>
#include <cmath>

#include "base/stopwatch.h"
#include "base/text.h"

namespace cleft {

namespace {

constexpr double coarsest = 4;  // pixels between the places of a cut, at least
constexpr double steepest = 4;  // of skin that the blade goes along, against the picture's plane
constexpr double spacing = 1;   // mm between the places of a cut
constexpr int rest_ms = 250;    // pictures that follow each other within this are a motion

std::string text(const Vec3& x) { return shortest(x.x) + "," + shortest(x.y) + "," + shortest(x.z); }

}  // namespace

SceneWidget::SceneWidget(Session& session, Say say)
    : session_(session), say_(std::move(say)), handles_(session) {
  setObjectName("scene");
  setAccessibleName(tr("Picture of the wound"));
  vtkNew<vtkGenericOpenGLRenderWindow> window;
  window->SetMultiSamples(0);
  setRenderWindow(window);
  stage_ = std::make_unique<Stage>(window);
  setFocusPolicy(Qt::StrongFocus);
  setToolTip(tr("Left: turn, middle or Shift+left: move, wheel or right: zoom"));

  resting_.setSingleShot(true);
  connect(&resting_, &QTimer::timeout, this, [this] { rest(); });
  vtkNew<vtkInteractorStyleTrackballCamera> style;
  static_cast<vtkRenderWindowInteractor*>(interactor())->SetInteractorStyle(style);
  for (const unsigned long what :
       {vtkCommand::StartInteractionEvent, vtkCommand::InteractionEvent, vtkCommand::EndInteractionEvent,
        vtkCommand::MouseWheelForwardEvent, vtkCommand::MouseWheelBackwardEvent}) {
    const bool wheel =
        what == vtkCommand::MouseWheelForwardEvent || what == vtkCommand::MouseWheelBackwardEvent;
    style->AddObserver(what, this, &SceneWidget::turn, wheel ? -1 : 0);  // after the style itself
  }
}

/// What a mouse has done to the camera becomes a line when it is done.
void SceneWidget::turn(vtkObject*, unsigned long what, void*) {
  if (stage_->views() == 0) return;
  const double last = stage_->view(0).renderer()->GetLastRenderTimeInSeconds() * stage_->views();
  if (what == vtkCommand::StartInteractionEvent) {
    begun_at_ = stage_->camera();
    hurry(std::max(last, frame_seconds_));
  } else if (what == vtkCommand::InteractionEvent) {
    hurry(last);
  } else {
    const CameraState::Pose now = stage_->camera();
    const bool moved = begun_at_ != now;
    begun_at_.reset();
    if (moved) say_camera();  // a click alone moves nothing
    if (what == vtkCommand::EndInteractionEvent) rest();
  }
}

/// The picture of a motion is drawn with less where the last one took long.
void SceneWidget::hurry(double last_seconds) {
  if (smooth_ && last_seconds > slowest_ / 2)
    stage_->set_smooth(smooth_ = false);
  else if (!coarse_ && last_seconds > slowest_)
    set_coarse(true);
}

void SceneWidget::rest() {
  resting_.stop();
  if (smooth_ && !coarse_) return;
  stage_->set_smooth(smooth_ = true);
  set_coarse(false);
  since_picture_.invalidate();
  draw();
}

void SceneWidget::set_coarse(bool coarse) {
  coarse_ = coarse;
  stage_->set_coarse(coarse);
}

void SceneWidget::set_picking(const std::string& command) {
  picking_ = command;
  setCursor(command.empty() ? Qt::ArrowCursor : Qt::PointingHandCursor);
}

bool SceneWidget::pick(int x, int y) {
  const int view = stage_->view_at(x, y);
  const auto place = view < 0 ? std::nullopt : stage_->view(view).skin_at(x, y);
  if (!place) return false;
  const auto rounded = [](double mm) { return shortest(std::round(100 * mm) / 100); };
  say_(picking_ + " " + rounded(place->position.x) + "," + rounded(place->position.y) + "," +
       rounded(session_.mesh() ? place->position.z : std::min(place->position.z, 0.)));
  return true;
}

SceneWidget::~SceneWidget() { stage_.reset(); }

void SceneWidget::say_camera() {
  if (stage_->views() == 0) return;
  const CameraState::Pose now = stage_->camera();
  if (session_.state().camera.pose && session_.state().camera.pose->position == now.position) return;
  say_("look " + text(now.position) + " " + text(now.focal_point) + " " + text(now.up) + " " +
       shortest(now.view_angle));
}

void SceneWidget::set_cutting(bool on) {
  cutting_ = on;
  setCursor(on ? Qt::CrossCursor : Qt::ArrowCursor);
  if (!on)
    live_.reset();
  else if (session_.mesh())
    live_cutting();
}

void SceneWidget::set_painting(bool on) {
  painting_ = on;
  setCursor(on ? Qt::CrossCursor : Qt::ArrowCursor);
}

void SceneWidget::follow(const Changes& changes) {
  if (handles_.pressed() && (changes.cuts || changes.study || changes.closer)) handles_.release();
  if (!own_ && (changes.cuts || changes.study || changes.shown)) live_.reset();
  const bool seen = changes.study || changes.shown || changes.cuts || changes.time || changes.coloring ||
                    changes.camera || changes.layout || changes.look || changes.closer || changes.detail;
  if (seen) draw();
}

void SceneWidget::draw() {
  if (since_picture_.isValid() && since_picture_.elapsed() < rest_ms) hurry(frame_seconds_);
  Stopwatch watch;
  stage_->show(session_);
  renderWindow()->Render();
  frame_seconds_ = watch.seconds();
  since_picture_.start();
  if (!smooth_ || coarse_) resting_.start(rest_ms);
  if (drawn) drawn();
}

bool SceneWidget::event(QEvent* event) {
  const auto type = event->type();
  if (pointed && session_.mesh() && points(event)) return true;
  const bool picks =
      picking_ == measuring_picks ? session_.has_scene() : session_.study() && !session_.mesh();
  if (!picking_.empty() && picks && type == QEvent::MouseButtonPress) {
    auto* mouse = static_cast<QMouseEvent*>(event);
    const auto [x, y] = pixel(*mouse);
    if (mouse->button() == Qt::LeftButton && pick(x, y)) return true;
    if (mouse->button() == Qt::LeftButton && missed) missed();
  }
  if (session_.state().handled >= 0 && session_.mesh() && handle(event)) return true;
  if ((cutting_ || painting_) && session_.mesh() &&
      (type == QEvent::MouseButtonPress || type == QEvent::MouseMove || type == QEvent::MouseButtonRelease)) {
    auto* mouse = static_cast<QMouseEvent*>(event);
    const auto [x, y] = pixel(*mouse);
    if (type == QEvent::MouseButtonPress && mouse->button() == Qt::LeftButton && press(x, y)) return true;
    if (type == QEvent::MouseMove && pressed_) return drag(x, y), true;
    if (type == QEvent::MouseButtonRelease && pressed_) return release(), true;
  }
  return QVTKOpenGLNativeWidget::event(event);
}

/// A handle is dragged, or another cut is clicked to have some.
bool SceneWidget::handle(QEvent* event) {
  const auto type = event->type();
  if (type != QEvent::MouseButtonPress && type != QEvent::MouseMove && type != QEvent::MouseButtonRelease)
    return false;
  auto* mouse = static_cast<QMouseEvent*>(event);
  const auto [x, y] = pixel(*mouse);
  const PicturePlace at{x, y, devicePixelRatioF()};
  if (type == QEvent::MouseButtonPress && mouse->button() == Qt::LeftButton) {
    view_ = stage_->view_at(x, y);
    if (view_ < 0 || session_.views()[static_cast<std::size_t>(view_)] != session_.state().shown)
      return false;
    if (handles_.press(stage_->view(view_), at)) return true;
    const int cut = cutting_ || painting_ ? -1 : handles_.cut_at(stage_->view(view_), at);
    if (cut < 0 || cut == session_.state().handled) return false;
    say_("handles " + std::to_string(cut + 1));
    return true;
  }
  if (!handles_.pressed()) return false;
  if (type == QEvent::MouseMove) {
    handles_.drag(stage_->view(view_), at);
    draw();
  } else if (type == QEvent::MouseButtonRelease) {
    const std::string line = handles_.release();
    if (line.empty())
      draw();
    else
      keep_camera(), say_(line);
  }
  return true;
}

/// Where a mouse is in the picture, from its lower left corner.
std::pair<int, int> SceneWidget::pixel(const QMouseEvent& mouse) const {
  return {static_cast<int>(mouse.x() * devicePixelRatioF()),
          static_cast<int>((height() - 1 - mouse.y()) * devicePixelRatioF())};
}

/// A device that is the mouse: over the skin it is the scalpel's, else it turns the picture.
bool SceneWidget::points(QEvent* event) {
  const auto type = event->type();
  if (type != QEvent::MouseMove && type != QEvent::MouseButtonPress && type != QEvent::MouseButtonRelease)
    return false;
  auto* mouse = static_cast<QMouseEvent*>(event);
  if (type == QEvent::MouseButtonPress && mouse->button() != Qt::LeftButton) return false;
  const auto [x, y] = pixel(*mouse);
  const int view = stage_->view_at(x, y);
  const auto place = view < 0 ? std::nullopt : stage_->view(view).skin_at(x, y);
  if (type == QEvent::MouseButtonPress) pressed_ = place.has_value();
  const bool mine = pressed_ || (mouse->buttons() == Qt::NoButton && type == QEvent::MouseMove);
  if (type == QEvent::MouseButtonRelease) pressed_ = false;
  if (mine) pointed(place, pressed_);
  return mine;
}

bool SceneWidget::press(int x, int y) {
  view_ = stage_->view_at(x, y);
  blade_.clear();
  if (view_ < 0 || !add_point(x, y)) return false;  // outside the skin dragging turns the picture
  keep_camera();
  pressed_at_ = dragged_to_ = {x, y};
  since_drawn_.start();
  return pressed_ = true;
}

bool SceneWidget::add_point(int x, int y) {
  const auto place = stage_->view(view_).skin_at(x, y);
  if (!place) return false;
  if (!blade_.empty()) {
    const double distance = norm(place->position - blade_.back().position);
    // Over the edge of a nose the skin behind it is far away, however little the mouse has moved.
    const double seen = stage_->mm_a_pixel(view_) * std::hypot(x - last_x_, y - last_y_);
    const double least = std::max(spacing, coarsest * stage_->mm_a_pixel(view_));
    if (distance < least || distance > steepest * seen + least) return false;
  }
  blade_.push_back(*place);
  last_x_ = x, last_y_ = y;
  return true;
}

void SceneWidget::drag(int x, int y) {
  dragged_to_ = {x, y};
  if (!add_point(x, y) || painting_ || blade_.size() < 3) return;
  // The place before the last: smoothing uses both neighbours.
  const CutState cut = smoothed();
  ScalpelPath::Point place = cut.points[cut.points.size() - 2];
  if (place.depth <= 0) place.depth = session_.depth_of_case(session_.state().shown);
  live_cutting().cut_at(place);
  if (since_drawn_.elapsed() < static_cast<qint64>(2000 * frame_seconds_)) return;
  since_drawn_.restart();
  show_live(live_cutting());
}

void SceneWidget::release() {
  pressed_ = false;
  if (live_) live_->end_cut();
  show_live(nullptr, nullptr);
  if (blade_.size() < 2) {
    live_.reset();
    const double pixels =
        std::hypot(dragged_to_.first - pressed_at_.first, dragged_to_.second - pressed_at_.second);
    if (too_short && !painting_ && pixels > coarsest) too_short(stage_->mm_a_pixel(view_) * pixels);
    return;
  }
  if (painting_) {
    std::string line = "tension-stroke";
    for (const WoundView::Place& place : blade_) {
      const auto rounded = [](double mm) { return shortest(std::round(100 * mm) / 100); };
      const Vec3& p = place.position;
      line += " " + rounded(p.x) + "," + rounded(p.y) + "," + rounded(p.z);
    }
    return static_cast<void>(say_(line));
  }
  own_ = true;
  const bool cut = say_(cut_line("cut", smoothed()));
  own_ = false;
  if (!cut) live_.reset();
}

/// Made when the scalpel is taken up, so that the first cut need not wait for it.
ScalpelCutting& SceneWidget::live_cutting() {
  if (!live_) {
    ScalpelCutting::Setup setup;
    setup.made = session_.cut_paths();
    setup.fields = session_.cut_fields(session_.state().shown);
    setup.wait_for_guard = false;
    live_ = std::make_unique<ScalpelCutting>(*session_.mesh(), std::move(setup));
    moment_.reset();
  }
  return *live_;
}

void SceneWidget::show_live(ScalpelCutting& cutting) {
  const bool same = moment_ && moment_->cuts == cutting.figures().cuts;
  moment_ = moment_of(cutting, moment_.get());
  if (!same || !live_scene_) live_scene_ = std::make_shared<LiveScene>(moment_, session_.scene()->surface());
  live_scene_->show(moment_);
  show_live(live_scene_, nullptr);
}

void SceneWidget::show_live(std::shared_ptr<const WoundScene> scene, const HapticState* scalpel) {
  if (!scene) live_scene_.reset();
  stage_->set_live(std::move(scene), scalpel);
  draw();
}

/// Normals are those of single triangles under the mouse: the mean of a few makes the blade steady. The blade
/// is in the surface at rest.
CutState SceneWidget::smoothed() const {
  constexpr int reach = 3;
  const int count = static_cast<int>(blade_.size());
  std::vector<WoundView::Place> blade = blade_;
  const auto at = [&](int i) { return blade[std::clamp(i, 0, count - 1)]; };
  for (int pass = 0; pass < 2; ++pass) {  // a mouse goes from pixel to pixel, a hand does not
    std::vector<WoundView::Place> smooth = blade;
    for (int i = 1; i + 1 < count; ++i)
      smooth[i].position = 0.25 * (at(i - 1).position + 2 * at(i).position + at(i + 1).position);
    blade.swap(smooth);
  }
  CutState cut;
  for (int i = 0; i < count; ++i) {
    Vec3 outward;
    for (int k = -reach; k <= reach; ++k) outward += at(i + k).outward;
    outward = normalized(outward);
    const Vec3 along = at(i + 1).position - at(i - 1).position;
    const Vec3 across = cross(outward, along);
    const double tilt = tilt_ * M_PI / 180;
    if (norm(across) > 0) outward = std::cos(tilt) * outward - std::sin(tilt) * normalized(across);
    cut.points.push_back({at(i).position, outward, depth_});
  }
  return cut;
}

}  // namespace cleft
