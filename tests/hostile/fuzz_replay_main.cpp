#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>

#include "fuzz_replay.h"
#include "fuzzers.h"

// docent_fuzz_replay CORPUS KEEP [NAME=FILE]...: gives each fuzzer the seeds in CORPUS/NAME and the files that are
// named for it. An input that breaks one is kept in KEEP.

namespace docent {
namespace {

constexpr int kSpoiled = 1000;                 // of each seed, for parsers
constexpr int kSpoiledForModules = 20;         // for those of whole modules, which take longer
constexpr std::chrono::seconds kPatience{60};  // an input; the computer may be busy

int run(const std::filesystem::path& corpus, const std::filesystem::path& keep,
        std::map<std::string, std::vector<std::filesystem::path>> files) {
  int passed = 0, failed = 0;
  for (const Fuzzer& fuzzer : kFuzzers) {
    auto& own = files[fuzzer.name];
    if (exists(corpus / fuzzer.name)) own.insert(own.begin(), corpus / fuzzer.name);
    const bool is_parser = std::strncmp(fuzzer.name, "hostile_", 8) != 0;
    FuzzReplay done;
    if (own.empty()) {
      done.fault = "it has no seeds";
    } else {
      done = replay(fuzzer, fuzz_inputs(own, is_parser ? kSpoiled : kSpoiledForModules), kPatience);
    }
    std::printf("%-7s %-40s %6zu inputs%s%s\n", done.fault.empty() ? "ok" : "FAILED", fuzzer.name, done.inputs,
                done.fault.empty() ? "" : ": ", done.fault.c_str());
    std::fflush(stdout);
    ++(done.fault.empty() ? passed : failed);
    if (!done.fault.empty()) {
      create_directories(keep);
      std::ofstream{keep / fuzzer.name, std::ios::binary}.write(
          reinterpret_cast<const char*>(done.broke_at.bytes.data()),
          static_cast<std::streamsize>(done.broke_at.bytes.size()));
    }
  }
  std::printf("%d passed, %d failed\n", passed, failed);
  return failed == 0 && passed > 0 ? 0 : 1;
}

}  // namespace
}  // namespace docent

int main(int argc, char** argv) {
  std::map<std::string, std::vector<std::filesystem::path>> files;
  for (int i = 3; i < argc; ++i) {
    const std::string word = argv[i];
    const std::size_t equal = word.find('=');
    const bool is_known = std::any_of(docent::kFuzzers.begin(), docent::kFuzzers.end(),
                                      [&](const auto& fuzzer) { return word.substr(0, equal) == fuzzer.name; });
    if (equal == std::string::npos || !is_known || !std::filesystem::exists(word.substr(equal + 1))) {
      std::fprintf(stderr, "docent_fuzz_replay: no fuzzer or no file: %s\n", word.c_str());
      return 2;
    }
    files[word.substr(0, equal)].emplace_back(word.substr(equal + 1));
  }
  if (argc < 3) {
    std::fprintf(stderr, "usage: docent_fuzz_replay CORPUS KEEP [NAME=FILE]...\n");
    return 2;
  }
  return docent::run(argv[1], argv[2], files);
}
