// The program of the keyboard's window: keys in, their state out. An X server that dies ends only
// this process. Its first frame has the value 1, or 0 and a sentence on what failed as its bytes;
// each further one has a process::Keys. Whatever is received hides the window for a second.

#include <SDL.h>
#include <SDL_syswm.h>
#include <X11/keysym.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <set>
#include <string>
#include <utility>

#include "drive/press_counter.hpp"
#include "process/frame.hpp"
#include "process/keys.hpp"

namespace navvi_feedback::process {
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
constexpr std::array<Key, kKeys> kButtons = {{{SDLK_SPACE, XK_space},
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

/// The arrow keys as a stick, with Shift deflected by less than half, from a small window in the
/// upper right corner of the screen: green while the keys drive, red while another window has the
/// focus. Until a first key it takes the focus by itself. It hides while keys can be typed into
/// another window of NavVI's. Closing it presses F8. Keys come as events: none is too short, and one
/// that is down when the focus comes back counts only once it was released.
class KeyWindow {
 public:
  /// \return empty, or a sentence on what failed
  [[nodiscard]] std::string open() {
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    SDL_SetHint(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "1");
    const std::string no_display = "The keyboard needs a display, and there is none. ";
    if (SDL_InitSubSystem(SDL_INIT_VIDEO) != 0) return no_display + SDL_GetError();
    if (!visible()) return no_display + "Is DISPLAY set?";
    // In an upper corner, where it covers neither the robot nor what is before it, and where room
    // for the frame, whose height is not known yet, is below.
    SDL_Rect screen = {0, 0, kWidth, kHeight};
    SDL_GetDisplayUsableBounds(0, &screen);
    window_ = SDL_CreateWindow(kWaits, screen.x + screen.w - kWidth - kMargin, screen.y, kWidth,
                               kHeight, SDL_WINDOW_SHOWN | SDL_WINDOW_ALWAYS_ON_TOP);
    if (!window_) return std::string("The keyboard's window does not open: ") + SDL_GetError();
    ask_for_focus();
    return "";
  }

  [[nodiscard]] drive::InputState read() {
    SDL_Event event;
    while (SDL_PollEvent(&event)) {
      handle(event);
      (void)counter_.count(state());
    }
    const auto now = Clock::now();
    show(now - gave_way_ >= kGivesWay);
    // RViz opens later, on top and with the focus. Once a key was used here, the focus is the
    // person's.
    if (visible_ && !focused_ && !used_ && now - asked_ >= kAskPeriod) ask_for_focus();
    return counter_.count(state());
  }

  void give_way() { gave_way_ = Clock::now(); }

 private:
  void handle(const SDL_Event& event) {
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

  void show(bool visible) {
    if (visible == std::exchange(visible_, visible)) return;
    if (visible) {
      SDL_ShowWindow(window_);
      used_ = false;  // the other window is gone
    } else {
      SDL_HideWindow(window_);
    }
  }

  void ask_for_focus() {
    asked_ = std::chrono::steady_clock::now();
    SDL_RaiseWindow(window_);
    SDL_SetWindowInputFocus(window_);
  }

  /// Green while the keys drive, red while they do not.
  void paint() {
    SDL_SetWindowTitle(window_, focused_ ? kDrives : kWaits);
    SDL_Surface* surface = SDL_GetWindowSurface(window_);
    if (surface == nullptr) return;
    SDL_FillRect(surface, nullptr,
                 focused_ ? SDL_MapRGB(surface->format, 0, 200, 83)
                          : SDL_MapRGB(surface->format, 176, 0, 32));
    SDL_UpdateWindowSurface(window_);
  }

  [[nodiscard]] drive::InputState state() const {
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

  SDL_Window* window_ = nullptr;
  bool visible_ = true;
  bool focused_ = false;
  bool used_ = false;      ///< a key was pressed here
  std::set<int> down_;     ///< by SDL_Keycode
  std::set<int> ignored_;  ///< likewise: down since before the focus came
  unsigned session_ = 0;
  drive::PressCounter counter_;
  Clock::time_point asked_{}, gave_way_{};
};

Keys keys_of(const drive::InputState& input) {
  Keys keys{};
  keys.read = Clock::now().time_since_epoch().count();
  keys.focused = input.live;
  keys.session = input.session;
  std::copy_n(input.axes.begin(), keys.axes.size(), keys.axes.begin());
  std::copy_n(input.buttons.begin(), kKeys, keys.buttons.begin());
  std::copy_n(input.presses.begin(), kKeys, keys.presses.begin());
  return keys;
}

int run() {
  const int socket = socket_of_parent();
  KeyWindow window;
  const std::string failure = window.open();
  if (!send(socket, failure.empty() ? 1 : 0, failure) || !failure.empty()) return 1;
  while (true) {
    if (receive(socket, Clock::now() + kPeriod)) window.give_way();
    const Keys keys = keys_of(window.read());
    if (!send(socket, 1, {reinterpret_cast<const char*>(&keys), sizeof keys})) return 0;
  }
}

}  // namespace
}  // namespace navvi_feedback::process

int main() { return navvi_feedback::process::run(); }
