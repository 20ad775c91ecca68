// A haptic device in use: its cuts are drawn while they are made, and become cuts of the session when the
// blade leaves the skin.
#pragma once

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QString>
#include <QTimer>
#include <memory>

#include "explorer/app/panel.h"
#include "explorer/app/scene_widget.h"
#include "explorer/scalpel/live_scalpel.h"
#include "haptic/devices/mouse.h"

namespace cleft {

class DeviceControl : public Panel {
  Q_DECLARE_TR_FUNCTIONS(DeviceControl)

 public:
  /// `tell`: called with errors that occur without a command.
  DeviceControl(Session& session, SceneWidget& scene, Say say, std::function<void(const std::string&)> tell);
  ~DeviceControl() override;

  /// The device by its name, with its file, or "off". Throws InputError if there is none; the previous device
  /// then remains.
  void take(const std::string& name, const std::string& file);
  void follow(const Changes& changes) override;

  bool on() const { return scalpel_ != nullptr; }
  const std::string& name() const { return name_; }
  QString status() const;  ///< rate of the loop and force
  const HapticState& state() const { return state_; }

 private:
  std::unique_ptr<Device> make(const std::string& name, const std::string& file);
  void begin();
  void put_away();
  void tick();
  void say_cuts(const std::vector<LiveScalpel::Places>& cuts);
  void watch_presence(bool again);
  void move_mouse(double seconds);

  Session& session_;
  SceneWidget& widget_;
  Say say_;
  std::function<void(const std::string&)> tell_;
  std::string name_;
  std::unique_ptr<Device> device_;
  std::unique_ptr<LiveScalpel> scalpel_;  // before its device
  std::shared_ptr<LiveScene> scene_;
  std::shared_ptr<const SurfaceDent> dent_;
  QTimer timer_;
  QElapsedTimer since_tick_, since_rate_;
  HapticState state_;
  std::uint64_t ticks_ = 0;
  double rate_ = 0;                         // Hz
  const SurfaceMesh* felt_mesh_ = nullptr;  // of the session, before its cuts
  bool begins_again_ = false;               // as the session has changed while the blade cuts
  bool own_ = false, present_ = true;
  // The position of the mouse, and the height of its blade.
  std::optional<WoundView::Place> place_;
  bool pressed_ = false;
  double height_ = 0;  // mm
};

}  // namespace cleft
