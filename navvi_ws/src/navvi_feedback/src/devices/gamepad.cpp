#include "devices/gamepad.hpp"

#include <SDL.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "devices/device_error.hpp"

namespace navvi_feedback::devices {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kPeriod = 8ms;
constexpr auto kFrozen = 250ms;
constexpr auto kScanPeriod = 100ms;
constexpr auto kExpiry = 300ms;
constexpr auto kResend = 100ms;
constexpr auto kSilence = 400ms;  // so that the robot is stopped within 500 ms
// The first command wakes the motors and, on some pads, jolts: a soft pulse takes that jolt.
constexpr auto kPrime = 400ms;
constexpr double kPrimeForce = 0.06;

constexpr unsigned kSony = 0x054c;
constexpr unsigned kDualSense = 0x0ce6;
constexpr unsigned kFirstCalmFirmware = 0x0224;

using MotorValues = std::pair<Uint16, Uint16>;  // left, right

Uint16 motor_value(double force) {
  return static_cast<Uint16>(std::lround(std::clamp(force, 0.0, 1.0) * 65535.0));
}

double finite_or_zero(double value) { return std::isfinite(value) ? value : 0.0; }

double axis(SDL_GameController* pad, SDL_GameControllerAxis which) {
  return std::clamp(SDL_GameControllerGetAxis(pad, which) / 32767.0, -1.0, 1.0);
}

drive::InputState input_of(SDL_GameController* pad) {
  drive::InputState input;
  input.live = true;
  // SDL counts right and down as positive, joy_node left and forward.
  for (const auto which : {SDL_CONTROLLER_AXIS_LEFTX, SDL_CONTROLLER_AXIS_LEFTY,
                           SDL_CONTROLLER_AXIS_RIGHTX, SDL_CONTROLLER_AXIS_RIGHTY}) {
    input.axes.push_back(0.0 - axis(pad, which));
  }
  for (const auto which : {SDL_CONTROLLER_AXIS_TRIGGERLEFT, SDL_CONTROLLER_AXIS_TRIGGERRIGHT})
    input.axes.push_back(std::max(0.0, axis(pad, which)));
  for (int button = SDL_CONTROLLER_BUTTON_A; button <= SDL_CONTROLLER_BUTTON_DPAD_RIGHT; ++button)
    input.buttons.push_back(
        SDL_GameControllerGetButton(pad, static_cast<SDL_GameControllerButton>(button)) != 0);
  return input;
}

struct CloseController {
  void operator()(SDL_GameController* pad) const { SDL_GameControllerClose(pad); }
};

}  // namespace

class Gamepad::Pad {
 public:
  explicit Pad(SDL_GameController* pad)
      : pad_(pad),
        instance_(SDL_JoystickInstanceID(SDL_GameControllerGetJoystick(pad))),
        has_rumble_(SDL_GameControllerHasRumble(pad) == SDL_TRUE),
        has_triggers_(SDL_GameControllerHasRumbleTriggers(pad) == SDL_TRUE),
        opened_(Clock::now()) {
    for (const SDL_SensorType sensor : {SDL_SENSOR_GYRO, SDL_SENSOR_ACCEL})
      if (SDL_GameControllerHasSensor(pad, sensor) == SDL_TRUE &&
          SDL_GameControllerSetSensorEnabled(pad, sensor, SDL_TRUE) == 0)
        break;
  }

  [[nodiscard]] bool attached() const {
    return SDL_GameControllerGetAttached(pad_.get()) == SDL_TRUE;
  }
  [[nodiscard]] drive::InputState input() const { return input_of(pad_.get()); }
  void beat(Clock::time_point now) { beat_ = now; }
  [[nodiscard]] bool beats() const { return beat_.has_value(); }
  [[nodiscard]] bool silent(Clock::time_point now) const {
    return beat_ && now - *beat_ > kSilence;
  }
  [[nodiscard]] SDL_JoystickID instance() const { return instance_; }
  [[nodiscard]] bool rumbles() const { return has_rumble_ && !refused_; }

