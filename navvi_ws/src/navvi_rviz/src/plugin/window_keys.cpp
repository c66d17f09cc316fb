#include "plugin/window_keys.hpp"

#include <X11/XKBlib.h>
#include <X11/Xlib.h>
#include <X11/keysym.h>
#include <poll.h>
#include <ros/console.h>
#include <sys/resource.h>

#include <algorithm>
#include <bitset>
#include <chrono>
#include <map>
#include <utility>

namespace navvi_rviz::plugin {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kPeriod = 20ms;
constexpr auto kRescan = 1s;    // children of the window come and go
constexpr int kNiceness = -10;  // as feedback_node's
constexpr float kSlow = 0.4F;   // of the stick, with Shift

/// As feedback_node's own window has them.
constexpr std::array<KeySym, 16> kButtons = {
    XK_space, XK_g,     XK_a, XK_w,       XK_F8,        XK_h,         XK_Return, NoSymbol,
    NoSymbol, NoSymbol, XK_t, XK_Page_Up, XK_Page_Down, XK_BackSpace, NoSymbol,  XK_Escape};
constexpr std::array<KeySym, 6> kStick = {XK_Up,    XK_Down,    XK_Left,
                                          XK_Right, XK_Shift_L, XK_Shift_R};

/// Windows may vanish while they are looked at; that is no reason to end the program, as Xlib does.
thread_local bool t_reader = false;
XErrorHandler g_others = nullptr;
int on_error(Display* display, XErrorEvent* error) {
  return t_reader || g_others == nullptr ? 0 : g_others(display, error);
}

}  // namespace

