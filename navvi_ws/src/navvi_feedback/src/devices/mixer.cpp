#include "devices/mixer.hpp"

#include <AL/al.h>
#include <AL/alc.h>
#include <AL/alext.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace navvi_feedback::devices {

namespace {

/// Keeps the libraries below OpenAL, which complain of every device that is not there, from
/// writing to the terminal. What other threads write to it meanwhile is lost too.
class QuietErrors {
 public:
  QuietErrors() : kept_(fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0)) {
    const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (kept_ >= 0 && nothing >= 0) dup2(nothing, STDERR_FILENO);
    if (nothing >= 0) ::close(nothing);
  }
  ~QuietErrors() {
    if (kept_ < 0) return;
    dup2(kept_, STDERR_FILENO);
    ::close(kept_);
  }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;

 private:
  int kept_;
};

using Clock = std::chrono::steady_clock;

/// What waits longer than this for the device is late, and not played.
constexpr auto kPatience = std::chrono::milliseconds(5);

ALCdevice* open_quietly(const std::string& name) {
  const QuietErrors quiet;
  return alcOpenDevice(name.empty() ? nullptr : name.c_str());
}

void place(ALuint source, const Eigen::Vector2d& from) {
  // OpenAL: x right, y up, z backward. A robot's own centre counts as ahead.
  const Eigen::Vector2d at = from.norm() > 1e-3 ? from.normalized() : Eigen::Vector2d::UnitX();
  alSource3f(source, AL_POSITION, static_cast<float>(-at.y()), 0.0F, static_cast<float>(-at.x()));
}

}  // namespace

void MixerConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Any;
  visit(device, "device", Any{}, "", "name of the OpenAL device; empty for the default one");
  visit(hrtf, "hrtf", navvi_config::OneOf{{"auto", "on", "off"}}, "",
        "sound for two ears, so that ahead and behind differ; auto: with headphones");
  visit(volume, "volume", navvi_config::Range{0.1, 1.0}, "", "gain of all that is heard");
}

struct Mixer::Handles {
  /// The first two are the voice's in turn, so that a sentence begins while the one before fades
  /// out; the last is that of what lasts.
  static constexpr std::size_t kSources = 11;
  static constexpr std::size_t kVoices = 2;
  static constexpr std::size_t kLasting = kSources - 1;

  ALCdevice* device = nullptr;
  ALCcontext* context = nullptr;
  std::array<ALuint, kSources> sources{};
  std::array<ALuint, kSources> buffers{};
  std::array<ALuint, kVoices> rests{};  ///< buffers of what follows
  std::size_t voice = 0;
  std::size_t next = kVoices;  ///< of the short sounds, the oldest

  [[nodiscard]] bool start(std::size_t index, const Sound& sound, double gain,
                           const Eigen::Vector2d& from) const {
    const ALuint source = sources.at(index);
    release(index);
    alGetError();
    fill(buffers.at(index), sound);
    if (index < kVoices)
      alSourceQueueBuffers(source, 1, &buffers.at(index));
    else
      alSourcei(source, AL_BUFFER, static_cast<ALint>(buffers.at(index)));
    alSourcef(source, AL_GAIN, static_cast<float>(gain));
    place(source, from);
    alSourcePlay(source);
    return alGetError() == AL_NO_ERROR;
  }
  /// What was heard to its end before this came is not heard again.
  [[nodiscard]] bool go_on(const Sound& sound) const {
    const ALuint source = sources.at(voice);
    alGetError();
    fill(rests.at(voice), sound);
    ALint state = AL_STOPPED;
    alGetSourcei(source, AL_SOURCE_STATE, &state);
    ALuint heard = 0;
    if (state != AL_PLAYING) alSourceUnqueueBuffers(source, 1, &heard);
    alSourceQueueBuffers(source, 1, &rests.at(voice));
    if (state != AL_PLAYING) alSourcePlay(source);
    return alGetError() == AL_NO_ERROR;
  }
  static void fill(ALuint buffer, const Sound& sound) {
    alBufferData(buffer, AL_FORMAT_MONO16, sound.samples.data(),
                 static_cast<ALsizei>(sound.samples.size() * sizeof(sound.samples[0])), sound.rate);
  }
  void release(std::size_t index) const {
    alSourceStop(sources.at(index));
    alSourcei(sources.at(index), AL_BUFFER, 0);
  }
};

