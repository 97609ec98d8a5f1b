#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "docent/geometry/pose2.h"
#include "docent/messages/mission_messages.h"
#include "docent/messages/people_messages.h"
#include "docent/messages/request_messages.h"
#include "docent/messages/standard_messages.h"
#include "docent/telepresence/counting/statistics.h"
#include "docent/transport/bus.h"

namespace docent::modules {

/// For the `web` module: counts what a museum wants to know afterwards, and stores it every ten seconds.
class CountDesk {
 public:
  /// The bus outlives it. @param gateway  a name of its own
  CountDesk(transport::Bus& bus, std::unique_ptr<telepresence::Statistics> statistics, std::string gateway);

  void arrived(const std::string& address);
  void voted() { own_[telepresence::Counted::votes] += 1.0; }
  /// All that the server was ever asked.
  void asked(std::uint64_t accesses);
  void see(const docent_msgs::RequestBoard& board);
  /// The newest people, and where the robot is; of visitors those are counted that are round it.
  void see_people(const docent_msgs::People& people, std::optional<Pose2> map_from_base);
  /// Stores what was counted. @param mode  whose hours these are
  void store(const std::string& mode);
  [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
  void see_odometry(const nav_msgs::Odometry& odometry);
  void see_event(const docent_msgs::Event& event);

  transport::Bus& bus_;
  std::unique_ptr<telepresence::Statistics> statistics_;
  const std::string gateway_;
  const Time begun_;
  telepresence::Counts own_;    ///< not yet stored: what came through this gateway
  telepresence::Counts robot_;  ///< likewise: what is of the robot, should this gateway be the one that counts it
  std::set<std::string> addresses_;
  std::uint64_t accesses_ = 0;            ///< that are counted already
  std::map<std::string, bool> requests_;  ///< on the board: whether their end is counted
  std::optional<Time> moved_;             ///< stamp of the newest odometry
  std::optional<Pose2> odom_from_base_;
  double people_near_ = 0.0;
  std::string fault_;
};

}  // namespace docent::modules
