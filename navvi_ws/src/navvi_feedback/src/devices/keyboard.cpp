#include "devices/keyboard.hpp"

#include <SDL.h>
#include <SDL_syswm.h>
#include <X11/keysym.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <string>
#include <utility>

#include "devices/device_error.hpp"

namespace navvi_feedback::devices {
namespace {

using namespace std::chrono_literals;

constexpr auto kPeriod = 10ms;
constexpr auto kAskPeriod = 500ms;
constexpr auto kGivesWay = 1s;
constexpr const char* kDrives =
    "NavVI - arrow keys drive, with Shift slowly; space repeats, G: goal, A: around";
constexpr const char* kWaits = "NavVI - select this window to drive";
constexpr double kSlow = 0.4;                            // of the stick, with Shift
constexpr int kWidth = 320, kHeight = 40, kMargin = 16;  // px
constexpr std::size_t kEnd = 4;                          // its place

struct Key {
  SDL_Keycode code = SDLK_UNKNOWN;
  KeySym symbol = NoSymbol;  ///< likewise, as X has it
};

/// In Gamepad's places: south, east, west, north, back, guide, start, sticks, shoulders, arrows;
/// and one after them.
constexpr std::array<Key, 16> kButtons = {{{SDLK_SPACE, XK_space},
                                           {SDLK_g, XK_g},
                                           {SDLK_a, XK_a},
                                           {SDLK_w, XK_w},
                                           {SDLK_F8, XK_F8},
                                           {SDLK_h, XK_h},
                                           {SDLK_RETURN, XK_Return},
                                           {},
                                           {},
                                           {},
                                           {SDLK_t, XK_t},
                                           {SDLK_PAGEUP, XK_Page_Up},
                                           {SDLK_PAGEDOWN, XK_Page_Down},
                                           {SDLK_BACKSPACE, XK_BackSpace},
                                           {},
                                           {SDLK_ESCAPE, XK_Escape}}};
constexpr std::array<Key, 6> kStick = {{{SDLK_UP, XK_Up},
                                        {SDLK_DOWN, XK_Down},
                                        {SDLK_LEFT, XK_Left},
                                        {SDLK_RIGHT, XK_Right},
                                        {SDLK_LSHIFT, XK_Shift_L},
                                        {SDLK_RSHIFT, XK_Shift_R}}};

/// What is written on the key; where that is no Latin letter, what is there on a Latin keyboard.
SDL_Keycode code_of(const SDL_Keysym& key) {
  const bool foreign = key.sym >= 0x80 && (key.sym & SDLK_SCANCODE_MASK) == 0;
  if (!foreign || key.scancode < SDL_SCANCODE_A || key.scancode > SDL_SCANCODE_Z) return key.sym;
  return SDLK_a + (key.scancode - SDL_SCANCODE_A);
}

/// SDL also has invisible video drivers, and falls back on them.
bool visible() {
  const char* driver = SDL_GetCurrentVideoDriver();
  return driver && (std::string(driver) == "x11" || std::string(driver) == "wayland");
}

/// The keys that are down by now. X repeats one that was held before the focus came as if it had
/// just been pressed, and SDL takes it for that; Wayland does not.
std::set<int> held_keys(SDL_Window* window) {
  std::set<int> held;
  SDL_SysWMinfo info;
  SDL_VERSION(&info.version);
  if (SDL_GetWindowWMInfo(window, &info) != SDL_TRUE || info.subsystem != SDL_SYSWM_X11)
    return held;
  std::array<char, 32> map{};
  XQueryKeymap(info.info.x11.display, map.data());
  const auto take = [&](const Key& key) {
    const unsigned code = XKeysymToKeycode(info.info.x11.display, key.symbol);
    if (code != 0 && (static_cast<unsigned char>(map[code / 8]) >> (code % 8) & 1) != 0)
      held.insert(key.code);
  };
  std::for_each(kButtons.begin(), kButtons.end(), take);
  std::for_each(kStick.begin(), kStick.end(), take);
  return held;
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
    // In an upper corner, where it covers neither the robot nor what is before it, and where room
    // for the frame, whose height is not known yet, is below.
    SDL_Rect screen = {0, 0, kWidth, kHeight};
    SDL_GetDisplayUsableBounds(0, &screen);
    window_ = SDL_CreateWindow(kWaits, screen.x + screen.w - kWidth - kMargin, screen.y, kWidth,
                               kHeight, SDL_WINDOW_SHOWN | SDL_WINDOW_ALWAYS_ON_TOP);
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

drive::InputState Keyboard::state() const {
  drive::InputState input;
  input.live = focused_;
  input.session = session_;
  const auto down = [&](SDL_Keycode key) { return down_.count(key) > 0; };
  const double full = down(SDLK_LSHIFT) || down(SDLK_RSHIFT) ? kSlow : 1.0;
  const auto axis = [&](SDL_Keycode plus, SDL_Keycode minus) {
    return full * ((down(plus) ? 1.0 : 0.0) - (down(minus) ? 1.0 : 0.0));
  };
  input.axes = {axis(SDLK_LEFT, SDLK_RIGHT), axis(SDLK_UP, SDLK_DOWN)};
  for (const Key& key : kButtons) input.buttons.push_back(down(key.code));
  return input;
}

void Keyboard::handle(const SDL_Event& event) {
  const Uint8 change =
      event.type == SDL_WINDOWEVENT ? event.window.event : Uint8{SDL_WINDOWEVENT_NONE};
  if (change == SDL_WINDOWEVENT_FOCUS_GAINED) {
    focused_ = true;
    ++session_;
    down_.clear();
    ignored_ = held_keys(window_);
  } else if (change == SDL_WINDOWEVENT_FOCUS_LOST) {
    focused_ = false;
    down_.clear();
  } else if (change == SDL_WINDOWEVENT_CLOSE) {
    drive::InputState closing = state();
    closing.live = true;
    (void)counter_.count(closing);
    closing.buttons[kEnd] = true;
    (void)counter_.count(closing);
  } else if (event.type == SDL_KEYDOWN && event.key.repeat == 0) {
    used_ = true;
    const SDL_Keycode code = code_of(event.key.keysym);
    if (ignored_.count(code) == 0) down_.insert(code);
  } else if (event.type == SDL_KEYUP) {
    ignored_.erase(code_of(event.key.keysym));
    down_.erase(code_of(event.key.keysym));
  }
  if (change == SDL_WINDOWEVENT_FOCUS_GAINED || change == SDL_WINDOWEVENT_FOCUS_LOST ||
      change == SDL_WINDOWEVENT_EXPOSED)
    paint();
}

std::optional<drive::InputState> Keyboard::read() {
  SDL_Event event;
  while (SDL_PollEvent(&event)) {
    handle(event);
    (void)counter_.count(state());
  }
  const auto now = std::chrono::steady_clock::now();
  show(now - gave_way_.load() >= kGivesWay);
  // RViz opens later, on top and with the focus. Once a key was used here, the focus is the
  // person's.
  if (visible_ && !focused_ && !used_ && now - asked_ >= kAskPeriod) ask_for_focus();
  return counter_.count(state());
}

void Keyboard::show(bool visible) {
  if (visible == std::exchange(visible_, visible)) return;
  if (visible) {
    SDL_ShowWindow(window_);
    used_ = false;  // the other window is gone
  } else {
    SDL_HideWindow(window_);
  }
}

void Keyboard::ask_for_focus() {
  asked_ = std::chrono::steady_clock::now();
  SDL_RaiseWindow(window_);
  SDL_SetWindowInputFocus(window_);
}

/// Green while the keys drive, red while they do not.
void Keyboard::paint() {
  SDL_SetWindowTitle(window_, focused_ ? kDrives : kWaits);
  SDL_Surface* surface = SDL_GetWindowSurface(window_);
  if (surface == nullptr) return;
  SDL_FillRect(
      surface, nullptr,
      focused_ ? SDL_MapRGB(surface->format, 0, 200, 83) : SDL_MapRGB(surface->format, 176, 0, 32));
  SDL_UpdateWindowSurface(window_);
}

void Keyboard::close() {
  SDL_DestroyWindow(window_);
  SDL_QuitSubSystem(SDL_INIT_VIDEO);
}

}  // namespace navvi_feedback::devices
