#pragma once

#include <filesystem>
#include <future>
#include <optional>
#include <string>

#include "docent/base/time.h"
#include "docent/interaction/sound/clip.h"

namespace docent::interaction {

/// Which music plays, and since when. The museum's file, or Docent's melody, is read when it is wanted first: on a
/// thread of its own, since that takes up to a second, and at once in virtual time.
class BackgroundMusic {
 public:
  /// `file`: the museum's music; nullopt: the melody. `folder`: of what everybody may fetch.
  BackgroundMusic(std::optional<std::filesystem::path> file, std::filesystem::path folder, bool is_virtual_time)
      : file_{std::move(file)}, folder_{std::move(folder)}, is_virtual_time_{is_virtual_time} {}

  /// Several times a second. True: what plays has changed.
  bool play(bool is_wanted, Time now);

  [[nodiscard]] bool is_playing() const { return is_playing_; }
  [[nodiscard]] const SharedClip& clip() const { return ready_.clip; }
  [[nodiscard]] const std::string& file() const { return ready_.file; }    ///< HASH and its ending
  [[nodiscard]] double loudness_db() const { return ready_.loudness_db; }  ///< of the file
  [[nodiscard]] Time start() const { return start_; }                      ///< of its first sample
  [[nodiscard]] const std::string& fault() const { return ready_.fault; }  ///< why there is none; empty: there is

 private:
  struct Ready {
    std::string file;
    SharedClip clip;
    double loudness_db = 0.0;
    std::string fault;
  };
  [[nodiscard]] static Ready read(const std::optional<std::filesystem::path>& file,
                                  const std::filesystem::path& folder);
  [[nodiscard]] bool is_ready();

  std::optional<std::filesystem::path> file_;
  std::filesystem::path folder_;
  bool is_virtual_time_;
  bool is_playing_ = false;
  Time start_;
  Ready ready_;
  std::future<Ready> reading_;
};

}  // namespace docent::interaction
