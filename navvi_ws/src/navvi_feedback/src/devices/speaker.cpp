#include "devices/speaker.hpp"

#include <chrono>
#include <future>
#include <utility>

#include "cues/phrases.hpp"
#include "devices/voice.hpp"

namespace navvi_feedback::devices {
namespace {

using Clock = std::chrono::steady_clock;

Clock::duration seconds(double value) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(value));
}

/// Between two looks at a running sound, and at an idle device.
constexpr auto kPoll = std::chrono::milliseconds(10);
constexpr auto kIdlePoll = std::chrono::milliseconds(250);
/// What the mixer needs to fade a stopped sound out.
constexpr auto kFade = std::chrono::milliseconds(25);

}  // namespace

void SpeakerConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Any;
  using navvi_config::Range;
  visit(rate, "rate", Range{80.0, 449.0}, "words/min", "rate of speech");
  visit(volume, "volume", Range{0.0, 1.0}, "", "gain of the voice");
  visit(pitch, "pitch", Range{0.0, 99.0}, "", "of the voice; 50 is its own");
  visit(voice, "voice", Any{}, "",
        "a voice of espeak-ng, such as en-us; empty for that of the language");
}

Speaker::Speaker(const SpeakerConfig& config, Mixer& mixer) : config_(config), mixer_(mixer) {
  std::promise<void> ready;
  std::future<void> result = ready.get_future();
  thread_ = std::thread([this, ready = std::move(ready)]() mutable { run(std::move(ready)); });
  try {
    result.get();
  } catch (...) {
    thread_.join();
    throw;
  }
}

Speaker::~Speaker() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
    ++generation_;
  }
  changed_.notify_all();
  thread_.join();
}

void Speaker::set_rate(int rate) {
  const std::lock_guard lock(mutex_);
  config_.rate = rate;
}

void Speaker::start(const std::string& text) {
  const bool fit = cues::speakable(text);
  {
    const std::lock_guard lock(mutex_);
    ++generation_;
    busy_ = fit;
    request_ = fit ? std::optional(text) : std::nullopt;
    if (!fit) ++status_.failed;
  }
  changed_.notify_all();
}

void Speaker::stop() {
  {
    const std::lock_guard lock(mutex_);
    ++generation_;
    busy_ = false;
    request_.reset();
  }
  changed_.notify_all();
}

bool Speaker::busy() const {
  const std::lock_guard lock(mutex_);
  return busy_;
}

Speaker::Status Speaker::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

void Speaker::run(std::promise<void> ready) {
  std::optional<Voice> voice;
  try {
    voice.emplace(config_.voice, config_.rate, config_.pitch);
    ready.set_value();
  } catch (...) {
    ready.set_exception(std::current_exception());
    return;
  }
  while (const auto job = next()) {
    if (!job->text) {
      mixer_.tend();
      continue;
    }
    voice->set_rate(job->rate);
    const Sound sound = voice->synthesize(*job->text, [&] { return superseded(job->generation); });
    if (!superseded(job->generation)) play(sound, job->generation);
    finish(job->generation, !sound.samples.empty());
  }
}

std::optional<Speaker::Job> Speaker::next() {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, kIdlePoll, [this] { return quit_ || request_; });
  if (quit_) return std::nullopt;
  return Job{std::exchange(request_, std::nullopt), generation_, config_.rate};
}

bool Speaker::superseded(unsigned long generation) const {
  const std::lock_guard lock(mutex_);
  return generation != generation_;
}

void Speaker::play(const Sound& sound, unsigned long generation) {
  mixer_.tend();
  const auto end = Clock::now() + seconds(sound.duration());
  bool audible = !sound.samples.empty() && mixer_.speak(sound, config_.volume);
  while (true) {
    {
      std::unique_lock lock(mutex_);
      if (changed_.wait_for(lock, kPoll, [&] { return generation != generation_; })) break;
    }
    if (audible && !mixer_.speaking()) {
      audible = false;
      mixer_.tend();
    }
    // What a device that was lost did not play passes in silence, so that the times stay true.
    if (!audible && Clock::now() >= end) break;
  }
  if (audible && mixer_.speaking()) {
    mixer_.mute();
    std::this_thread::sleep_for(kFade);
  }
  mixer_.stop();
}

void Speaker::finish(unsigned long generation, bool done) {
  const std::lock_guard lock(mutex_);
  if (generation != generation_) return;
  busy_ = false;
  ++(done ? status_.spoken : status_.failed);
}

}  // namespace navvi_feedback::devices
