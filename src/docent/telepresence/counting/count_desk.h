#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/messages/mission_messages.h"
#include "docent/messages/people_messages.h"
#include "docent/messages/request_messages.h"
#include "docent/messages/sensing_messages.h"
#include "docent/messages/standard_messages.h"
#include "docent/telepresence/counting/audience.h"
#include "docent/telepresence/counting/statistics.h"
#include "docent/telepresence/store/store_queue.h"

namespace docent::telepresence {

/// Counts what a museum wants to know afterwards, and stores it every ten seconds.
class CountDesk {
 public:
  /// The queue outlives it; the statistics are used on the queue's thread, until that has ended.
  /// @param gateway  a name of its own
  CountDesk(StoreQueue& queue, std::unique_ptr<Statistics> statistics, std::string gateway, Time now)
      : queue_{queue}, statistics_{std::move(statistics)}, gateway_{std::move(gateway)}, begun_{now} {}

  void arrived(const std::string& address);
  void voted() { counting_.own[Counted::votes] += 1.0; }
  /// To the poll; an id that came lately is not counted again.
  void answered(const std::string& id, PollQuestion question, PollAnswer answer);
  /// All that the server was ever asked.
  void asked(std::uint64_t accesses);
  void see(const docent_msgs::RequestBoard& board);
  void see(const nav_msgs::Odometry& odometry);
  void see(const docent_msgs::Event& event);
  void see(const docent_msgs::Tactile& ring);
  /// The newest people, and where the robot is; of visitors those are counted that are round it.
  void see_people(const docent_msgs::People& people, std::optional<Pose2> map_from_base) {
    audience_.see(people, map_from_base);
  }
  /// Stores what was counted. @param mode  whose hours these are
  void store(const std::string& mode, Time now);
  [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
  /// What was counted between two stores.
  struct Counting {
    Counts own;    ///< what came through this gateway
    Counts robot;  ///< what is of the robot, should this gateway be the one that counts it
    std::set<std::string> addresses;
    std::vector<Attendance> stops;  ///< of the robot, too
  };
  void count_stop_of_tour(const std::string& tour, const std::string& exhibit, Time stamp);
  [[nodiscard]] Result<void> store(const Counting& counted, const std::string& mode, Time now);
  /// It was not stored: it is tried again with what comes.
  void take_back(Counting counted);

  StoreQueue& queue_;
  std::unique_ptr<Statistics> statistics_;
  const std::string gateway_;
  const Time begun_;
  Counting counting_;                     ///< not yet on its way to the store
  std::uint64_t accesses_ = 0;            ///< that are counted already
  std::map<std::string, bool> requests_;  ///< on the board: whether their end is counted
  std::optional<Time> moved_;             ///< stamp of the newest odometry
  std::optional<Pose2> odom_from_base_;
  Audience audience_;
  double people_at_stop_ = 0.0;  ///< at the newest stop of the tour under way
  int stops_ = 0;                ///< that the tour under way has shown
  Time tour_began_;
  std::optional<Time> touched_;      ///< stamp of the newest touch
  std::deque<std::string> answers_;  ///< ids of the last ones
  std::string fault_;
};

}  // namespace docent::telepresence
