#include "trial/bag_watch.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

namespace navvi_study::trial {
namespace fs = std::filesystem;

BagRecorder::BagRecorder(const fs::path& bag, const std::string& node_name,
                         const std::vector<std::string>& topics,
                         const std::vector<std::string>& program, double patience)
    : bag_(bag), patience_(patience) {
  // Small chunks lose little when the recorder is killed; the default min-space leaves an empty bag
  // and success behind.
  std::vector<std::string> words = program;
  words.insert(words.end(), {"-q", "-O", bag.string(), "--chunksize=64", "--min-space=50M",
                             "--tcpnodelay", "--bz2"});
  words.insert(words.end(), topics.begin(), topics.end());
  words.push_back("__name:=" + node_name);
  std::vector<char*> arguments;
  for (auto& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t parent = ::getpid();
  child_ = ::fork();
  if (child_ != 0) return;
  // A group of its own: the signal that ends the session must reach this process first.
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGINT);
  if (::getppid() != parent) ::_exit(1);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::signal(SIGINT, SIG_DFL);
  ::signal(SIGTERM, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_RDWR);  // it lists its topics in spite of -q
  ::dup2(nowhere, STDOUT_FILENO);
  ::execv(arguments[0], arguments.data());
  ::_exit(127);
}

BagRecorder::~BagRecorder() {
  if (!running()) return;
  stop();
  for (int i = 0; i < 100 && running(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  if (!running()) return;
  kill();
  ::waitpid(child_, nullptr, 0);
}

bool BagRecorder::running() {
  if (child_ <= 0) return false;
  const pid_t ended = ::waitpid(child_, &status_, WNOHANG);
  if (ended == 0) return true;
  child_ = -1;
  return false;
}

bool BagRecorder::halted() const {
  std::ifstream file("/proc/" + std::to_string(child_) + "/stat");
  std::string words;
  std::getline(file, words);
  const auto name = words.rfind(')');  // the program's; the state's letter follows
  return child_ > 0 && name != words.npos && words.compare(name, 3, ") T") == 0;
}

std::uintmax_t BagRecorder::size() const {
  std::error_code error;
  for (const auto& path : {fs::path(bag_.string() + ".active"), bag_}) {
    const auto size = fs::file_size(path, error);
    if (!error) return size;
  }
  return 0;
}

void BagRecorder::stop() {
  asked_ = true;
  if (child_ > 0) ::kill(child_, SIGINT);
}

void BagRecorder::kill() {
  if (child_ > 0) ::kill(child_, SIGKILL);
}

bool BagRecorder::closed_well() {
  constexpr std::uintmax_t kEmptyBag = 4117;  // bytes, a bag's header alone
  std::error_code error;
  return !running() && asked_ && WIFEXITED(status_) && WEXITSTATUS(status_) == 0 &&
         fs::exists(bag_, error) && fs::file_size(bag_, error) > kEmptyBag;
}

void BagWatch::hears(double time) {
  listens_ = true;
  begun_ = time;
}

bool BagWatch::ready(double time) {
  // s, for the recorder to listen: it asks the master for each topic in turn, which may be far
  constexpr double kStart = 60.0;
  constexpr double kSettle = 0.5;  // s, for links to come up before the first event
  if (recorder_ && !bad_) {
    if (!recorder_->running() || (!listens_ && time - begun_ > kStart)) {
      bad_ = true;
    } else if (!listens_) {
      return false;
    }
  }
  return time - begun_ >= kSettle;
}

bool BagWatch::growing(double time) {
  constexpr double kStill = 10.0;  // s, without growth; a compressed bag grows by whole chunks
  constexpr double kHalted = 2.0;  // s, in which a recorder may be stopped by a signal
  if (!recorder_ || bad_) return !bad_;
  const auto size = recorder_->size();
  if (size > size_) {
    size_ = size;
    grew_ = time;
  }
  if (!recorder_->halted()) went_on_ = time;
  bad_ = !recorder_->running() || time - grew_ >= kStill || time - went_on_ >= kHalted;
  return !bad_;
}

bool BagWatch::close(double age, double tail) {
  constexpr double kLongest = 120.0;  // s
  if (!recorder_ || !recorder_->running()) return true;
  if (age >= tail) recorder_->stop();
  // One that still writes what it holds is waited for: on a busy machine it compresses for long.
  if (const auto size = recorder_->size(); age < tail || size > size_) {
    size_ = size;
    wrote_ = age;
  }
  if (age > wrote_ + recorder_->patience() || age > tail + kLongest) recorder_->kill();
  return false;
}

void BagWatch::kill() {
  if (recorder_) recorder_->kill();
}

std::string BagWatch::verdict() {
  if (!recorder_) return "none";
  return recorder_->closed_well() && !bad_ ? "ok" : "bad";
}

}  // namespace navvi_study::trial
