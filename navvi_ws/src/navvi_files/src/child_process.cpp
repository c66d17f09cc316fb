#include "navvi_files/child_process.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <map>
#include <memory>

#include "navvi_files/files.hpp"

namespace navvi_files {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
/// A file without a name, which a child fills with its answer.
using AnswerFile = std::unique_ptr<std::FILE, CloseFile>;

/// \return the exit code
int answer_into(std::FILE* file, const std::function<std::string()>& work) {
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
  return write_all(::fileno(file), rest, SystemCalls::real()) == 0 ? code : 2;
}

/// \return the child's id, or -1
pid_t start(const std::function<std::string()>& work, std::FILE* file) {
  std::cout.flush();
  std::fflush(nullptr);  // or the child would write out once more what waits here
  const pid_t id = file == nullptr ? -1 : ::fork();
  if (id == 0) ::_exit(answer_into(file, work));
  return id;
}

/// \param status  of the child, as waitpid() gives it
Answer read_answer(std::FILE* file, int status, const std::string& crashed) {
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (code != 0 && code != 2) return {false, crashed};  // also where a library ends the process
  Answer answer{code == 0, ""};
  std::rewind(file);
  std::array<char, 4096> buffer{};
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file))
    answer.text.append(buffer.data(), count);
  return answer;
}

}  // namespace

void run_in_children(std::size_t count, std::size_t at_once,
                     const std::function<std::string(std::size_t)>& work,
                     const std::string& crashed,
                     const std::function<void(std::size_t, const Answer&)>& answered) {
  std::signal(SIGCHLD, SIG_DFL);  // where it was ignored, no child could be waited for
  std::map<pid_t, std::pair<std::size_t, AnswerFile>> running;
  std::map<std::size_t, Answer> finished;  // that wait for an answer before theirs
  std::size_t started = 0;
  for (std::size_t next = 0; next < count;) {
    if (started < count && running.size() < at_once) {
      AnswerFile file(std::tmpfile());
      const pid_t id = start([&] { return work(started); }, file.get());
      if (id < 0)
        finished[started] = {false, "no process can be started"};
      else
        running[id] = {started, std::move(file)};
      ++started;
    } else {
      int status = 0;
      const pid_t any = running.size() == 1 ? running.begin()->first : -1;
      const auto child = running.find(::waitpid(any, &status, 0));
      if (child == running.end()) continue;  // a signal came
      const auto& [index, file] = child->second;
      finished[index] = read_answer(file.get(), status, crashed);
      running.erase(child);
    }
    for (; finished.count(next) > 0; ++next) {
      answered(next, finished[next]);
      finished.erase(next);
    }
  }
}

Answer run_in_child(const std::function<std::string()>& work, const std::string& crashed) {
  Answer out;
  run_in_children(
      1, 1, [&work](std::size_t) { return work(); }, crashed,
      [&out](std::size_t, const Answer& answer) { out = answer; });
  return out;
}

}  // namespace navvi_files
