#pragma once

#include <map>
#include <string>

#include "docent/base/time.h"
#include "docent/collision_avoidance/clocks/clock_offset.h"

namespace docent::collision_avoidance {

struct LocalTimeParams {
  double honest_way = 0.15;       ///< [s] from stamp to receipt: a laser that stamps the start of its sweep takes most
  double way_of_a_picture = 0.6;  ///< [s] likewise: a picture is looked at before anything is said of it
  double disagreement = 0.02;     ///< [s] between clocks that are kept together
};

/// Local time of what sensors stamp, each with the clock of its computer (architecture 10.4). Points, poses and
/// commands can be compared only in one time; ours is that in which commands are given.
///
/// A source whose least delay may be the honest way of a message is taken to keep our clock: its stamps stand as they
/// are. Any other keeps a clock of its own, and its offset is the least delay of all sources that may share it: those
/// whose least delays differ by no more than an honest way. So sources of one computer stay together to the bit,
/// however long each takes. An offset below the honest way cannot be told from the way itself and remains as an error;
/// but a clock that is set back meanwhile, by whatever, is followed.
class LocalTime {
 public:
  explicit LocalTime(const LocalTimeParams& params = {}) : params_{params} {}

  /// Of a message that came just now: learns from it. Never later than `now`. O(sources).
  /// @param source  one name for each driver that stamps
  Time receive(const std::string& source, Time now, Time stamp) {
    return receive(source, now, stamp, params_.honest_way);
  }
  /// Likewise of what was found in a picture.
  Time receive_from_picture(const std::string& source, Time now, Time stamp) {
    return receive(source, now, stamp, params_.way_of_a_picture);
  }
  /// Of a message that carries on the stamp of a reading that it was made of, as beliefs do: by that of the known
  /// clocks which makes the newest of it, but nothing from the future.
  Time receive_handed_on(const std::string& topic, Time now, Time stamp);

 private:
  struct Source {
    ClockOffset clock;
    double honest_way = 0.0;  ///< [s] from the stamp to the receipt at most, as long as messages come quickly
  };
  Time receive(const std::string& source, Time now, Time stamp, double honest_way);
  [[nodiscard]] double offset_of(const Source& source) const;  ///< [s] to be added to its stamps

  LocalTimeParams params_;
  std::map<std::string, Source> sources_;
  std::map<std::string, ClockOffset> handed_on_;
};

}  // namespace docent::collision_avoidance
