#include "navvi_feedback/keyboard.hpp"

#include <SDL.h>

#include <atomic>
#include <chrono>
#include <future>
#include <mutex>
#include <string>
#include <thread>

namespace navvi_feedback {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kPeriod = 10ms;
constexpr auto kFrozen = 250ms;
constexpr const char* kTitle = "NavVI - arrow keys drive, space repeats, G says where the goal is";

/// SDL also has video drivers that nobody sees, and falls back on them.
bool visible() {
  const char* driver = SDL_GetCurrentVideoDriver();
  return driver && (std::string(driver) == "x11" || std::string(driver) == "wayland");
}

InputState read_keys(bool focused) {
  InputState input;
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

class Keyboard::Window {
 public:
  Window() {
    std::promise<std::string> started;
    std::future<std::string> error = started.get_future();
    thread_ = std::thread([this, &started] { run(started); });
    const std::string sentence = error.get();
    if (sentence.empty()) return;
    thread_.join();
    throw DeviceError(sentence);
  }
  ~Window() {
    quit_ = true;
    thread_.join();
  }

  InputState input() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return Clock::now() - read_time_ <= kFrozen ? input_ : InputState{};
  }

 private:
  // SDL wants its window, its events and its end in one thread.
  void run(std::promise<std::string>& started) {
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    SDL_SetHint(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "1");
    const std::string no_display = "The keyboard needs a display, and there is none. ";
    if (SDL_InitSubSystem(SDL_INIT_VIDEO) != 0) {
      started.set_value(no_display + SDL_GetError());
      return;
    }
    if (!visible()) {
      SDL_QuitSubSystem(SDL_INIT_VIDEO);
      started.set_value(no_display + "Is DISPLAY set?");
      return;
    }
    SDL_Window* window = SDL_CreateWindow(kTitle, SDL_WINDOWPOS_UNDEFINED, SDL_WINDOWPOS_UNDEFINED,
                                          640, 80, SDL_WINDOW_SHOWN);
    if (!window) {
      const std::string sentence =
          std::string("The keyboard's window does not open: ") + SDL_GetError();
      SDL_QuitSubSystem(SDL_INIT_VIDEO);
      started.set_value(sentence);
      return;
    }
    SDL_RaiseWindow(window);
    started.set_value("");
    bool open = true;
    while (!quit_ && open) {
      open = step(window);
      std::this_thread::sleep_for(kPeriod);
    }
    store(InputState{});
    SDL_DestroyWindow(window);
    SDL_QuitSubSystem(SDL_INIT_VIDEO);
  }

  /// \return false once the window was closed
  bool step(SDL_Window* window) {
    SDL_Event event;
    while (SDL_PollEvent(&event)) {
      const bool close =
          event.type == SDL_WINDOWEVENT && event.window.event == SDL_WINDOWEVENT_CLOSE;
      if (close || event.type == SDL_QUIT) return false;
    }
    store(read_keys((SDL_GetWindowFlags(window) & SDL_WINDOW_INPUT_FOCUS) != 0));
    return true;
  }

  void store(const InputState& input) {
    const std::lock_guard<std::mutex> lock(mutex_);
    input_ = input;
    read_time_ = Clock::now();
  }

  std::thread thread_;
  std::atomic<bool> quit_{false};
  mutable std::mutex mutex_;
  InputState input_;
  Clock::time_point read_time_{};
};

Keyboard::Keyboard() : window_(std::make_unique<Window>()) {}
Keyboard::~Keyboard() = default;
InputState Keyboard::input() const { return window_->input(); }

}  // namespace navvi_feedback
