#include "explorer/app/device_control.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "explorer/scalpel/hand_script.h"
#include "explorer/wound/path_file.h"
#include "haptic/devices/list.h"
#include "haptic/firmness_above_bone.h"
#include "haptic/surface_stiffness.h"

namespace cleft {

namespace {
constexpr int refresh_ms = 33;
constexpr double hand_speed = 30;  // mm/s along its path
constexpr double hover = 4;        // mm over the skin, of a mouse that is not pressed
constexpr double sinking = 25;     // mm/s

/// N/mm: the shown case's, where it tells one.
ForceParameters forces(const std::shared_ptr<const Field>& field) {
  ForceParameters force;
  if (!field) return force;
  try {
    force.stiffness = surface_stiffness(*field);
  } catch (const InputError&) {  // fields of other programs tell none
  }
  return force;
}
}  // namespace

DeviceControl::DeviceControl(Session& session, SceneWidget& scene, Say say,
                             std::function<void(const std::string&)> tell)
    : session_(session), widget_(scene), say_(std::move(say)), tell_(std::move(tell)) {
  timer_.setInterval(refresh_ms);
  QObject::connect(&timer_, &QTimer::timeout, [this] { tick(); });
}

DeviceControl::~DeviceControl() { scalpel_.reset(); }

std::unique_ptr<Device> DeviceControl::make(const std::string& name, const std::string& file) {
  const DeviceKind kind = find_device(name);
  if (kind.input && file.empty())
    throw InputError("the device " + name + " plays a file: say device " + name + " " + kind.input->argument);
  DeviceRequest request;
  request.start = pose_above(*session_.mesh(), 1);
  request.trajectory = file;
  if (kind.input == &path_input) {
    const auto field = session_.field();
    const double scale = session_.state().scale;
    const ScalpelPath path =
        field ? read_path(file, 0, scale, field->cut().depth)
              : read_path(file, session_.depth_of_case(session_.state().shown), scale, std::nullopt);
    request.script = hand_along(path, scale, hand_speed, request.hand, forces(field));
  }
  return kind.make(request);
}

void DeviceControl::take(const std::string& name, const std::string& file) {
  if (name == "off") return put_away();
  auto device = make(name, file);
  put_away();
  device_ = std::move(device);
  name_ = name;
  present_ = true;
  const bool pointer = dynamic_cast<Mouse*>(device_.get()) != nullptr;
  if (pointer)
    widget_.pointed = [this](const std::optional<WoundView::Place>& place, bool pressed) {
      if (place) place_ = place;
      pressed_ = pressed;
    };
  widget_.setMouseTracking(pointer);
  widget_.keep_camera();
  begin();
}

void DeviceControl::begin() {
  ScalpelCutting::Setup setup;
  setup.made = session_.cut_paths();
  setup.fields = session_.cut_fields(session_.state().shown);
  const auto field = session_.field();
  if (field) setup.firmness = firmness_above_bone(*field, session_.distance_to_bone());
  setup.opened = session_.simulated_opening();
  timer_.stop();
  scalpel_.reset();
  scalpel_ = std::make_unique<LiveScalpel>(*session_.mesh(), std::move(setup), *device_, forces(field));
  dent_ = field ? std::make_shared<const SurfaceDent>(*field) : std::make_shared<const SurfaceDent>();
  scene_.reset();
  felt_mesh_ = session_.mesh(), begins_again_ = false;
  ticks_ = 0;
  height_ = hover;
  since_tick_.start(), since_rate_.start();
  timer_.start();
}

void DeviceControl::put_away() {
  timer_.stop();
  if (scalpel_ && session_.mesh()) say_cuts(scalpel_->stop());
  scalpel_.reset();
  device_.reset();
  scene_.reset();
  name_.clear();
  place_.reset();
  widget_.pointed = nullptr;
  widget_.show_live(nullptr, nullptr);
}

/// What others do to cuts, mesh or case, the scalpel must feel.
void DeviceControl::follow(const Changes& changes) {
  if (!on() || own_) return;
  if (!session_.mesh()) return put_away();
  if (!(changes.cuts || changes.study || changes.shown)) return;
  if (state_.phase == Phase::cutting && session_.mesh() == felt_mesh_)
    begins_again_ = true;  // once the cut has ended, which would be lost
  else
    begin();
}

void DeviceControl::tick() {
  move_mouse(1e-3 * static_cast<double>(since_tick_.restart()));
  state_ = scalpel_->state();
  if (const qint64 ms = since_rate_.elapsed(); ms > 500) {
    rate_ = 1e3 * static_cast<double>(state_.tick - ticks_) / static_cast<double>(ms);
    ticks_ = state_.tick;
    since_rate_.restart();
  }
  const auto moment = scalpel_->moment();
  if (scene_ && scene_->has_surface_of(*moment))
    scene_->show(moment);
  else
    scene_ = std::make_shared<LiveScene>(moment, session_.scene()->surface(), dent_);
  scene_->dent(state_);
  widget_.show_live(scene_, &state_);
  const bool begins = begins_again_ && state_.phase != Phase::cutting;
  const auto ended = begins ? scalpel_->stop() : scalpel_->ended_cuts();
  say_cuts(ended);
  if (begins) begin();
  watch_presence(!ended.empty());
  if (const std::string why = scalpel_->stopped(); !why.empty()) tell_(why);
}

void DeviceControl::say_cuts(const std::vector<LiveScalpel::Places>& cuts) {
  own_ = true;
  for (const LiveScalpel::Places& places : cuts)
    if (places.size() > 1) say_(cut_line("cut", {places}));
  own_ = false;
}

/// `again`: what was told has been wiped away by a line.
void DeviceControl::watch_presence(bool again) {
  const bool changed = state_.pose.present != present_;
  const bool pointer = dynamic_cast<Mouse*>(device_.get()) != nullptr;
  if (state_.tick == 0 || pointer || !(changed || (again && !present_))) return;
  present_ = state_.pose.present;
  tell_(present_ ? std::string()
                 : tr("the %1 is gone: nothing is cut until it is plugged in again")
                       .arg(QString::fromStdString(name_))
                       .toStdString());
}

/// Pressed it sinks until it is as deep as the case's cut, and rises when it is let go.
void DeviceControl::move_mouse(double seconds) {
  auto* mouse = dynamic_cast<Mouse*>(device_.get());
  if (!mouse || !place_) return;
  const double through = forces(session_.field()).puncture_force / forces(session_.field()).stiffness;
  const double deepest = std::max(1.1 * through, session_.depth_of_case(session_.state().shown));
  // What is met is met on the way down: it begins above the skin, and slow pictures are no leaps.
  const double step = state_.pose.present ? sinking * std::min(seconds, 0.05) : 0;
  height_ = std::clamp(pressed_ ? height_ - step : height_ + 4 * step, -deepest, hover);
  ScalpelPose pose;
  pose.axis = place_->outward;
  pose.tip = place_->position + height_ * place_->outward;
  const Vec3 way = pose.tip - state_.pose.tip;
  const Vec3 edge = way - dot(way, pose.axis) * pose.axis, kept = state_.pose.edge;
  const Vec3 ahead = norm(edge) > 0.1 ? edge : kept - dot(kept, pose.axis) * pose.axis;
  pose.edge = norm(ahead) > 1e-6
                  ? normalized(ahead)
                  : normalized(cross(pose.axis, std::abs(pose.axis.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
  mouse->set(pose);
}

QString DeviceControl::status() const {
  const QString device = QString::fromStdString(name_);
  if (!present_) return tr("%1 is gone").arg(device);
  return tr("%1: %2 Hz, %3 N").arg(device).arg(rate_, 0, 'f', 0).arg(norm(state_.force), 0, 'f', 2);
}

}  // namespace cleft
