#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

// Fuzzers that search for nothing: they get the seeds of their corpus, and some spoiled ones, always the same. That
// needs no compiler and no build of its own; scripts/fuzz searches.

namespace docent {

struct Fuzzer {
  const char* name;  ///< as tests/corpus calls its folder
  int (*run)(const std::uint8_t* data, std::size_t size);
};

struct FuzzInput {
  std::string name;  ///< the file, and which of its spoiled ones
  std::vector<std::uint8_t> bytes;
};

struct FuzzReplay {
  std::size_t inputs = 0;  ///< that it was given
  std::string fault;       ///< what ended it, and at which input; empty: nothing
  FuzzInput broke_at;      ///< where there is a fault
};

/// The empty input, the bytes of the files, and of each so many inputs that differ from it in a few places: the same
/// ones in every run. A folder stands for the files in it, in the order of their names.
[[nodiscard]] std::vector<FuzzInput> fuzz_inputs(const std::vector<std::filesystem::path>& files, int spoiled);

/// Gives a fuzzer its inputs, in a process of its own: what aborts, crashes or takes longer for an input than it may is
/// a fault.
[[nodiscard]] FuzzReplay replay(const Fuzzer& fuzzer, const std::vector<FuzzInput>& inputs,
                                std::chrono::seconds patience);

}  // namespace docent
