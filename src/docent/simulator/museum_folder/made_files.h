#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "docent/base/result.h"

namespace docent::simulator {

/// The files that a command made in a folder. It may make them anew as long as nobody has edited one since: what a
/// person wrote is never replaced. A list of their hashes, `.made-by-docent`, lies beside them.
class MadeFiles {
 public:
  /// Error: the list is damaged.
  [[nodiscard]] static Result<MadeFiles> in(const std::filesystem::path& folder);
  /// Error: one of these files exists and is not as it was made. @param names  relative to the folder
  [[nodiscard]] Result<void> check(const std::vector<std::string>& names) const;
  /// Writes the list of these files as they are now. @pre they exist
  [[nodiscard]] Result<void> note(const std::vector<std::string>& names) const;

 private:
  explicit MadeFiles(std::filesystem::path folder) : folder_{std::move(folder)} {}
  std::filesystem::path folder_;
  std::map<std::string, std::string> hashes_;  ///< of each file as it was made
};

}  // namespace docent::simulator
