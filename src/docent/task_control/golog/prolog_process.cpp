#include "docent/task_control/golog/prolog_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <utility>

#include "docent/base/shipped_files.h"

extern char** environ;

namespace docent::task_control {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr int kLookAgain = 50;                          // [ms]
constexpr std::size_t kLongest = std::size_t{1} << 24;  // bytes of one answer
constexpr double kGrace = 60.0;  // [s] of the processor beyond an answer's: should nobody be left who watches

/// [s] of the processor that a process has used; 0 where it is gone.
double processor_s(pid_t pid) {
  clockid_t clock{};
  timespec used{};
  if (clock_getcpuclockid(pid, &clock) != 0 || clock_gettime(clock, &used) != 0) return 0.0;
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

/// It computes, or would if it had a processor.
bool is_running(pid_t pid) {
  std::ifstream file{"/proc/" + std::to_string(pid) + "/stat"};
  std::string text;
  std::getline(file, text);
  const auto name_end = text.rfind(')');
  return name_end != std::string::npos && name_end + 2 < text.size() && text[name_end + 2] == 'R';
}

Error ended(const std::string& how) { return {"the program's Prolog " + how}; }

std::string how_it_ended(int status) {
  if (WIFEXITED(status)) {
    if (WEXITSTATUS(status) == 127) return "cannot be started: is the package swi-prolog-core installed?";
    return "was ended by the program itself (halt, exit status " + std::to_string(WEXITSTATUS(status)) + ")";
  }
  const int number = WTERMSIG(status);
  const std::string name = sigabbrev_np(number) == nullptr ? std::to_string(number) : sigabbrev_np(number);
  return "broke down (SIG" + name + ")" +
         (number == SIGABRT || number == SIGSEGV ? ": perhaps no memory was left" : "");
}

}  // namespace

/// How long an answer is still waited for. Who computes pays by the processor's clock, who sleeps by the wall's, and
/// who waits for a processor nothing: a loaded computer is no fault of the program.
class PrologProcess::Patience {
 public:
  Patience(pid_t pid, double seconds) : pid_{pid}, left_{seconds}, used_{processor_s(pid)} {}

  [[nodiscard]] bool is_over() {
    const auto now = Clock::now();
    const double used = processor_s(pid_);
    const double asleep = is_running(pid_) ? 0.0 : Seconds{now - looked_}.count();
    left_ -= std::max(used - used_, asleep);
    used_ = used;
    looked_ = now;
    return left_ < 0.0;
  }
  /// We were at work ourselves.
  void rest() { looked_ = Clock::now(); }

