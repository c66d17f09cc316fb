#include "devices/device_thread.hpp"

#include <exception>
#include <future>

namespace navvi_feedback::devices {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kFrozen(250);

}  // namespace

DeviceThread::DeviceThread(ThreadedDevice& device, std::chrono::milliseconds period) {
  std::promise<void> started;
  std::future<void> start = started.get_future();
  thread_ = std::thread([this, &device, period, started = std::move(started)]() mutable {
    try {
      device.open();
    } catch (...) {
      return started.set_exception(std::current_exception());
    }
    std::optional<drive::InputState> input = device.read();
    store(input.value_or(drive::InputState{}));
    started.set_value();
    while (input && rest(period)) {
      input = device.read();
      store(input.value_or(drive::InputState{}));
    }
    device.close();
  });
  try {
    start.get();
  } catch (...) {
    thread_.join();
    throw;
  }
}

DeviceThread::~DeviceThread() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    quit_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void DeviceThread::wake() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    woken_ = true;
  }
  changed_.notify_all();
}

bool DeviceThread::rest(std::chrono::milliseconds period) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, period, [this] { return woken_ || quit_; });
  woken_ = false;
  return !quit_;
}

drive::InputState DeviceThread::input() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return Clock::now() - read_time_ <= kFrozen ? input_ : drive::InputState{};
}

void DeviceThread::store(const drive::InputState& input) {
  const std::lock_guard<std::mutex> lock(mutex_);
  input_ = input;
  read_time_ = Clock::now();
}

}  // namespace navvi_feedback::devices
