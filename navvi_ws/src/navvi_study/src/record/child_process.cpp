#include "record/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <exception>
#include <iostream>
#include <map>
#include <vector>

#include "record/files.hpp"

namespace navvi_study::record {
namespace {

int answer_into(int pipe, const std::function<std::string()>& work) {
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  std::string answer;
  int code = 0;
  try {
    answer = work();
  } catch (const std::exception& error) {
    answer = error.what();
    code = 2;
  }
  std::string_view rest = answer;
  return write_all(pipe, rest, SystemCalls::real()) == 0 ? code : 2;
}

struct Child {
  pid_t id = -1;
  int pipe = -1;  // -1: has answered, or was never there
  Answer answer;
};

Child start(const std::function<std::string()>& work) {
  Child child;
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    child.answer.text = "no pipe can be opened";
    return child;
  }
  std::cout.flush();
  std::fflush(nullptr);  // or the child would write out what waits here once more
  child.id = ::fork();
  if (child.id == 0) {
    ::close(ends[0]);
    ::_exit(answer_into(ends[1], work));
  }
  ::close(ends[1]);
  child.pipe = ends[0];
  if (child.id < 0) {
    ::close(child.pipe);
    child.pipe = -1;
    child.answer.text = "no process can be started";
  }
  return child;
}

/// Takes what has come; at the end of it, the child's last word.
void take(Child& child, const std::string& crashed) {
  char buffer[4096];
  const ssize_t count = ::read(child.pipe, buffer, sizeof buffer);
  if (count > 0) {
    child.answer.text.append(buffer, static_cast<std::size_t>(count));
    return;
  }
  if (count < 0 && errno == EINTR) return;
  ::close(child.pipe);
  child.pipe = -1;
  int status = 0;
  while (::waitpid(child.id, &status, 0) < 0 && errno == EINTR) continue;
  child.answer.good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (!WIFEXITED(status)) child.answer.text = crashed;
}

/// Waits until one of the children says something.
void listen(std::map<std::size_t, Child>& children, const std::string& crashed) {
  std::vector<pollfd> pipes;
  std::vector<Child*> speakers;
  for (auto& [index, child] : children) {
    if (child.pipe < 0) continue;
    pipes.push_back({child.pipe, POLLIN, 0});
    speakers.push_back(&child);
  }
  if (pipes.empty() || ::poll(pipes.data(), pipes.size(), -1) <= 0) return;
  for (std::size_t i = 0; i < pipes.size(); ++i)
    if (pipes[i].revents != 0) take(*speakers[i], crashed);
}

}  // namespace

void ask_children(std::size_t count, std::size_t at_once,
                  const std::function<std::string(std::size_t)>& work, const std::string& crashed,
                  const std::function<void(std::size_t, const Answer&)>& answered) {
  std::map<std::size_t, Child> children;  // whose answers have not been handed over
  std::size_t started = 0;
  for (std::size_t next = 0; next < count;) {
    std::size_t busy = 0;
    for (const auto& [index, child] : children) busy += child.pipe >= 0 ? 1 : 0;
    for (; started < count && busy < at_once; ++started, ++busy)
      children[started] = start([&work, started] { return work(started); });
    listen(children, crashed);
    for (auto first = children.find(next); first != children.end() && first->second.pipe < 0;
         first = children.find(next)) {
      answered(next++, first->second.answer);
      children.erase(first);
    }
  }
}

Answer ask_child(const std::function<std::string()>& work, const std::string& crashed) {
  Answer out;
  ask_children(
      1, 1, [&work](std::size_t) { return work(); }, crashed,
      [&out](std::size_t, const Answer& answer) { out = answer; });
  return out;
}

}  // namespace navvi_study::record
