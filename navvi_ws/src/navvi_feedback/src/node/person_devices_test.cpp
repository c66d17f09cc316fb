#include "node/person_devices.hpp"

#include <SDL.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <functional>

#include "cues/phrases.hpp"
#include "heard.hpp"
#include "virtual_pad.hpp"

namespace navvi_feedback::node {
namespace {

/// s
double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool eventually(const std::function<bool()>& condition) {
  for (const double end = now() + 10.0; now() < end; devices::pause(0.01))
    if (condition()) return true;
  return false;
}

NodeConfig config_of(const std::string& input) {
  NodeConfig config;
  config.phrases = NAVVI_FEEDBACK_CONFIG_DIR "/phrases/en.yaml";
  config.input = input;
  return config;
}

TEST(PersonDevices, J2_a_pad_whose_link_is_silent_has_no_motors_that_are_felt) {
  SDL_SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");
  ASSERT_EQ(SDL_InitSubSystem(SDL_INIT_GAMECONTROLLER), 0) << SDL_GetError();
  {
    devices::StreamingPad streaming;
    PersonDevices person(config_of("pad"));
    ASSERT_TRUE(eventually([&] { return person.pad()->heartbeat; }));
    EXPECT_TRUE(person.read(now()).felt);
    EXPECT_TRUE(person.read(now()).motors);
    streaming.frozen = true;
    EXPECT_TRUE(eventually([&] { return !person.read(now()).felt; }));
    EXPECT_FALSE(person.read(now()).motors);
  }
  SDL_QuitSubSystem(SDL_INIT_GAMECONTROLLER);
}

#ifndef __SANITIZE_ADDRESS__  // which opens files, too
TEST(PersonDevices, F4_words_that_no_voice_says_are_not_recorded_as_heard) {
  const NodeConfig config = config_of("topic");
  PersonDevices person(config);
  core::Guide guide(config.feedback, cues::Phrases(config.phrases));
  std::vector<CueStage> stages;
  /// Whether these words came to an end, heard or not.
  const auto are_over = [&] {
    const auto told = guide.update(person.read(now()), now());
    if (!told) return false;
    static_cast<void>(person.obey(*told));
    for (const CueEvent& event : told->said) stages.push_back(event.stage);
    return !stages.empty() && stages.back() != CueStage::queued &&
           stages.back() != CueStage::started;
  };
  const pid_t voice = devices::voices().at(0);
  rlimit files{};
  ::getrlimit(RLIMIT_NOFILE, &files);
  const rlimit none{3, files.rlim_max};
  ::setrlimit(RLIMIT_NOFILE, &none);  // no process can be started
  ::kill(voice, SIGKILL);
  for (const auto about : {About::machine_slow, About::intruder}) {
    stages.clear();
    guide.announce({CueKind::notice, about});
    EXPECT_TRUE(eventually(are_over));
    EXPECT_EQ(std::count(stages.begin(), stages.end(), CueStage::ended), 0);
  }
  ::setrlimit(RLIMIT_NOFILE, &files);
  EXPECT_EQ(std::count(stages.begin(), stages.end(), CueStage::started), 0) << "of the second";
}
#endif

}  // namespace
}  // namespace navvi_feedback::node
