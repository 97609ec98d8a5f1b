#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "docent/base/result.h"

namespace docent::recording {

struct RecoveryReport {
  std::uint64_t messages = 0;
  std::vector<std::string> damage;  ///< what was lost, in words
};
/// Makes a whole file of a cut or damaged one: everything that can still be read, with a new index.
/// `out` may be the name that a killed recorder was about to give: then its unfinished file goes away.
/// Error: not an MCAP file, or `out` cannot be written.
[[nodiscard]] Result<RecoveryReport> recover_mcap(const std::filesystem::path& path, const std::filesystem::path& out);

}  // namespace docent::recording
