#include "docent/interaction/speech/loudspeaker.h"

#include <signal.h>
#include <sys/wait.h>

#include <cerrno>

#include "docent/interaction/speech/child_process.h"

namespace docent::interaction {
namespace {

bool is_running(pid_t& child) {
  if (child != 0 && waitpid(child, nullptr, WNOHANG) != 0) child = 0;
  return child != 0;
}

void end(pid_t& child) {
  if (!is_running(child)) return;
  kill(child, SIGKILL);
  while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
  child = 0;
}

}  // namespace

Loudspeaker::~Loudspeaker() {
  end(line_);
  end(horn_);
}

Result<void> Loudspeaker::speak(const std::filesystem::path& file) {
  hush();
  return play(file, line_);
}

Result<void> Loudspeaker::honk(const std::filesystem::path& file) {
  if (is_running(horn_)) return {};
  return play(file, horn_);
}

void Loudspeaker::hush() { end(line_); }

Result<void> Loudspeaker::play(const std::filesystem::path& file, pid_t& child) const {
  if (program_.empty()) return {};
  const auto started = start_quietly({program_, file.string()});
  if (!started) return tl::unexpected<Error>(started.error());
  child = *started;
  return {};
}

}  // namespace docent::interaction
