#include "fuzz_replay.h"

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>

namespace docent {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> all_files(const std::vector<fs::path>& paths) {
  std::vector<fs::path> files;
  for (const fs::path& path : paths) {
    if (!fs::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    std::vector<fs::path> inside;
    for (const auto& entry : fs::directory_iterator{path})
      if (entry.is_regular_file()) inside.push_back(entry.path());
    std::sort(inside.begin(), inside.end());
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return files;
}

/// Up to four changes: a byte is another one, bytes are cut out, repeated, or the rest is gone.
void spoil(std::vector<std::uint8_t>& bytes, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
  const std::size_t changes = 1 + below(4);
  for (std::size_t i = 0; i < changes && !bytes.empty(); ++i) {
    const std::size_t at = below(bytes.size());
    const std::size_t length = 1 + below(std::min<std::size_t>(16, bytes.size() - at));
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    const auto end = begin + static_cast<std::ptrdiff_t>(length);
    switch (below(8)) {
      case 0:
        bytes.erase(begin, end);
        break;
      case 1: {
        const std::vector<std::uint8_t> again{begin, end};
        bytes.insert(begin, again.begin(), again.end());
        break;
      }
      case 2:
        bytes.resize(at);
        break;
      case 3:
        *begin = static_cast<std::uint8_t>("\x00\xff\x7f\x80\n\"-9"[below(8)]);
        break;
      default:
        *begin = static_cast<std::uint8_t>(random());
    }
  }
}

/// In the child: never returns.
[[noreturn]] void run_all(const Fuzzer& fuzzer, const std::vector<FuzzInput>& inputs, std::chrono::seconds patience,
                          std::size_t* at) {
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    *at = i;
    ::alarm(static_cast<unsigned>(patience.count()));
    fuzzer.run(inputs[i].bytes.data(), inputs[i].bytes.size());
  }
  std::exit(0);  // what a fuzzer has made is cleaned up
}

}  // namespace

std::vector<FuzzInput> fuzz_inputs(const std::vector<fs::path>& files, int spoiled) {
  std::vector<FuzzInput> inputs{{"the empty input", {}}};
  for (const fs::path& file : all_files(files)) {
    std::ifstream stream{file, std::ios::binary};
    if (!stream) std::abort();
    const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>{stream}, {}};
    const std::string name = (file.parent_path().filename() / file.filename()).string();
    inputs.push_back({name, bytes});
    std::mt19937 random{static_cast<std::mt19937::result_type>(bytes.size())};
    for (int i = 1; i <= spoiled; ++i) {
      inputs.push_back({name + ", spoiled " + std::to_string(i), bytes});
      spoil(inputs.back().bytes, random);
    }
  }
  return inputs;
}

FuzzReplay replay(const Fuzzer& fuzzer, const std::vector<FuzzInput>& inputs, std::chrono::seconds patience) {
  void* shared = ::mmap(nullptr, sizeof(std::size_t), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) std::abort();
  auto* at = static_cast<std::size_t*>(shared);
  const pid_t child = ::fork();
  if (child < 0) std::abort();
  if (child == 0) run_all(fuzzer, inputs, patience, at);
  int status = 0;
  ::waitpid(child, &status, 0);
  const std::size_t last = *at;
  ::munmap(shared, sizeof(std::size_t));
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {inputs.size(), "", {}};
  std::string how = "exit code " + std::to_string(WEXITSTATUS(status));
  if (WIFSIGNALED(status))
    how = WTERMSIG(status) == SIGALRM ? "not done after " + std::to_string(patience.count()) + " s"
                                      : std::string{::strsignal(WTERMSIG(status))};
  return {last + 1, how + " at " + inputs[last].name, inputs[last]};
}

}  // namespace docent
