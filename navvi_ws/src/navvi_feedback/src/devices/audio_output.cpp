#include "devices/audio_output.hpp"

#include <AL/al.h>
#include <AL/alc.h>
#include <AL/alext.h>
#include <fcntl.h>
#include <unistd.h>

#include <array>

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

ALCdevice* open_quietly(const std::string& name) {
  const QuietErrors quiet;
  return alcOpenDevice(name.empty() ? nullptr : name.c_str());
}

}  // namespace

struct AudioOutput::Handles {
  ALCdevice* device = nullptr;
  ALCcontext* context = nullptr;
  ALuint source = 0;
  ALuint buffer = 0;
  float volume = 1.0F;
};

AudioOutput::AudioOutput() : handles_(std::make_unique<Handles>()) {}

AudioOutput::~AudioOutput() { close(); }

bool AudioOutput::open(const std::string& device, double volume) {
  close();
  handles_->device = open_quietly(device);
  if (handles_->device == nullptr) return false;
  // A hundred mixes a second: what is stopped is silent within some 10 ms.
  const std::array<ALCint, 3> attributes = {ALC_REFRESH, 100, 0};
  handles_->context = alcCreateContext(handles_->device, attributes.data());
  if (handles_->context == nullptr || alcMakeContextCurrent(handles_->context) != ALC_TRUE) {
    close();
    return false;
  }
  alGetError();
  alGenSources(1, &handles_->source);
  alGenBuffers(1, &handles_->buffer);
  if (alGetError() != AL_NO_ERROR) {
    close();
    return false;
  }
  handles_->volume = static_cast<float>(volume);
  alSourcei(handles_->source, AL_SOURCE_RELATIVE, AL_TRUE);
  return true;
}

void AudioOutput::close() {
  if (handles_->source != 0) {
    alSourceStop(handles_->source);
    alDeleteSources(1, &handles_->source);
  }
  if (handles_->buffer != 0) alDeleteBuffers(1, &handles_->buffer);
  if (handles_->context != nullptr) {
    alcMakeContextCurrent(nullptr);
    alcDestroyContext(handles_->context);
  }
  if (handles_->device != nullptr) alcCloseDevice(handles_->device);
  *handles_ = Handles();
}

bool AudioOutput::is_open() const { return handles_->device != nullptr; }

bool AudioOutput::connected() const {
  if (!is_open()) return false;
  if (alcIsExtensionPresent(handles_->device, "ALC_EXT_disconnect") != ALC_TRUE) return true;
  ALCint connected = ALC_TRUE;
  alcGetIntegerv(handles_->device, ALC_CONNECTED, 1, &connected);
  return connected == ALC_TRUE;
}

std::string AudioOutput::name() const {
  if (!is_open()) return "";
  const bool all = alcIsExtensionPresent(nullptr, "ALC_ENUMERATE_ALL_EXT") == ALC_TRUE;
  const ALCchar* name =
      alcGetString(handles_->device, all ? ALC_ALL_DEVICES_SPECIFIER : ALC_DEVICE_SPECIFIER);
  return name == nullptr ? "" : name;
}

bool AudioOutput::play(const Sound& sound) {
  if (!is_open()) return false;
  stop();
  alGetError();
  alBufferData(handles_->buffer, AL_FORMAT_MONO16, sound.samples.data(),
               static_cast<ALsizei>(sound.samples.size() * sizeof(sound.samples[0])), sound.rate);
  alSourcei(handles_->source, AL_BUFFER, static_cast<ALint>(handles_->buffer));
  alSourcef(handles_->source, AL_GAIN, handles_->volume);
  alSourcePlay(handles_->source);
  return alGetError() == AL_NO_ERROR;
}

bool AudioOutput::playing() const {
  if (!is_open()) return false;
  ALint state = AL_STOPPED;
  alGetSourcei(handles_->source, AL_SOURCE_STATE, &state);
  return state == AL_PLAYING;
}

void AudioOutput::mute() {
  // The mixer ramps to the new gain over one period.
  if (is_open()) alSourcef(handles_->source, AL_GAIN, 0.0F);
}

void AudioOutput::stop() {
  if (!is_open()) return;
  alSourceStop(handles_->source);
  alSourcei(handles_->source, AL_BUFFER, 0);
}

}  // namespace navvi_feedback::devices
