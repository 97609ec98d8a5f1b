#include "docent/interaction/speech/renderer.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <thread>
#include <vector>

#include "docent/base/files.h"
#include "docent/base/random.h"
#include "docent/interaction/sound/sound_file.h"
#include "docent/interaction/speech/child_process.h"
#include "docent/interaction/speech/spoken_text.h"

namespace docent::interaction {
namespace {

constexpr std::uintmax_t kMostBytes = 32U << 20U;  ///< of a recording; the page fetches no larger ones
constexpr int kNice = 10;                          ///< of the program: a robot that drives comes first

/// espeak-ng's voices are named by language codes; anything else never reaches the command line.
bool is_language_code(const std::string& language) {
  return !language.empty() && language.size() <= 12 &&
         language.find_first_not_of("abcdefghijklmnopqrstuvwxyz-0123456789") == std::string::npos &&
         language.front() != '-';
}

/// Removes a file when it goes out of scope.
struct TemporaryFile {
  std::filesystem::path path;
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
};

/// Runs `arguments` with `input` as its standard input, its output thrown away. Returns its exit status.
Result<int> run(const std::vector<std::string>& arguments, const std::filesystem::path& input, double timeout_s,
                const std::atomic<bool>& stop) {
  const auto started = start_quietly(arguments, input);
  if (!started) return tl::unexpected(started.error());
  const pid_t child = *started;
  setpriority(PRIO_PROCESS, static_cast<id_t>(child), kNice);
  int status = 0;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout_s);
  while (true) {
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) break;
    if (ended < 0 && errno != EINTR) return fail(arguments[0] + ": lost its process");
    const bool is_late = std::chrono::steady_clock::now() > deadline;
    if (stop || is_late) {
      kill(child, SIGKILL);
      while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
      }
      return fail(arguments[0] + (is_late ? ": takes too long" : ": stopped"));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

std::string audio_file_name(const SpokenLine& line) {
  std::uint64_t hash = hash_of(line.language);
  hash = hash_of(std::string{"\n"} + to_text(line.mood) + "\n", hash);
  hash = hash_of(line.text, hash);
  char name[32];
  std::snprintf(name, sizeof name, "%016llx.wav", static_cast<unsigned long long>(hash));
  return name;
}

Result<RenderedLine> render_speech(const SpokenLine& line, const std::filesystem::path& folder,
                                   const std::string& program, double timeout_s, const std::atomic<bool>& stop) {
  if (!is_language_code(line.language)) return fail("'" + line.language + "' is no language code");
  const std::string name = audio_file_name(line);
  const std::filesystem::path whole = folder / name;
  if (const auto known = sound_duration(whole)) return RenderedLine{name, *known};

  std::error_code why;
  std::filesystem::create_directories(folder, why);
  if (why) return fail(folder.string() + ": " + why.message());
  const std::string unique = name + "." + std::to_string(getpid());
  const TemporaryFile input{folder / (unique + ".txt")};
  const TemporaryFile half{folder / (unique + ".part")};
  if (auto written = write_file_atomically(input.path, line.text); !written) return tl::unexpected(written.error());
  const Voice voice = voice_of(line.mood);
  const auto status = run({program, "-v", line.language, "-s", std::to_string(voice.words_per_minute), "-p",
                           std::to_string(voice.pitch), "-b", "1", "-w", half.path.string(), "--stdin"},
                          input.path, timeout_s, stop);
  if (!status) return tl::unexpected(status.error());
  if (*status != 0) return fail(program + ": failed with status " + std::to_string(*status));
  const auto duration = sound_duration(half.path);  // the status alone proves nothing
  if (!duration) return tl::unexpected(duration.error());
  std::filesystem::rename(half.path, whole, why);
  if (why) return fail(whole.string() + ": " + why.message());
  return RenderedLine{name, *duration};
}

Result<RenderedLine> take_recording(const std::filesystem::path& recording, const std::filesystem::path& folder) {
  std::error_code why;
  const auto size = std::filesystem::file_size(recording, why);
  if (why) return fail(recording.string() + ": " + why.message());
  if (size > kMostBytes) return fail(recording.string() + ": is larger than 32 MB");
  const auto duration = sound_duration(recording);
  if (!duration) return tl::unexpected(duration.error());
  const auto content = read_file(recording);
  if (!content) return tl::unexpected(content.error());
  const std::string name = shared_name(*content, recording);
  if (std::filesystem::exists(folder / name, why)) return RenderedLine{name, *duration};
  std::filesystem::create_directories(folder, why);
  if (why) return fail(folder.string() + ": " + why.message());
  if (auto written = write_file_atomically(folder / name, *content); !written) return tl::unexpected(written.error());
  return RenderedLine{name, *duration};
}

}  // namespace docent::interaction
