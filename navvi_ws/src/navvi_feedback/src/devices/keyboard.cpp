#include "devices/keyboard.hpp"

#include <SDL.h>

#include <chrono>
#include <string>

#include "devices/device_error.hpp"

namespace navvi_feedback::devices {
namespace {

using namespace std::chrono_literals;

constexpr auto kPeriod = 10ms;
constexpr const char* kTitle = "NavVI - arrow keys drive, space repeats, G says where the goal is";

/// SDL also has invisible video drivers, and falls back on them.
bool visible() {
  const char* driver = SDL_GetCurrentVideoDriver();
  return driver && (std::string(driver) == "x11" || std::string(driver) == "wayland");
}

drive::InputState read_keys(bool focused) {
  drive::InputState input;
  input.live = true;
  const Uint8* keys = SDL_GetKeyboardState(nullptr);
  const auto down = [&](SDL_Scancode key) { return focused && keys[key] != 0; };
  const auto axis = [&](SDL_Scancode plus, SDL_Scancode minus) {
    return (down(plus) ? 1.0 : 0.0) - (down(minus) ? 1.0 : 0.0);
  };
  input.axes = {axis(SDL_SCANCODE_LEFT, SDL_SCANCODE_RIGHT),
                axis(SDL_SCANCODE_UP, SDL_SCANCODE_DOWN)};
  input.buttons = {down(SDL_SCANCODE_SPACE), down(SDL_SCANCODE_G)};
  return input;
}

}  // namespace

Keyboard::Keyboard() : thread_(*this, kPeriod) {}
drive::InputState Keyboard::input() const { return thread_.input(); }

void Keyboard::open() {
  SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
  SDL_SetHint(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "1");
  const std::string no_display = "The keyboard needs a display, and there is none. ";
  if (SDL_InitSubSystem(SDL_INIT_VIDEO) != 0) throw DeviceError(no_display + SDL_GetError());
  if (visible()) {
    window_ = SDL_CreateWindow(kTitle, SDL_WINDOWPOS_UNDEFINED, SDL_WINDOWPOS_UNDEFINED, 640, 80,
                               SDL_WINDOW_SHOWN);
  }
  if (!window_) {
    const std::string why =
        visible() ? std::string("The keyboard's window does not open: ") + SDL_GetError()
                  : no_display + "Is DISPLAY set?";
    SDL_QuitSubSystem(SDL_INIT_VIDEO);
    throw DeviceError(why);
  }
  SDL_RaiseWindow(window_);
}

std::optional<drive::InputState> Keyboard::read() {
  SDL_Event event;
  while (SDL_PollEvent(&event)) {
    const bool close = event.type == SDL_WINDOWEVENT && event.window.event == SDL_WINDOWEVENT_CLOSE;
    if (close || event.type == SDL_QUIT) return std::nullopt;
  }
  return read_keys((SDL_GetWindowFlags(window_) & SDL_WINDOW_INPUT_FOCUS) != 0);
}

void Keyboard::close() {
  SDL_DestroyWindow(window_);
  SDL_QuitSubSystem(SDL_INIT_VIDEO);
}

}  // namespace navvi_feedback::devices