 private:
  pid_t pid_;
  double left_;
  double used_;
  Clock::time_point looked_ = Clock::now();
};

Result<std::unique_ptr<PrologProcess>> PrologProcess::start(const PrologLimits& limits) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    return fail(std::string{"no line to Prolog: "} + std::strerror(errno));
  // Without init files, packs and a terminal, and without signal handlers: a program's steps depend on nothing but
  // what they are given.
  std::array<std::string, 17> words{"swipl",
                                    "-q",
                                    "-f",
                                    "none",
                                    "-F",
                                    "none",
                                    "-t",
                                    "halt(3)",
                                    "--no-tty",
                                    "--no-packs",
                                    "--no-debug",
                                    "--no-signals",
                                    "--stack-limit=64m",
                                    "-g",
                                    "golog_host:serve",
                                    "-s",
                                    shipped_path("prolog/host.pl").string()};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, ends[1], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
  posix_spawnattr_t how;
  posix_spawnattr_init(&how);
  sigset_t none;
  sigset_t all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&how, &none);
  posix_spawnattr_setsigdefault(&how, &all);
  posix_spawnattr_setpgroup(&how, 0);  // the terminal's Ctrl-C is for us
  posix_spawnattr_setflags(&how, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  pid_t pid = 0;
  const int fault = posix_spawnp(&pid, arguments[0], &files, &how, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&how);
  close(ends[1]);
  if (fault != 0) {
    close(ends[0]);
    return fail(std::string{"swipl cannot be started: "} + std::strerror(fault) +
                "; is the package swi-prolog-core installed?");
  }
  const timeval patience{static_cast<time_t>(std::ceil(limits.answer_s)), 0};
  setsockopt(ends[0], SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  const auto bytes = static_cast<rlim_t>(limits.memory_mb) << 20U;
  const rlimit memory{bytes, bytes};
  const rlimit no_core{0, 0};
  prlimit(pid, RLIMIT_AS, &memory, nullptr);
  prlimit(pid, RLIMIT_CORE, &no_core, nullptr);
  return std::unique_ptr<PrologProcess>{new PrologProcess{pid, ends[0], limits}};
}

PrologProcess::~PrologProcess() {
  if (is_alive()) static_cast<void>(end("is not needed any more"));
}

Error PrologProcess::end(const std::string& why) {
  close(line_);
  int status = 0;
  // What ends by itself is a zombie in a moment, and tells how.
  for (int i = 0; why.empty() && i < 100; ++i) {
    if (waitpid(pid_, &status, WNOHANG) == pid_) {
      pid_ = 0;
      return ended(how_it_ended(status));
    }
    usleep(10'000);
  }
  kill(pid_, SIGKILL);
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = 0;
  return ended(why.empty() ? "has closed the line to it" : why);
}

Result<void> PrologProcess::send(const std::string& text) {
  std::size_t sent = 0;
  while (sent < text.size()) {
    const auto count = ::send(line_, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return tl::unexpected(end("does not listen"));
    if (count < 0) return tl::unexpected(end(""));
    sent += static_cast<std::size_t>(count);
  }
  return {};
}

Result<PrologValue> PrologProcess::receive(Patience& patience) {
  while (true) {
    auto value = take_value(read_);
    if (!value) return tl::unexpected(end("says what is no value"));
    if (*value) return std::move(**value);
    if (read_.size() > kLongest) return tl::unexpected(end("says more than 16 MB at once"));
    pollfd line{line_, POLLIN, 0};
    const int ready = poll(&line, 1, kLookAgain);
    if (ready == 0 && patience.is_over()) {
      std::array<char, 80> why{};
      std::snprintf(why.data(), why.size(), "gave no answer for %g s: the program does not come to an end",
                    limits_.answer_s);
      return tl::unexpected(end(why.data()));
    }
    if (ready <= 0) continue;
    std::array<char, 65536> bytes;
    const auto count = read(line_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return tl::unexpected(end(""));
    read_.append(bytes.data(), static_cast<std::size_t>(count));
  }
}

Result<PrologValue> PrologProcess::ask(const std::string& question, const PrologQuestions& back) {
  if (!is_alive()) return tl::unexpected(ended("is over"));
  const auto most = static_cast<rlim_t>(processor_s(pid_) + limits_.answer_s + kGrace);
  const rlimit processor{most, RLIM_INFINITY};
  prlimit(pid_, RLIMIT_CPU, &processor, nullptr);
  Patience patience{pid_, limits_.answer_s};
  if (auto sent = send(question + ".\n"); !sent) return tl::unexpected(sent.error());
  while (true) {
    auto said = receive(patience);
    if (!said) return said;
    const std::string kind = said->at(0) != nullptr && said->at(0)->text() != nullptr ? *said->at(0)->text() : "";
    const PrologValue* first = said->at(1);
    if (kind == "found" && first != nullptr) return *first;
    if (kind == "fault" && first != nullptr && first->text() != nullptr) return fail(*first->text());
    const PrologValue* second = said->at(2);
    if (first == nullptr || first->text() == nullptr || second == nullptr)
      return tl::unexpected(end("says what nobody understands"));
    std::string answer = "none";
    if (kind == "travel" && second->text() != nullptr) {
      if (const auto metres = back.travel(*first->text(), *second->text()))
        answer = "some(" + prolog_number(*metres) + ")";
    } else if (kind == "order") {
      if (const auto order = back.order(*first->text(), texts_of(*second)))
        answer = "some(" + prolog_atoms(*order) + ")";
    }
    if (auto sent = send(answer + ".\n"); !sent) return tl::unexpected(sent.error());
    patience.rest();
  }
}

}  // namespace docent::task_control
