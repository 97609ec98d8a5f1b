#pragma once

#include <optional>
#include <string>
#include <utility>

#include "docent/base/time.h"

namespace docent::task_control {

/// The tour for which the Web's visitors vote, until it is its turn ([Minerva2000] 6.4).
class TourVote {
 public:
  struct Winner {
    std::string round;  ///< a UUIDv7, the id of the request for it
    std::string tour;
  };

  /// @param round  empty: there is none. @param tour  with the most votes; empty: there are none yet
  /// @param is_over  its request is on the board
  void told(const std::string& round, const std::string& tour, bool is_over, Time now) {
    if (round != round_) since_.reset();
    round_ = round;
    tour_ = is_over || round.empty() ? "" : tour;
    if (!tour_.empty() && !since_) since_ = now;
  }
  [[nodiscard]] bool is_open() const { return !tour_.empty(); }
  /// Since the round has votes. @pre is_open()
  [[nodiscard]] Duration lasts(Time now) const { return now - *since_; }
  /// Ends the round. @pre is_open()
  [[nodiscard]] Winner take() { return {round_, std::exchange(tour_, "")}; }

 private:
  std::string round_;
  std::string tour_;
  std::optional<Time> since_;
};

}  // namespace docent::task_control
