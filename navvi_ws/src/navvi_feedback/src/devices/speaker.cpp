#include "devices/speaker.hpp"

#include <chrono>
#include <utility>

#include "cues/phrases.hpp"
#include "devices/earcons.hpp"

namespace navvi_feedback::devices {
namespace {

using Clock = std::chrono::steady_clock;

Clock::duration seconds(double value) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(value));
}

/// Between two looks at a running sound, at one that is to begin or to end, and at an idle device.
constexpr auto kPoll = std::chrono::milliseconds(10);
constexpr auto kCloseLook = std::chrono::milliseconds(1);
constexpr auto kIdlePoll = std::chrono::milliseconds(250);
/// The mixer needs no longer to fade a stopped sound out.
constexpr auto kFade = std::chrono::milliseconds(25);
/// Between two looks; what halts this program so long halts its sound, too.
constexpr auto kHalted = std::chrono::milliseconds(500);
/// A device that has not played a sentence so long after its end hangs.
constexpr auto kHangs = std::chrono::seconds(2);

}  // namespace

void SpeakerConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit(rate, "rate", Range{80.0, 449.0}, "words/min", "rate of speech");
  visit(volume, "volume", Range{0.0, 1.0}, "", "gain of the voice");
  visit(pitch, "pitch", Range{0.0, 99.0}, "", "of the voice; 50 is its own");
  visit(voice, "voice", navvi_config::Any{}, "",
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

void Speaker::start(const std::string& text, std::function<void()> begun,
                    std::vector<sounds::Play> scan) {
  const bool fit = cues::speakable(text);
  {
    const std::lock_guard lock(mutex_);
    ++generation_;
    busy_ = fit;
    request_ = fit ? std::optional(text) : std::nullopt;
    begun_ = std::move(begun);
    scan_ = std::move(scan);
    status_.heard = fit;
    if (!fit) ++status_.failed;
  }
  changed_.notify_all();
}

void Speaker::stop(std::function<void()> silent) {
  {
    const std::lock_guard lock(mutex_);
    ++generation_;
    busy_ = false;
    request_.reset();
    silent_ = std::move(silent);
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

std::vector<sounds::Play> Speaker::take_played() {
  const std::lock_guard lock(mutex_);
  return std::exchange(played_, {});
}

void Speaker::run(std::promise<void> ready) {
  std::optional<Voice> voice;
  try {
    voice.emplace(config_.voice, config_.pitch);
    ready.set_value();
  } catch (...) {
    ready.set_exception(std::current_exception());
    return;
  }
  while (auto job = next()) {
    if (!job->text) {
      mixer_.tend();
      voice->tend();
    }
    const bool spoken = job->text && speak(*voice, *job);
    const std::lock_guard lock(mutex_);
    status_.losses = voice->losses();
    status_.works = voice->works();
    if (!job->text || job->generation != generation_) continue;
    busy_ = false;
    status_.heard = spoken && job->heard;
    ++(spoken ? status_.spoken : status_.failed);
  }
}

bool Speaker::speak(Voice& voice, Job& job) {
  std::string rest = *job.text;
  bool spoken = true;
  for (std::size_t part = 0; !rest.empty() && !superseded(job.generation); ++part) {
    const auto comma = part < job.scan.size() ? rest.find(", ") : std::string::npos;
    const std::string words = rest.substr(0, comma);
    rest = comma == std::string::npos ? "" : rest.substr(comma + 2);
    if (part < job.scan.size() && job.scan[part].volume > 0.0) play_first(job.scan[part], job);
    const bool said = say(voice, words, job);
    spoken = spoken && said;
    if (!said && !superseded(job.generation)) play_first({sounds::Earcon::unsaid}, job);
  }
  return spoken;
}

bool Speaker::say(Voice& voice, const std::string& words, Job& job) {
  for (int tries = 0; tries < 2 && !superseded(job.generation); ++tries) {
    const auto sound = voice.begin(words, job.rate);
    if (sound && sound->samples.empty()) return false;
    if (sound && play(voice, *sound, job)) return true;
  }
  return false;
}

/// Returns when it has been heard, or was superseded.
void Speaker::play_first(const sounds::Play& play, Job& job) {
  const Sound sound = synthesize(play.earcon);
  if (mixer_.play(sound, play.volume, play.from) && job.begun) std::exchange(job.begun, {})();
  std::unique_lock lock(mutex_);
  played_.push_back(play);
  changed_.wait_for(lock, seconds(sound.duration()), [&] { return job.generation != generation_; });
}

std::optional<Speaker::Job> Speaker::next() {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, kIdlePoll, [this] { return quit_ || request_; });
  if (quit_) return std::nullopt;
  Job job{std::exchange(request_, std::nullopt), generation_, config_.rate, true,
          std::exchange(begun_, {}), std::exchange(silent_, {}), std::exchange(scan_, {})};
  if (!std::exchange(fades_, false)) job.silent = {};  // nothing was heard
  return job;
}

bool Speaker::superseded(unsigned long generation) const {
  const std::lock_guard lock(mutex_);
  return generation != generation_;
}

bool Speaker::play(Voice& voice, const Sound& sound, Job& job) {
  mixer_.tend();
  auto looked = Clock::now();
  auto end = looked + seconds(sound.duration());
  const bool faded = mixer_.mixed() != muted_at_;  // what was cut, in a mix since
  bool audible = mixer_.speak(sound, config_.volume);
  bool begun = !audible;
  bool whole = false;
  bool heard = false;
  int first = 0;  // samples of the first mix
  while (true) {
    {
      std::unique_lock lock(mutex_);
      if (changed_.wait_for(lock, begun ? kPoll : kCloseLook,
                            [&] { return job.generation != generation_; }))
        break;
    }
    if (!begun && (first = mixer_.mixed()) > 0) {
      begun = true;
      mixer_.plays(true);
      if (job.begun) std::exchange(job.begun, {})();
    }
    if (begun && !std::exchange(whole, true)) {
      const auto rest = voice.rest();
      if (!rest) {
        mixer_.stop();
        return false;
      }
      end += seconds(rest->duration());
      audible = audible && mixer_.speak_on(*rest);
    }
    if (job.silent && begun && (faded || mixer_.mixed() > first)) std::exchange(job.silent, {})();
    const auto last = std::exchange(looked, Clock::now());
    if (audible && looked - last > kHalted) end += looked - last;
    const bool hangs = looked > end + kHangs;
    if (audible && (hangs || !mixer_.speaking())) {
      audible = false;
      if (hangs) mixer_.plays(false);
      heard = mixer_.tend() && begun && !hangs;
    }
    // What a device that was lost did not play passes in silence, so that the times stay true.
    if (!audible && Clock::now() >= end) break;
  }
  if (audible && mixer_.speaking())
    fall_silent();
  else
    mixer_.stop();
  job.heard = job.heard && heard;
  return true;
}

void Speaker::fall_silent() {
  muted_at_ = mixer_.mixed();
  mixer_.mute();
  const auto end = Clock::now() + kFade;
  // The first mix from now on fades out, the next is silent.
  int mixes = 0;
  for (int seen = mixer_.mixed(); mixes < 2 && Clock::now() < end;) {
    {
      std::unique_lock lock(mutex_);
      fades_ = changed_.wait_for(lock, kCloseLook, [this] { return request_.has_value(); });
    }
    if (fades_) return;
    const int now = mixer_.mixed();
    if (now != seen) ++mixes;
    seen = now;
  }
  mixer_.stop();
  std::function<void()> silent;
  {
    const std::lock_guard lock(mutex_);
    silent = std::exchange(silent_, {});
  }
  if (silent) silent();
}

void SpeechChannel::obey(const cues::VoiceOrder& order, bool pressed) {
  const auto now = Latencies::Clock::now();
  if (pressed) pressed_ = now;
  const auto timed = [&](Chain chain, Latencies::Clock::time_point cause) {
    return [&latencies = latencies_, chain, cause] { latencies.add(chain, cause); };
  };
  if (order.stop) stop(timed(Chain::silence, now));
  if (!order.start) return;
  const auto cause = order.asked ? std::exchange(pressed_, {}) : std::nullopt;
  start(*order.start, timed(cause ? Chain::answer : Chain::words, cause.value_or(now)), order.scan);
}

}  // namespace navvi_feedback::devices
