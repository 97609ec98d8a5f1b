#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <string>

#include "docent/base/files.h"
#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::interaction {

/// A line as it is ordered.
struct Say {
  std::string id;
  std::string text;
  std::string language;
  Mood mood = Mood::neutral;
};

/// The line that is being said, or was said last.
struct Speech {
  std::string id;  ///< empty: nothing was ever said
  std::string text;
  std::string language;
  Mood mood = Mood::neutral;
  bool is_speaking = false;
  Time start;
  double duration_s = 0.0;
  std::string audio;  ///< file name; empty: no sound, the words alone
};

struct SpeakerMemory {
  Speech present;
  std::deque<std::string> finished;  ///< ids, the newest last
};

/// Says one line at a time. A newer one replaces the present; an id that was ordered before is not said again, for
/// orders are repeated until they are seen (architecture 10.8). Deterministic.
class Speaker {
 public:
  static constexpr std::size_t kRemembered = 32;

  /// A line that was being said goes on until its end; one from another life of the clock has ended.
  Speaker(SpeakerMemory memory, Time now);

  enum class Verdict { fresh, under_way, finished };
  /// fresh: have it rendered, then `begin`. The others change nothing.
  [[nodiscard]] Verdict judge(const Say& say) const;
  /// The line is awaited: the same order again is under way.
  void expect(const Say& say);
  [[nodiscard]] const std::optional<Say>& expected() const { return expected_; }
  /// The expected line sounds from now on. @pre expected()
  void begin(double duration_s, const std::string& audio, Time now);
  /// Ends the present line when its time is over; true when it did.
  bool finish_if_over(Time now);

  [[nodiscard]] const Speech& present() const { return memory_.present; }
  [[nodiscard]] const SpeakerMemory& memory() const { return memory_; }

 private:
  void retire();

  SpeakerMemory memory_;
  std::optional<Say> expected_;
};

[[nodiscard]] Result<void> save_checkpoint(const std::filesystem::path& path, const SpeakerMemory& memory,
                                           Survives survives = Survives::power_failure);
/// No file: nothing was said. Error: "FILE: why".
[[nodiscard]] Result<SpeakerMemory> load_speaker_checkpoint(const std::filesystem::path& path);

}  // namespace docent::interaction