  void describe(Gamepad::Status& status) const {
    const char* name = SDL_GameControllerName(pad_.get());
    status.name = name ? name : "unnamed";
    std::array<char, 33> guid{};
    SDL_JoystickGetGUIDString(SDL_JoystickGetGUID(SDL_GameControllerGetJoystick(pad_.get())),
                              guid.data(), static_cast<int>(guid.size()));
    status.guid = guid.data();
    status.has_rumble = has_rumble_;
    status.firmware = SDL_GameControllerGetFirmwareVersion(pad_.get());
    status.jolting_firmware = SDL_GameControllerGetVendor(pad_.get()) == kSony &&
                              SDL_GameControllerGetProduct(pad_.get()) == kDualSense &&
                              status.firmware != 0 && status.firmware < kFirstCalmFirmware;
  }

  enum class Command { same, another, refused };

  Command drive(const haptics::Rumble& wish, Clock::time_point now) {
    if (!has_rumble_) return Command::same;
    double least = 0.0;
    if (now - opened_ < kPrime) {
      const double part = std::chrono::duration<double>(now - opened_) / kPrime;
      least = kPrimeForce * (1.0 - std::abs(2.0 * part - 1.0));
    }
    MotorValues wanted(motor_value(std::max(wish.left, least)),
                       motor_value(std::max(wish.right, least)));
    // What has refused is asked softly; SDL passes on only what differs from what was done last.
    const Uint16 soft = motor_value(kPrimeForce);
    if (refused_) wanted = {soft, done_.second == 0 ? soft : Uint16{0}};
    const bool resend = wanted != MotorValues() && now - sent_time_ >= kResend;
    const MotorValues triggers = wish.sides && has_triggers_ ? wanted : MotorValues();
    const bool same = wanted == sent_ && triggers == triggers_;
    if (same && !resend) return Command::same;
    const Command command = same ? Command::same : Command::another;
    sent_ = wanted;
    sent_time_ = now;
    if (triggers != MotorValues() || triggers_ != MotorValues())
      SDL_GameControllerRumbleTriggers(pad_.get(), triggers.first, triggers.second,
                                       static_cast<Uint32>(kExpiry.count()));
    triggers_ = triggers;
    refused_ = SDL_GameControllerRumble(pad_.get(), wanted.first, wanted.second,
                                        static_cast<Uint32>(kExpiry.count())) < 0;
    if (refused_) return Command::refused;
    done_ = wanted;
    return command;
  }
  void silence() {
    if (has_rumble_) SDL_GameControllerRumble(pad_.get(), 0, 0, 0);
    if (has_triggers_) SDL_GameControllerRumbleTriggers(pad_.get(), 0, 0, 0);
  }

 private:
  std::unique_ptr<SDL_GameController, CloseController> pad_;
  SDL_JoystickID instance_;
  bool has_rumble_, has_triggers_;
  Clock::time_point opened_;
  MotorValues sent_, done_, triggers_;
  bool refused_ = false;  ///< the last command
  Clock::time_point sent_time_;
  std::optional<Clock::time_point> beat_;  ///< the last of its sensor
};

Gamepad::Gamepad() {
  std::promise<void> started;
  std::future<void> start = started.get_future();
  thread_ = std::thread(&Gamepad::run, this, std::move(started));
  try {
    start.get();
  } catch (...) {
    thread_.join();
    throw;
  }
}

Gamepad::~Gamepad() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    quit_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

drive::InputState Gamepad::input() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return Clock::now() - read_time_ <= kFrozen ? input_ : drive::InputState{};
}

Gamepad::Status Gamepad::status() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return status_;
}

void Gamepad::rumble(const haptics::Rumble& rumble, std::function<void()> called) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!called_ && status_.connected) called_ = std::move(called);
    wish_ = {finite_or_zero(rumble.left), finite_or_zero(rumble.right), rumble.sides};
    wish_time_ = Clock::now();
    woken_ = true;
  }
  changed_.notify_all();
}

