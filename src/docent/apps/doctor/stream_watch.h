#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "docent/apps/doctor/findings.h"
#include "docent/base/time.h"

namespace docent::apps::doctor_command {

/// What a stream of messages must be like.
struct StreamDemand {
  double least_hz = 1.0;    ///< on average
  double silent_s = 2.0;    ///< [s] a pause that stops the robot
  double oldest_s = 0.2;    ///< [s] of a stamp when the message comes: older ones slow the robot
  bool is_required = true;  ///< without it the robot stands
};

/// Counts the messages of one stream. One thread.
class StreamWatch {
 public:
  void hear(Time stamp, Time now, const std::string& frame);

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] double rate_hz() const;                              ///< 0: fewer than two messages
  [[nodiscard]] double longest_pause_s(Time begin, Time end) const;  ///< also before the first and after the last
  /// [s] that the stamps lie behind this clock, in the median; nullopt: there is no stamp.
  [[nodiscard]] std::optional<double> age_s() const;
  [[nodiscard]] const std::set<std::string>& frames() const { return frames_; }

  /// @param writers  other programs that publish it
  /// @param begin, end  of listening
  [[nodiscard]] Finding judge(const std::string& name, const StreamDemand& demand, int writers, Time begin,
                              Time end) const;

 private:
  int count_ = 0;
  int without_stamp_ = 0;
  int repeated_ = 0;  ///< with the stamp of the one before
  int back_ = 0;      ///< whose stamp lies before that of the one before
  Time first_, last_, last_stamp_;
  Duration longest_{};
  std::vector<double> ages_;
  std::set<std::string> frames_;
};

}  // namespace docent::apps::doctor_command
