// A gamepad that SDL itself pretends: its virtual joystick.
#include <SDL2/SDL.h>
#include <gtest/gtest.h>

#include <atomic>

#include "haptic/devices/gamepad.h"
#include "tests/haptic/devices/bench.h"

namespace cleft::testing {

namespace {

class VirtualPad : public Bench {
 public:
  VirtualPad() {
    SDL_SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");
    EXPECT_EQ(SDL_Init(SDL_INIT_GAMECONTROLLER), 0) << SDL_GetError();
    plug();
  }
  ~VirtualPad() override {
    if (joystick_) unplug();
    SDL_QuitSubSystem(SDL_INIT_GAMECONTROLLER);
  }
  std::unique_ptr<Device> open(const ScalpelPose& start) override { return std::make_unique<Gamepad>(start); }
  void push(double part) override {
    SDL_JoystickSetVirtualAxis(joystick_, SDL_CONTROLLER_AXIS_LEFTX, static_cast<Sint16>(32767 * part));
  }
  void press(bool down) override { SDL_JoystickSetVirtualButton(joystick_, SDL_CONTROLLER_BUTTON_A, down); }
  void plug() override {
    SDL_VirtualJoystickDesc pad{};
    pad.version = SDL_VIRTUAL_JOYSTICK_DESC_VERSION;
    pad.type = SDL_JOYSTICK_TYPE_GAMECONTROLLER;
    pad.naxes = SDL_CONTROLLER_AXIS_MAX;
    pad.nbuttons = SDL_CONTROLLER_BUTTON_MAX;
    pad.button_mask = (1u << SDL_CONTROLLER_BUTTON_MAX) - 1;
    pad.axis_mask = (1u << SDL_CONTROLLER_AXIS_MAX) - 1;
    pad.name = "bench";
    pad.userdata = this;
    pad.Rumble = [](void* self, Uint16 low, Uint16) {
      static_cast<VirtualPad*>(self)->rumble_ = low;
      return 0;
    };
    index_ = SDL_JoystickAttachVirtualEx(&pad);
    ASSERT_GE(index_, 0) << SDL_GetError();
    joystick_ = SDL_JoystickOpen(index_);
    ASSERT_TRUE(joystick_);
  }
  void unplug() override {
    SDL_JoystickDetachVirtual(index_);
    SDL_JoystickClose(joystick_);
    joystick_ = nullptr;
  }
  double felt() override { return rumble_ / 65535.; }
  std::string remedy() const override { return "plug one in"; }

 private:
  int index_ = -1;
  SDL_Joystick* joystick_ = nullptr;
  std::atomic<int> rumble_{0};
};

}  // namespace

std::unique_ptr<Bench> gamepad_bench() { return std::make_unique<VirtualPad>(); }

}  // namespace cleft::testing
