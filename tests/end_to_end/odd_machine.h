#pragma once

#include <atomic>
#include <cstdint>

namespace docent {

/// What a machine has besides: a disk that may be full and a clock that may be set. Shared, through a file, by all
/// programs that run with `docent_odd_machine` preloaded, which is told of it by the environment.
struct OddMachine {
  static constexpr const char* kVariable = "DOCENT_ODD_MACHINE";  ///< names the file
  std::atomic<std::int32_t> is_full{0};                           ///< no regular file takes a byte
  std::atomic<std::int32_t> refused{0};                           ///< writes that were refused
  std::atomic<std::int64_t> ahead_ns{0};                          ///< what the wall's clock is ahead of the true one
};

/// Of this program and all that it starts: where it runs on none, it begins anew on one. @param arguments  of main
[[nodiscard]] OddMachine& on_odd_machine(char** arguments);

}  // namespace docent
