#pragma once

#include <deque>
#include <filesystem>
#include <string>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::interaction {

/// One answer of a visitor.
struct PollEntry {
  std::string id;  ///< of the message; never written
  PollQuestion question = PollQuestion::liked;
  PollAnswer answer = PollAnswer::undecided;
  std::string language;
};

/// The answers of visitors after a tour ([Minerva2000] 7), a line of a CSV file each: day, hour, language, question,
/// answer. Nothing tells who answered, or which answers are of one visitor. One writer.
class Poll {
 public:
  explicit Poll(std::filesystem::path file) : file_{std::move(file)} {}

  /// Appends the answer; `now` counts from 1970, UTC. An id that came lately is not written again: saying an answer
  /// twice is saying it once. Error: "FILE: why".
  [[nodiscard]] Result<void> add(const PollEntry& entry, Time now);

 private:
  std::filesystem::path file_;
  std::deque<std::string> known_;  ///< ids of the last answers
};

}  // namespace docent::interaction
