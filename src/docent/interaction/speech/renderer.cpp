#include "docent/interaction/speech/renderer.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <thread>
#include <vector>

#include "docent/base/files.h"
#include "docent/base/random.h"
#include "docent/interaction/speech/child_process.h"
#include "docent/interaction/speech/spoken_text.h"

namespace docent::interaction {
namespace {

int volume_step(double volume) { return static_cast<int>(std::lround(std::clamp(volume, 0.0, 1.0) * 10.0)); }

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

std::uint32_t little_endian(const char* bytes, int count) {
  std::uint32_t value = 0;
  for (int i = count - 1; i >= 0; --i) value = value << 8U | static_cast<unsigned char>(bytes[i]);
  return value;
}

}  // namespace

std::string audio_file_name(const SpokenLine& line) {
  std::uint64_t hash = hash_of(line.language);
  hash = hash_of(std::string{"\n"} + to_text(line.mood) + "\n", hash);
  hash = hash_of(std::to_string(volume_step(line.volume)) + "\n", hash);
  hash = hash_of(line.text, hash);
  char name[32];
  std::snprintf(name, sizeof name, "%016llx.wav", static_cast<unsigned long long>(hash));
  return name;
}

Result<double> wav_duration(const std::filesystem::path& path) {
  std::ifstream file{path, std::ios::binary};
  char head[12];
  if (!file.read(head, sizeof head)) return fail(path.string() + ": cannot be read");
  if (std::memcmp(head, "RIFF", 4) != 0 || std::memcmp(head + 8, "WAVE", 4) != 0)
    return fail(path.string() + ": is no WAV file");
  double bytes_per_second = 0.0;
  char chunk[8];
  while (file.read(chunk, sizeof chunk)) {
    const std::uint32_t size = little_endian(chunk + 4, 4);
    if (std::memcmp(chunk, "fmt ", 4) == 0) {
      char format[16];
      if (size < sizeof format || !file.read(format, sizeof format)) break;
      bytes_per_second = little_endian(format + 8, 4);
      file.seekg(size - sizeof format + (size & 1U), std::ios::cur);
    } else if (std::memcmp(chunk, "data", 4) == 0) {
      if (!(bytes_per_second > 0.0)) break;
      // The size of a streamed file is unknown to its writer: believe the file's end then.
      const auto begin = file.tellg();
      file.seekg(0, std::ios::end);
      const double held = static_cast<double>(file.tellg() - begin);
      return std::min(static_cast<double>(size), held) / bytes_per_second;
    } else {
      file.seekg(size + (size & 1U), std::ios::cur);
    }
  }
  return fail(path.string() + ": has no samples");
}

Result<RenderedLine> render_speech(const SpokenLine& line, const std::filesystem::path& folder,
                                   const std::string& program, double timeout_s, const std::atomic<bool>& stop) {
  if (!is_language_code(line.language)) return fail("'" + line.language + "' is no language code");
  const std::string name = audio_file_name(line);
  const std::filesystem::path whole = folder / name;
  if (const auto known = wav_duration(whole)) return RenderedLine{name, *known};

  std::error_code why;
  std::filesystem::create_directories(folder, why);
  if (why) return fail(folder.string() + ": " + why.message());
  const std::string unique = name + "." + std::to_string(getpid());
  const TemporaryFile input{folder / (unique + ".txt")};
  const TemporaryFile half{folder / (unique + ".part")};
  if (auto written = write_file_atomically(input.path, line.text); !written) return tl::unexpected(written.error());
  const Voice voice = voice_of(line.mood);
  const auto status = run(
      {program, "-v", line.language, "-s", std::to_string(voice.words_per_minute), "-p", std::to_string(voice.pitch),
       "-a", std::to_string(volume_step(line.volume) * 10), "-b", "1", "-w", half.path.string(), "--stdin"},
      input.path, timeout_s, stop);
  if (!status) return tl::unexpected(status.error());
  if (*status != 0) return fail(program + ": failed with status " + std::to_string(*status));
  const auto duration = wav_duration(half.path);  // the status alone proves nothing
  if (!duration) return tl::unexpected(duration.error());
  std::filesystem::rename(half.path, whole, why);
  if (why) return fail(whole.string() + ": " + why.message());
  return RenderedLine{name, *duration};
}

}  // namespace docent::interaction
