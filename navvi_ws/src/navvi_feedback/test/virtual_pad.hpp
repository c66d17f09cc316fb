#pragma once

#include <SDL.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

/// Virtual pads have a sensor; in the program of gamepad_test.cpp.
extern std::atomic<bool> g_sensors;

namespace navvi_feedback::devices {

/// A DualSense in memory, and what its motors were told.
class VirtualPad {
 public:
  explicit VirtualPad(bool has_rumble = true) {
    SDL_VirtualJoystickDesc desc = {};
    desc.version = SDL_VIRTUAL_JOYSTICK_DESC_VERSION;
    desc.type = SDL_JOYSTICK_TYPE_GAMECONTROLLER;
    desc.naxes = SDL_CONTROLLER_AXIS_MAX;
    desc.nbuttons = SDL_CONTROLLER_BUTTON_MAX;
    desc.vendor_id = 0x054c;
    desc.product_id = 0x0ce6;
    desc.name = "virtual pad";
    desc.userdata = this;
    if (has_rumble) desc.Rumble = &VirtualPad::on_rumble;
    if (has_rumble) desc.RumbleTriggers = &VirtualPad::on_triggers;
    const int index = SDL_JoystickAttachVirtualEx(&desc);
    EXPECT_GE(index, 0) << SDL_GetError();
    joystick_ = SDL_JoystickOpen(index);
    EXPECT_NE(joystick_, nullptr);
    instance_ = SDL_JoystickInstanceID(joystick_);
  }
  ~VirtualPad() {
    detach();
    SDL_JoystickClose(joystick_);
  }
  VirtualPad(const VirtualPad&) = delete;
  VirtualPad& operator=(const VirtualPad&) = delete;

  void detach() {
    for (int index = 0; index < SDL_NumJoysticks(); ++index) {
      if (SDL_JoystickGetDeviceInstanceID(index) == instance_) SDL_JoystickDetachVirtual(index);
    }
  }
  void stick(double x, double y) {
    SDL_JoystickSetVirtualAxis(joystick_, SDL_CONTROLLER_AXIS_LEFTX, raw(x));
    SDL_JoystickSetVirtualAxis(joystick_, SDL_CONTROLLER_AXIS_LEFTY, raw(y));
  }
  void press(int button, bool down) {
    SDL_JoystickSetVirtualButton(joystick_, button, down ? 1 : 0);
  }
  /// From now on its motors take no command, or do again.
  void refuse(bool refuses) { refuses_ = refuses; }
  [[nodiscard]] SDL_JoystickID instance() const { return instance_; }
  [[nodiscard]] int left() const { return left_; }
  [[nodiscard]] int right() const { return right_; }
  /// Of the motors at the triggers; -1: never told.
  [[nodiscard]] int left_trigger() const { return left_trigger_; }
  [[nodiscard]] int right_trigger() const { return right_trigger_; }

 private:
  static Sint16 raw(double value) { return static_cast<Sint16>(std::lround(value * 32767.0)); }
  static int on_rumble(void* self, Uint16 low, Uint16 high) {
    if (static_cast<VirtualPad*>(self)->refuses_) return -1;
    static_cast<VirtualPad*>(self)->left_ = low;
    static_cast<VirtualPad*>(self)->right_ = high;
    return 0;
  }

  static int on_triggers(void* self, Uint16 left, Uint16 right) {
    static_cast<VirtualPad*>(self)->left_trigger_ = left;
    static_cast<VirtualPad*>(self)->right_trigger_ = right;
    return 0;
  }

  SDL_Joystick* joystick_ = nullptr;
  SDL_JoystickID instance_ = -1;
  std::atomic<bool> refuses_{false};
  std::atomic<int> left_{-1};
  std::atomic<int> right_{-1};
  std::atomic<int> left_trigger_{-1}, right_trigger_{-1};
};

/// A virtual pad with a sensor that streams at 100 Hz until it is frozen.
class StreamingPad {
 public:
  StreamingPad() {
    g_sensors = true;
    stream_ = std::thread([this] {
      while (!quit_) {
        SDL_Event event = {};
        event.csensor.type = SDL_CONTROLLERSENSORUPDATE;
        event.csensor.which = pad.instance();
        event.csensor.sensor = SDL_SENSOR_GYRO;
        if (!frozen) SDL_PushEvent(&event);
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
    });
  }
  ~StreamingPad() {
    quit_ = true;
    stream_.join();
    g_sensors = false;
  }
  StreamingPad(const StreamingPad&) = delete;
  StreamingPad& operator=(const StreamingPad&) = delete;

  VirtualPad pad;
  std::atomic<bool> frozen{false};

 private:
  std::atomic<bool> quit_{false};
  std::thread stream_;
};

}  // namespace navvi_feedback::devices