class WindowKeys::Reader {
 public:
  /// No display: there are no keys to read.
  Reader() : display_(XOpenDisplay(nullptr)) {
    if (display_ == nullptr) return;
    g_others = XSetErrorHandler(on_error);
    XkbSetDetectableAutoRepeat(display_, True, nullptr);
  }
  ~Reader() {
    if (display_ == nullptr) return;
    XCloseDisplay(display_);
    const XErrorHandler last = XSetErrorHandler(g_others);
    if (last != on_error) XSetErrorHandler(last);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  [[nodiscard]] bool works() const { return display_ != nullptr; }
  [[nodiscard]] int connection() const { return ConnectionNumber(display_); }
  [[nodiscard]] bool pending() { return XPending(display_) > 0; }
  [[nodiscard]] bool focused() const { return focused_; }

  void look_at(Window window) {
    const Clock::time_point now = Clock::now();
    if (window == window_ && now - scanned_ < kRescan) return;
    scanned_ = now;
    if (std::exchange(window_, window) != window) {
      Window focus = 0;
      int revert = 0;
      XGetInputFocus(display_, &focus, &revert);
      focused_ = focus == window && window != 0;
      begin();
    }
    if (window_ != 0) select(window_);
  }

  /// From now on: what is down already was not pressed here.
  void begin() {
    down_.clear();
    std::array<char, 32> map{};
    XQueryKeymap(display_, map.data());
    for (std::size_t code = 0; code < ignored_.size(); ++code)
      ignored_[code] = (static_cast<unsigned char>(map[code / 8]) >> (code % 8) & 1) != 0;
  }

  void take() {
    XEvent event;
    XNextEvent(display_, &event);
    if (event.type == MappingNotify) XRefreshKeyboardMapping(&event.xmapping);
    if (event.type == FocusIn || event.type == FocusOut) take(event.xfocus);
    if (event.type == KeyPress || event.type == KeyRelease) take(event.xkey);
  }

  [[nodiscard]] Typed typed() const {
    Typed typed;
    const auto down = [this](KeySym symbol) {
      return std::any_of(down_.begin(), down_.end(),
                         [&](const auto& key) { return key.second == symbol; });
    };
    const float full = down(XK_Shift_L) || down(XK_Shift_R) ? kSlow : 1.0F;
    const auto axis = [&](KeySym plus, KeySym minus) {
      return full *
             static_cast<float>(static_cast<int>(down(plus)) - static_cast<int>(down(minus)));
    };
    typed.axes = {axis(XK_Left, XK_Right), axis(XK_Up, XK_Down)};
    for (std::size_t i = 0; i < kButtons.size(); ++i)
      typed.buttons[i] = kButtons[i] != NoSymbol && down(kButtons[i]);
    return typed;
  }

 private:
  /// A key goes to the window below the pointer or, of those around it, to the first that any
  /// program listens at. So this listens where Qt does, and at no other: a window of OGRE's would
  /// keep the keys from Qt.
  void select(Window window) {
    XWindowAttributes known;
    if (XGetWindowAttributes(display_, window, &known) == 0) return;
    if (((known.all_event_masks | known.your_event_mask) & KeyPressMask) != 0)
      XSelectInput(display_, window, KeyPressMask | KeyReleaseMask | FocusChangeMask);
    Window root = 0, parent = 0, *children = nullptr;
    unsigned count = 0;
    if (XQueryTree(display_, window, &root, &parent, &children, &count) == 0) return;
    for (unsigned i = 0; i < count; ++i) select(children[i]);
    if (children != nullptr) XFree(children);
  }

  void take(const XFocusChangeEvent& event) {
    const bool inside = event.detail == NotifyInferior;
    const bool pointer = event.detail == NotifyPointer || event.detail == NotifyPointerRoot;
    if (event.window != window_ || inside || pointer) return;
    // While the window manager holds the keyboard, as for one of its own keys, nothing is typed.
    focused_ = event.type == FocusIn || event.mode == NotifyGrab;
    begin();
  }

  void take(const XKeyEvent& event) {
    const unsigned code = event.keycode % 256;
    if (event.type == KeyRelease) {
      ignored_[code] = false;
      down_.erase(code);
      return;
    }
    const bool with_others = (event.state & (ControlMask | Mod1Mask | Mod4Mask)) != 0;
    if (ignored_[code] || with_others) return;
    if (const KeySym symbol = symbol_of(event); symbol != NoSymbol) down_[code] = symbol;
  }

  /// Which of our keys it is: by the first layout where the present one has other letters.
  [[nodiscard]] KeySym symbol_of(const XKeyEvent& event) const {
    for (const unsigned group : {XkbGroupForCoreState(event.state), 0U}) {
      const KeySym symbol = XkbKeycodeToKeysym(display_, static_cast<KeyCode>(event.keycode),
                                               static_cast<int>(group), 0);
      const auto known = [&](const auto& keys) {
        return std::find(keys.begin(), keys.end(), symbol) != keys.end();
      };
      if (symbol != NoSymbol && (known(kButtons) || known(kStick))) return symbol;
    }
    return NoSymbol;
  }

  Display* display_;
  Window window_ = 0;
  bool focused_ = false;
  std::map<unsigned, KeySym> down_;  ///< by X's code of the key
  std::bitset<256> ignored_;         ///< likewise: down since before the window had the focus
  Clock::time_point scanned_{};
};

WindowKeys::WindowKeys(std::function<void(const Typed*)> tell)
    : tell_(std::move(tell)), reader_(std::make_unique<Reader>()) {
  if (reader_->works())
    thread_ = std::thread([this] { run(*reader_); });
  else
    ROS_WARN("Keys typed into the picture do not drive: there is no X server.");
}

WindowKeys::~WindowKeys() {
  quit_ = true;
  if (thread_.joinable()) thread_.join();
}

void WindowKeys::run(Reader& reader) {
  t_reader = true;
  // Of this thread alone, where the kernel grants it: the picture keeps all processors busy.
  setpriority(PRIO_PROCESS, 0, kNiceness);
  bool ours = false;
  const auto tell = [&] {
    const Typed typed = reader.typed();
    tell_(ours && reader.focused() ? &typed : nullptr);
  };
  Clock::time_point next = Clock::now();
  while (!quit_) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(next - Clock::now());
    pollfd connection = {reader.connection(), POLLIN, 0};
    if (!reader.pending()) poll(&connection, 1, std::max(0, static_cast<int>(left.count())));
    reader.look_at(window_);
    const bool before = std::exchange(ours, ours_.load());
    if (ours && !before) reader.begin();
    while (reader.pending()) {
      reader.take();
      tell();  // a press may be over with the next event
    }
    if (Clock::now() < next) continue;
    tell();
    next = Clock::now() + kPeriod;
  }
}

}  // namespace navvi_rviz::plugin
