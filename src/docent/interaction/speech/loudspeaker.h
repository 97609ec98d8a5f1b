#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "docent/base/result.h"

namespace docent::interaction {

/// The loudspeaker of the robot itself: plays WAV files with a program of the system, such as aplay, a process of its
/// own for each. Without a program it is silent, and whoever fetches the files plays them.
class Loudspeaker {
 public:
  explicit Loudspeaker(std::string program) : program_{std::move(program)} {}
  Loudspeaker(const Loudspeaker&) = delete;
  Loudspeaker& operator=(const Loudspeaker&) = delete;
  ~Loudspeaker();  ///< ends what is still played

  /// Plays a line; the line before is broken off. Error: the program cannot be started.
  Result<void> speak(const std::filesystem::path& file);
  /// Sounds the horn, over whatever is said. While it sounds it is not begun again.
  Result<void> honk(const std::filesystem::path& file);
  /// Breaks the line off.
  void hush();

 private:
  Result<void> play(const std::filesystem::path& file, pid_t& child) const;

  std::string program_;
  pid_t line_ = 0;  ///< the process that plays; 0: none
  pid_t horn_ = 0;
};

}  // namespace docent::interaction