Mixer::Mixer(const MixerConfig& config, Audio audio)
    : config_(config),
      audio_(audio),
      volume_(config.volume),
      handles_(std::make_unique<Handles>()) {
  if (audio_ == Audio::on) open(Status::Device::missing);
}

Mixer::~Mixer() { close(); }

void Mixer::open(Status::Device otherwise) {
  // Where there never was a device one is unlikely to come, and each attempt makes ALSA complain.
  const double wait = (otherwise == Status::Device::missing ? 10.0 : 1.0) * config_.reopen;
  next_attempt_ = Clock::now() +
                  std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(wait));
  handles_->device = open_quietly(config_.device);
  if (handles_->device == nullptr)
    return report(otherwise, config_.device.empty()
                                 ? "OpenAL finds no audio device"
                                 : "OpenAL cannot open the device \"" + config_.device + "\"");
  const ALCint hrtf = config_.hrtf == "auto" ? ALC_DONT_CARE_SOFT
                      : config_.hrtf == "on" ? ALC_TRUE
                                             : ALC_FALSE;
  const std::array<ALCint, 3> attributes = {ALC_HRTF_SOFT, hrtf, 0};
  handles_->context = alcCreateContext(handles_->device, attributes.data());
  alGetError();
  if (handles_->context != nullptr && alcMakeContextCurrent(handles_->context) == ALC_TRUE) {
    alGenSources(Handles::kSources, handles_->sources.data());
    alGenBuffers(Handles::kSources, handles_->buffers.data());
    alGenBuffers(Handles::kVoices, handles_->rests.data());
  }
  if (handles_->sources[0] == 0 || handles_->buffers[0] == 0) {
    close();
    return report(otherwise, "OpenAL cannot play on its device");
  }
  for (const ALuint source : handles_->sources) {
    alSourcei(source, AL_SOURCE_RELATIVE, AL_TRUE);
    alSourcef(source, AL_ROLLOFF_FACTOR, 0.0F);
  }
  report(Status::Device::open, "");
}

void Mixer::close() {
  if (handles_->sources[0] != 0) {
    for (std::size_t i = 0; i < Handles::kSources; ++i) handles_->release(i);
    alDeleteSources(Handles::kSources, handles_->sources.data());
  }
  if (handles_->buffers[0] != 0) alDeleteBuffers(Handles::kSources, handles_->buffers.data());
  if (handles_->context != nullptr) {
    alcMakeContextCurrent(nullptr);
    alcDestroyContext(handles_->context);
  }
  if (handles_->device != nullptr) alcCloseDevice(handles_->device);
  *handles_ = Handles();
}

bool Mixer::connected() const {
  if (handles_->device == nullptr) return false;
  if (alcIsExtensionPresent(handles_->device, "ALC_EXT_disconnect") != ALC_TRUE) return true;
  ALCint connected = ALC_TRUE;
  alcGetIntegerv(handles_->device, ALC_CONNECTED, 1, &connected);
  return connected == ALC_TRUE;
}

bool Mixer::tend() {
  const std::lock_guard lock(device_mutex_);
  if (audio_ == Audio::off || connected()) return true;
  if (handles_->device != nullptr) {
    close();
    report(Status::Device::lost, "the audio device disappeared");
    next_attempt_ = Clock::now();
  }
  if (Clock::now() >= next_attempt_) open(status().device);
  return false;
}

