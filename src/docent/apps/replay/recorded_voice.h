#pragma once

#include <map>
#include <string>
#include <utility>

#include "docent/interaction/speech/speaker.h"
#include "docent/recording/recorder.h"
#include "docent/transport/bus.h"

namespace docent::apps::replay_command {

/// How long the lines of a recording took to be said: a loudspeaker's time, as much a matter of record as a sensor's.
class RecordedLines {
 public:
  struct Timing {
    Duration until_begin{};  ///< from the order to the first word: rendering
    Duration speaking{};
  };
  /// Every message of the recording, in order; those that do not matter are passed over.
  void add(const recording::RecordedMessage& message);
  [[nodiscard]] bool empty() const { return timings_.empty(); }
  /// As often as a text was said, one after the other, then the last again. A text that was never said: by its length.
  [[nodiscard]] Timing timing_of(const docent_msgs::Say& say);

 private:
  using Line = std::pair<std::string, std::string>;  ///< language, text
  struct Open {
    Line line;
    Time ordered;
    std::optional<Time> begun;
  };
  std::map<std::string, Open> open_;  ///< by id
  std::map<Line, std::vector<Timing>> timings_;
  std::map<Line, std::size_t> said_;
};

/// Stands for the sound module in a replay.
class RecordedVoice {
 public:
  RecordedVoice(transport::Bus& bus, RecordedLines lines);
  RecordedVoice(const RecordedVoice&) = delete;
  RecordedVoice& operator=(const RecordedVoice&) = delete;

 private:
  void on_say(const docent_msgs::Say& message);
  void publish(const interaction::Speech& speech);

  transport::Bus& bus_;
  RecordedLines lines_;
  interaction::Speaker speaker_;
  transport::Publisher<docent_msgs::SpeechState> state_;
};

}  // namespace docent::apps::replay_command