void Gamepad::run(std::promise<void> started) {
  SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
  SDL_SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");
  SDL_SetHint(SDL_HINT_JOYSTICK_HIDAPI_PS5_RUMBLE, "1");
  if (SDL_InitSubSystem(SDL_INIT_GAMECONTROLLER) != 0)
    return started.set_exception(std::make_exception_ptr(
        DeviceError(std::string("SDL finds no game controllers: ") + SDL_GetError())));
  read();
  started.set_value();
  while (rest()) read();
  if (pad_) pad_->silence();
  pad_.reset();
  SDL_QuitSubSystem(SDL_INIT_GAMECONTROLLER);
}

bool Gamepad::rest() {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, kPeriod, [this] { return woken_ || quit_; });
  woken_ = false;
  return !quit_;
}

void Gamepad::read() {
  SDL_GameControllerUpdate();
  const Clock::time_point now = Clock::now();
  if (pad_ && !pad_->attached()) forget_pad();
  hear_pad(now);
  if (now - scanned_ >= kScanPeriod) {
    scanned_ = now;
    scan();
  }
  move_motors(now);
  drive::InputState input = pad_ && !pad_->silent(now) ? pad_->input() : drive::InputState{};
  input.session = session_;
  input = counter_.count(std::move(input));
  const std::lock_guard<std::mutex> lock(mutex_);
  input_ = std::move(input);
  read_time_ = Clock::now();
}

void Gamepad::scan() {
  unsigned others = 0;
  for (int index = 0; index < SDL_NumJoysticks(); ++index) {
    if (!SDL_IsGameController(index)) continue;
    if (!pad_) take_pad(index);
    if (!pad_ || SDL_JoystickGetDeviceInstanceID(index) != pad_->instance()) ++others;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  status_.others = others;
}

/// State is polled; of the queue of events only the heartbeat is of interest.
void Gamepad::hear_pad(Clock::time_point now) {
  std::array<SDL_Event, 64> events;
  for (int count = 1; count > 0;) {
    count = SDL_PeepEvents(events.data(), static_cast<int>(events.size()), SDL_GETEVENT,
                           SDL_JOYAXISMOTION, SDL_CONTROLLERSENSORUPDATE);
    for (int i = 0; i < count; ++i)
      if (const SDL_Event& event = events[static_cast<std::size_t>(i)];
          event.type == SDL_CONTROLLERSENSORUPDATE && pad_ &&
          event.csensor.which == pad_->instance())
        pad_->beat(now);
  }
  if (!pad_) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  status_.heartbeat = pad_->beats();
  if (std::exchange(status_.silent, pad_->silent(now)) && !status_.silent) ++session_;
}

void Gamepad::take_pad(int index) {
  SDL_GameController* controller = SDL_GameControllerOpen(index);
  if (!controller) return;
  pad_ = std::make_unique<Pad>(controller);
  ++session_;
  const std::lock_guard<std::mutex> lock(mutex_);
  pad_->describe(status_);
  status_.connected = true;
  ++status_.connections;
}

void Gamepad::forget_pad() {
  pad_.reset();
  scanned_ = Clock::now();  // so that the loss is seen before another pad takes over
  const std::lock_guard<std::mutex> lock(mutex_);
  called_ = {};
  const Status old = status_;
  status_ = Status{};
  status_.rumble_errors = old.rumble_errors;
  status_.connections = old.connections;
}

void Gamepad::move_motors(Clock::time_point now) {
  if (!pad_) return;
  haptics::Rumble wish;
  std::function<void()> called;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (now - wish_time_ < kExpiry) wish = wish_;
    called = std::exchange(called_, {});
  }
  const Pad::Command command = pad_->drive(wish, now);
  if (command == Pad::Command::another && called) called();
  const std::lock_guard<std::mutex> lock(mutex_);
  status_.has_rumble = pad_->rumbles();
  if (command == Pad::Command::refused) ++status_.rumble_errors;
}

}  // namespace navvi_feedback::devices
