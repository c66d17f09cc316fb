#include "node/settings.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <ros/init.h>
#include <ros/master.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <future>

#include "temp_folder.hpp"

namespace navvi_feedback::node {
namespace {

/// A master that takes calls and answers none.
class SilentMaster {
 public:
  SilentMaster() : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const any = reinterpret_cast<sockaddr*>(&address);
    EXPECT_EQ(::bind(socket_, any, size) | ::listen(socket_, 10), 0);
    ::getsockname(socket_, any, &size);
    const std::string uri = "http://127.0.0.1:" + std::to_string(ntohs(address.sin_port));
    ros::init(ros::M_string{{"__master", uri}}, "settings_test",
              ros::init_options::NoSigintHandler);
    ros::master::setRetryTimeout(ros::WallDuration(0.5));
    std::signal(SIGPIPE, SIG_DFL);  // which roscpp ignores
  }
  ~SilentMaster() { end(); }
  SilentMaster(const SilentMaster&) = delete;
  SilentMaster& operator=(const SilentMaster&) = delete;
  void end() {
    if (socket_ >= 0) ::close(std::exchange(socket_, -1));
  }

 private:
  int socket_;
};

TEST(Settings, M1_are_in_force_at_once_where_no_master_answers) {
  using namespace std::chrono_literals;
  SilentMaster master;
  NodeConfig config;
  Settings settings(config);
  std::vector<Content> failures;
  auto changed = std::async(std::launch::async, [&] {
    for (const char* word : {"speaker/rate:=240", "speaker/rate:=260", "lead:=words"}) {
      settings.change(word);
      for (const Content& failure : settings.failures()) failures.push_back(failure);
    }
    for (const Content& failure : settings.finish()) failures.push_back(failure);
  });
  EXPECT_EQ(changed.wait_for(5s), std::future_status::ready);
  master.end();
  changed.get();
  EXPECT_EQ(config.speaker.rate, 260);
  EXPECT_EQ(config.feedback->lead, "words");
  EXPECT_EQ(failures, std::vector<Content>(1, {CueKind::settings, About::not_kept}));
  EXPECT_TRUE(settings.saved()) << "no lesson found them";
}

TEST(Settings, that_a_lesson_found_and_cannot_be_saved_are_told_of) {
  const navvi_test::TempFolder home;
  setenv("NAVVI_PEOPLE", home.write("people", "a file where the folder should be").c_str(), 1);
  NodeConfig config;
  config.person = "anna";
  Settings settings(config);
  core::Output told;
  told.settings = {"sounds/turn/stopping_delay:=0.4"};
  settings.keep(told);
  settings.keep(told);
  EXPECT_TRUE(settings.saved());
  EXPECT_EQ(settings.finish(), std::vector<Content>(1, {CueKind::settings, About::not_saved}));
  EXPECT_FALSE(settings.saved());
}

}  // namespace
}  // namespace navvi_feedback::node
