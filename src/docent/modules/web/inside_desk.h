#pragma once

#include <deque>

#include "docent/messages/mission_messages.h"
#include "docent/messages/people_messages.h"
#include "docent/messages/standard_messages.h"
#include "docent/telepresence/documents.h"
#include "docent/telepresence/server/web_server.h"
#include "docent/transport/bus.h"

namespace docent::modules {

/// For the `web` module: what specialists look at. The obstacle field with its virtual measurements, the filtered
/// beams, and the log of what happened.
class InsideDesk {
 public:
  /// The bus outlives it.
  explicit InsideDesk(transport::Bus& bus) : bus_{bus} {}

  /// From now on viewers who look inside are shown. @pre lives as long as this
  void begin(telepresence::WebServer& server);

 private:
  void show();

  transport::Bus& bus_;
  telepresence::WebServer* server_ = nullptr;
  sensor_msgs::LaserScan virtual_scan_;
  docent_msgs::PersonBeams beams_;
  std::deque<telepresence::documents::LogLine> lines_;  ///< the newest first
  bool is_log_new_ = true;
};

}  // namespace docent::modules
