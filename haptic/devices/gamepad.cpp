#include "haptic/devices/gamepad.h"

#include <SDL2/SDL.h>

#include <chrono>

#include "haptic/devices/shared_library.h"

namespace cleft {

namespace {
constexpr const char* gamepad_name = "gamepad";
constexpr auto look_every = std::chrono::milliseconds(4), reopen_every = std::chrono::milliseconds(200);
constexpr double dead = 0.08;    // of a stick's way: worn sticks do not come back to their middle
constexpr int rumble_for = 250;  // ms, renewed before they are over
}  // namespace

struct Gamepad::Library {
  SharedLibrary library{gamepad_name, "libSDL2-2.0.so.0", "install the package libsdl2-2.0-0"};
  decltype(SDL_InitSubSystem)* init;
  decltype(SDL_QuitSubSystem)* quit;
  decltype(SDL_SetHint)* hint;
  decltype(SDL_GetError)* error;
  decltype(SDL_NumJoysticks)* count;
  decltype(SDL_IsGameController)* is_gamepad;
  decltype(SDL_GameControllerOpen)* open;
  decltype(SDL_GameControllerClose)* close;
  decltype(SDL_GameControllerGetAttached)* attached;
  decltype(SDL_GameControllerUpdate)* update;
  decltype(SDL_GameControllerGetAxis)* axis;
  decltype(SDL_GameControllerGetButton)* button;
  decltype(SDL_GameControllerRumble)* rumble;
  decltype(SDL_GameControllerEventState)* event_state;
  SDL_GameController* pad = nullptr;

  Library() {
    library.find(init, "SDL_InitSubSystem");
    library.find(quit, "SDL_QuitSubSystem");
    library.find(hint, "SDL_SetHint");
    library.find(error, "SDL_GetError");
    library.find(count, "SDL_NumJoysticks");
    library.find(is_gamepad, "SDL_IsGameController");
    library.find(open, "SDL_GameControllerOpen");
    library.find(close, "SDL_GameControllerClose");
    library.find(attached, "SDL_GameControllerGetAttached");
    library.find(update, "SDL_GameControllerUpdate");
    library.find(axis, "SDL_GameControllerGetAxis");
    library.find(button, "SDL_GameControllerGetButton");
    library.find(rumble, "SDL_GameControllerRumble");
    library.find(event_state, "SDL_GameControllerEventState");
    hint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");  // there is no window to have the focus
    hint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    if (init(SDL_INIT_GAMECONTROLLER) != 0)
      throw InputError(std::string("gamepad: SDL cannot look for any: ") + error());
    event_state(SDL_IGNORE);
  }
  ~Library() {
    if (pad) close(pad);
    quit(SDL_INIT_GAMECONTROLLER);
  }
};

Gamepad::Gamepad(const ScalpelPose& start) : sdl_(std::make_unique<Library>()), pose_(start) {
  sdl_->update();
  if (!open())
    throw InputError("gamepad: none was found among " + std::to_string(sdl_->count()) +
                     " joysticks: plug one in, and let this user read /dev/input (group input)");
  watcher_ = std::thread([this] { watch(); });
}

Gamepad::~Gamepad() {
  stop_ = true;
  watcher_.join();
}

bool Gamepad::open() {
  for (int n = 0; n < sdl_->count() && !sdl_->pad; ++n)
    if (sdl_->is_gamepad(n)) sdl_->pad = sdl_->open(n);
  return sdl_->pad != nullptr;
}

void Gamepad::close() {
  sdl_->close(sdl_->pad);
  sdl_->pad = nullptr;
}

void Gamepad::watch() {
  auto tried = std::chrono::steady_clock::now();
  for (; !stop_; std::this_thread::sleep_for(look_every)) {
    sdl_->update();
    if (sdl_->pad && !sdl_->attached(sdl_->pad)) close();
    if (!sdl_->pad && std::chrono::steady_clock::now() - tried > reopen_every) {
      tried = std::chrono::steady_clock::now();
      open();
    }
    deflection_.write(sdl_->pad ? look() : Deflection{});
    if (sdl_->pad) rumble();
  }
}

Deflection Gamepad::look() const {
  const auto part = [this](SDL_GameControllerAxis axis) {
    const double x = std::clamp(sdl_->axis(sdl_->pad, axis) / 32767., -1., 1.);
    return std::abs(x) < dead ? 0. : x;
  };
  Deflection d;
  d.present = true;
  d.cutting = sdl_->button(sdl_->pad, SDL_CONTROLLER_BUTTON_A) != 0;
  d.move = {part(SDL_CONTROLLER_AXIS_LEFTX), -part(SDL_CONTROLLER_AXIS_LEFTY),
            -part(SDL_CONTROLLER_AXIS_RIGHTY)};
  d.turn = {0, 0, -part(SDL_CONTROLLER_AXIS_RIGHTX)};
  return d;
}

void Gamepad::rumble() {
  const double strength = std::min(1., force_.read() / limits().max_force);
  static constexpr double noticeable = 0.02;
  if (std::abs(strength - rumbling_) < noticeable && strength < noticeable) return;
  rumbling_ = strength;
  const auto motor = static_cast<Uint16>(65535 * strength);
  sdl_->rumble(sdl_->pad, motor, motor, rumble_for);
}

DeviceKind gamepad_device() {
  return {.name = gamepad_name,
          .title = "&Gamepad",
          .help =
              "the left stick moves the blade, the right stick lifts and turns it, A cuts; contact is felt "
              "as rumble",
          .make = [](const DeviceRequest& request) -> std::unique_ptr<Device> {
            return std::make_unique<Gamepad>(request.start);
          }};
}

}  // namespace cleft
