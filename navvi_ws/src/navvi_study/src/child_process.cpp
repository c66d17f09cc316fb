#include "navvi_study/child_process.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <exception>

#include "navvi_study/files.hpp"

namespace navvi_study {
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

}  // namespace

Answer ask_child(const std::function<std::string()>& work, const std::string& crashed) {
  int ends[2];
  if (::pipe(ends) != 0) return {false, "no pipe can be opened"};
  const pid_t child = ::fork();
  if (child < 0) return {false, "no process can be started"};
  if (child == 0) {
    ::close(ends[0]);
    ::_exit(answer_into(ends[1], work));
  }
  ::close(ends[1]);
  Answer answer;
  char buffer[4096];
  for (ssize_t n = 0; (n = ::read(ends[0], buffer, sizeof buffer)) > 0;) {
    answer.text.append(buffer, static_cast<std::size_t>(n));
  }
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  answer.good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (!WIFEXITED(status)) answer.text = crashed;
  return answer;
}

}  // namespace navvi_study
