#include "devices/keyboard.hpp"

#include <SDL.h>

#include <chrono>
#include <string>

#include "devices/device_error.hpp"

namespace navvi_feedback::devices {
namespace {

using namespace std::chrono_literals;

constexpr auto kPeriod = 10ms;
constexpr auto kAskPeriod = 500ms;
constexpr const char* kDrives =
    "NavVI - arrow keys drive, with Shift slowly; space repeats, G: goal, A: around";
constexpr const char* kWaits = "NavVI - select this window to drive";
constexpr double kSlow = 0.4;       // of the stick, with Shift
constexpr auto kPress = 100ms;      // what is pressed by closing the window is held for
constexpr std::size_t kEscape = 4;  // its place

/// SDL also has invisible video drivers, and falls back on them.
bool visible() {
  const char* driver = SDL_GetCurrentVideoDriver();
  return driver && (std::string(driver) == "x11" || std::string(driver) == "wayland");
}

drive::InputState read_keys() {
  drive::InputState input;
  input.live = true;
  const Uint8* keys = SDL_GetKeyboardState(nullptr);
  const auto down = [&](SDL_Scancode key) { return keys[key] != 0; };
  const double full = down(SDL_SCANCODE_LSHIFT) || down(SDL_SCANCODE_RSHIFT) ? kSlow : 1.0;
  const auto axis = [&](SDL_Scancode plus, SDL_Scancode minus) {
    return full * ((down(plus) ? 1.0 : 0.0) - (down(minus) ? 1.0 : 0.0));
  };
  input.axes = {axis(SDL_SCANCODE_LEFT, SDL_SCANCODE_RIGHT),
                axis(SDL_SCANCODE_UP, SDL_SCANCODE_DOWN)};
  // In Gamepad's places: south, east, west, north, back, guide, start, sticks, shoulders, arrows.
  for (const SDL_Scancode key :
       {SDL_SCANCODE_SPACE, SDL_SCANCODE_G, SDL_SCANCODE_A, SDL_SCANCODE_W, SDL_SCANCODE_ESCAPE,
        SDL_SCANCODE_H, SDL_SCANCODE_RETURN, SDL_SCANCODE_UNKNOWN, SDL_SCANCODE_UNKNOWN,
        SDL_SCANCODE_UNKNOWN, SDL_SCANCODE_T, SDL_SCANCODE_PAGEUP, SDL_SCANCODE_PAGEDOWN,
        SDL_SCANCODE_BACKSPACE, SDL_SCANCODE_UNKNOWN})
    input.buttons.push_back(down(key));
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
    window_ = SDL_CreateWindow(kWaits, SDL_WINDOWPOS_UNDEFINED, SDL_WINDOWPOS_UNDEFINED, 640, 80,
                               SDL_WINDOW_SHOWN | SDL_WINDOW_ALWAYS_ON_TOP);
  }
  if (!window_) {
    const std::string why =
        visible() ? std::string("The keyboard's window does not open: ") + SDL_GetError()
                  : no_display + "Is DISPLAY set?";
    SDL_QuitSubSystem(SDL_INIT_VIDEO);
    throw DeviceError(why);
  }
  ask_for_focus();
}

std::optional<drive::InputState> Keyboard::read() {
  SDL_Event event;
  bool uncovered = false;
  while (SDL_PollEvent(&event)) {
    const bool close = event.type == SDL_WINDOWEVENT && event.window.event == SDL_WINDOWEVENT_CLOSE;
    if (close || event.type == SDL_QUIT) closed_ = std::chrono::steady_clock::now();
    uncovered = uncovered ||
                (event.type == SDL_WINDOWEVENT && event.window.event == SDL_WINDOWEVENT_EXPOSED);
    if (event.type == SDL_KEYDOWN) used_ = true;
  }
  const bool focused = (SDL_GetWindowFlags(window_) & SDL_WINDOW_INPUT_FOCUS) != 0;
  if (focused && !focused_) ++session_;
  if (focused != focused_ || uncovered) paint(focused);
  focused_ = focused;
  // RViz opens later, on top and with the focus. Once a key was used here, the focus is the
  // person's.
  if (!focused && !used_ && std::chrono::steady_clock::now() - asked_ >= kAskPeriod)
    ask_for_focus();
  drive::InputState input = focused ? read_keys() : drive::InputState{};
  input.session = session_;
  input.buttons.resize(15);
  if (std::chrono::steady_clock::now() - closed_ < kPress) input.buttons[kEscape] = true;
  return input;
}

void Keyboard::ask_for_focus() {
  asked_ = std::chrono::steady_clock::now();
  SDL_RaiseWindow(window_);
  SDL_SetWindowInputFocus(window_);
}

/// Green while the keys drive, red while they do not.
void Keyboard::paint(bool focused) {
  SDL_SetWindowTitle(window_, focused ? kDrives : kWaits);
  SDL_Surface* surface = SDL_GetWindowSurface(window_);
  if (surface == nullptr) return;
  SDL_FillRect(
      surface, nullptr,
      focused ? SDL_MapRGB(surface->format, 0, 200, 83) : SDL_MapRGB(surface->format, 176, 0, 32));
  SDL_UpdateWindowSurface(window_);
}

void Keyboard::close() {
  SDL_DestroyWindow(window_);
  SDL_QuitSubSystem(SDL_INIT_VIDEO);
}

}  // namespace navvi_feedback::devices