void Mixer::plays(bool does) {
  const std::lock_guard lock(device_mutex_);  // close() would wait for a device that hangs
  if (!connected() || does == (status().device == Status::Device::open)) return;
  does ? report(Status::Device::open, "")
       : report(Status::Device::lost, "the audio device does not play");
}

Mixer::Status Mixer::status() const {
  const std::lock_guard lock(status_mutex_);
  return status_;
}

void Mixer::report(Status::Device device, const std::string& detail) {
  std::string name;
  ALCint hrtf = ALC_FALSE;
  if (handles_->device != nullptr) {
    alcGetIntegerv(handles_->device, ALC_HRTF_SOFT, 1, &hrtf);
    const bool all = alcIsExtensionPresent(nullptr, "ALC_ENUMERATE_ALL_EXT") == ALC_TRUE;
    const ALCchar* known =
        alcGetString(handles_->device, all ? ALC_ALL_DEVICES_SPECIFIER : ALC_DEVICE_SPECIFIER);
    if (known != nullptr) name = known;
  }
  const std::lock_guard lock(status_mutex_);
  status_ = {device, name, detail, hrtf == ALC_TRUE};
}

bool Mixer::speak(const Sound& sound, double gain) {
  const std::lock_guard lock(device_mutex_);
  handles_->voice = 1 - handles_->voice;
  return connected() &&
         handles_->start(handles_->voice, sound, volume_ * gain, Eigen::Vector2d::UnitX());
}

bool Mixer::speak_on(const Sound& sound) {
  const std::lock_guard lock(device_mutex_);
  return connected() && (sound.samples.empty() || handles_->go_on(sound));
}

bool Mixer::speaking() const {
  const std::lock_guard lock(device_mutex_);
  if (!connected()) return false;
  ALint state = AL_STOPPED;
  alGetSourcei(handles_->sources[handles_->voice], AL_SOURCE_STATE, &state);
  return state == AL_PLAYING;
}

int Mixer::mixed() const {
  const std::lock_guard lock(device_mutex_);
  ALint samples = 0;
  if (connected()) alGetSourcei(handles_->sources[handles_->voice], AL_SAMPLE_OFFSET, &samples);
  return samples;
}

void Mixer::mute() {
  const std::lock_guard lock(device_mutex_);
  // The mixer ramps to the new gain over one period.
  if (handles_->device != nullptr) alSourcef(handles_->sources[handles_->voice], AL_GAIN, 0.0F);
}

void Mixer::stop() {
  const std::lock_guard lock(device_mutex_);
  if (handles_->device != nullptr) handles_->release(handles_->voice);
}

bool Mixer::play(const Sound& sound, double gain, const Eigen::Vector2d& from) {
  const std::unique_lock lock(device_mutex_, kPatience);
  if (!lock || !connected() || status().device != Status::Device::open) return false;
  if (++handles_->next >= Handles::kLasting) handles_->next = Handles::kVoices;
  return handles_->start(handles_->next, sound, volume_ * gain, from);
}

bool Mixer::hold(const Sound& sound, double gain, double pitch, double leftness) {
  const std::unique_lock lock(device_mutex_, kPatience);
  if (!lock || !connected() || status().device != Status::Device::open) return false;
  const ALuint source = handles_->sources.at(Handles::kLasting);
  const Eigen::Vector2d from(std::sqrt(std::max(0.0, 1.0 - leftness * leftness)), leftness);
  ALint state = AL_STOPPED;
  alGetSourcei(source, AL_SOURCE_STATE, &state);
  if (state != AL_PLAYING) {
    if (gain <= 0.0) return true;
    alSourcei(source, AL_LOOPING, AL_TRUE);
    if (!handles_->start(Handles::kLasting, sound, 0.0, from)) return false;
  }
  // The mixer ramps to each new value over one period.
  alSourcef(source, AL_GAIN, static_cast<float>(volume_ * gain));
  alSourcef(source, AL_PITCH, static_cast<float>(pitch));
  place(source, from);
  return true;
}

}  // namespace navvi_feedback::devices
