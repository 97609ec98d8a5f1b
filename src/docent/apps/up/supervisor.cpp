#include "docent/apps/up/supervisor.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <thread>

namespace docent::apps::up_command {
namespace {

constexpr std::chrono::seconds kOrderlyEnd{3};  // for a child that shall start again

/// In the child, between fork and exec: only what is safe there.
[[noreturn]] void become(const std::vector<char*>& arguments, int output, int niceness, pid_t parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);  // it died before the line above
  // A process that may not raise its priority keeps that of the others.
  if (niceness != 0) static_cast<void>(setpriority(PRIO_PROCESS, 0, niceness));
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  signal(SIGPIPE, SIG_DFL);
  execv(arguments[0], arguments.data());
  _exit(127);
}

std::string describe_end(int status) {
  if (WIFSIGNALED(status)) return "signal " + std::to_string(WTERMSIG(status));
  return "exit code " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

Supervisor::Supervisor(std::vector<ChildSpec> children, Log log, LifecycleParams params)
    : log_{std::move(log)}, params_{params} {
  for (auto& spec : children) children_.push_back(child_of(std::move(spec)));
}

Supervisor::Child Supervisor::child_of(ChildSpec spec) const {
  const bool has_health = spec.has_health;
  return {std::move(spec), Lifecycle{has_health, params_}, 0, -1, {}, {}, {}, false};
}

Supervisor::~Supervisor() { stop(); }

void Supervisor::start(Child& child) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    log_(From::supervisor, child.spec.name, std::string{"cannot start: "} + std::strerror(errno));
    return;
  }
  // A supervisor that is stopped must not stop its children: what does not fit into the pipe is lost.
  for (const int end : ends) fcntl(end, F_SETFL, O_NONBLOCK);
  std::vector<char*> arguments;
  for (auto& argument : child.spec.command) arguments.push_back(argument.data());
  arguments.push_back(nullptr);
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid == 0) become(arguments, ends[1], child.spec.niceness, parent);
  close(ends[1]);
  const auto now = Clock::now();
  child.life.started(now);
  if (pid < 0) {
    close(ends[0]);
    child.life.ended(now, std::strerror(errno));
    return;
  }
  setpgid(pid, pid);  // here as well, so that it is done whoever comes first
  child.pid = pid;
  child.output = ends[0];
  child.last_line.clear();
}

void Supervisor::read_output(Child& child) {
  if (child.output < 0) return;
  std::array<char, 4096> buffer{};
  for (;;) {
    const ssize_t count = read(child.output, buffer.data(), buffer.size());
    if (count <= 0) return;
    child.partial_line.append(buffer.data(), static_cast<std::size_t>(count));
    for (auto end = child.partial_line.find('\n'); end != std::string::npos; end = child.partial_line.find('\n')) {
      child.last_line = child.partial_line.substr(0, end);
      child.partial_line.erase(0, end + 1);
      if (!fatal_) log_(From::child, child.spec.name, child.last_line);
    }
    constexpr std::size_t kLongestLine = 65536;
    if (child.partial_line.size() > kLongestLine) child.partial_line.clear();
  }
}

std::optional<std::string> Supervisor::reap(Child& child) {
  siginfo_t info{};
  if (child.pid <= 0 || waitid(P_PID, static_cast<id_t>(child.pid), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
      info.si_pid != child.pid) {
    return std::nullopt;
  }
  signal_group(child, SIGKILL);  // what it has started itself, while its number is still its own
  int status = 0;
  waitpid(child.pid, &status, 0);
  read_output(child);
  close(child.output);
  child.output = -1;
  child.pid = 0;
  const std::string how = child.retires       ? "is not needed now"
                          : child.told_to_end ? "begins anew"
                                              : describe_end(status);
  child.life.ended(Clock::now(), how);
  return how;
}

void Supervisor::collect(Child& child) {
  const auto how = reap(child);
  if (!how) return;
  if (child.life.starts() == 1 && *how == "exit code " + std::to_string(kExitBadConfiguration)) {
    if (!fatal_) fatal_ = child.last_line.empty() ? child.spec.name + " cannot start" : child.last_line;
  } else if (!child.told_to_end) {
    log_(From::supervisor, child.spec.name, child.life.status(Clock::now()));
  }
}

void Supervisor::tell_to_end(Child& child) {
  if (child.pid <= 0) return;  // it takes its command when it starts
  child.told_to_end = Clock::now();
  signal_group(child, SIGTERM);
  signal_group(child, SIGCONT);
}

void Supervisor::replace(const std::vector<ChildSpec>& children, const std::string& kept) {
  for (auto& child : children_) {
    if (child.spec.name == kept) continue;
    const auto wanted =
        std::find_if(children.begin(), children.end(), [&](const auto& spec) { return spec.name == child.spec.name; });
    child.retires = wanted == children.end();
    if (!child.retires) child.spec = *wanted;
    tell_to_end(child);
  }
  for (const ChildSpec& spec : children) {
    const bool is_there = std::any_of(children_.begin(), children_.end(),
                                      [&](const Child& child) { return child.spec.name == spec.name; });
    if (!is_there) children_.push_back(child_of(spec));
  }
}

void Supervisor::step() {
  std::erase_if(children_, [](const Child& child) { return child.retires && child.pid <= 0; });
  for (auto& child : children_) {
    read_output(child);
    collect(child);
    if (fatal_) continue;
    if (child.told_to_end) {
      if (child.pid > 0) {
        if (Clock::now() - *child.told_to_end > kOrderlyEnd) signal_group(child, SIGKILL);
        continue;
      }
      child.told_to_end.reset();
      if (!child.retires) start(child);
      continue;
    }
    switch (child.life.next(Clock::now())) {
      case Lifecycle::Step::wait:
        break;
      case Lifecycle::Step::start:
        start(child);
        break;
      case Lifecycle::Step::kill:
        log_(From::supervisor, child.spec.name, "does not respond: killed");
        signal_group(child, SIGKILL);
        child.life.killed(Clock::now());
        break;
    }
  }
}

void Supervisor::heard(const std::string& name, pid_t pid, const std::string& state, const std::string& reason) {
  for (auto& child : children_) {
    // The pid tells our child from a namesake that someone else runs in this domain.
    if (child.spec.name == name && child.pid == pid) child.life.heard(Clock::now(), state, reason);
  }
}

void Supervisor::signal_group(const Child& child, int number) const {
  if (child.pid > 0) kill(-child.pid, number);
}

void Supervisor::stop(double patience_s) {
  for (const auto& child : children_) {
    signal_group(child, SIGTERM);
    signal_group(child, SIGCONT);  // also a stopped one shall hear it
  }
  const auto end = Clock::now() + std::chrono::duration<double>(patience_s);
  bool is_killed = false;
  for (;;) {
    bool is_any_left = false;
    for (auto& child : children_) {
      read_output(child);
      if (!reap(child) && child.pid > 0) is_any_left = true;
    }
    if (!is_any_left) return;
    if (!is_killed && Clock::now() > end) {
      is_killed = true;
      for (const auto& child : children_) signal_group(child, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds{10});
  }
}

std::vector<Supervisor::Status> Supervisor::status() const {
  std::vector<Status> all;
  for (const auto& child : children_) {
    all.push_back({child.spec.name, child.life.status(Clock::now()), child.pid, std::max(0, child.life.starts() - 1)});
  }
  return all;
}

}  // namespace docent::apps::up_command
