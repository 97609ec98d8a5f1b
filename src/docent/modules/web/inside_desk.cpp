#include "docent/modules/web/inside_desk.h"

#include <utility>

#include "docent/messages/topics.h"
#include "docent/telepresence/views/slots.h"

namespace docent::modules {

void InsideDesk::begin(telepresence::WebServer& server) {
  namespace slots = telepresence::slots;
  constexpr Duration kShowPeriod = std::chrono::milliseconds{500};
  server.restrict_to(telepresence::Stream::details, slots::kField);
  server.restrict_to(telepresence::Stream::details, slots::kLog);
  const auto see = [this](const auto& message) { view_.see(message); };
  bus_.subscribe<sensor_msgs::LaserScan>(topics::kVirtualScan, see);
  bus_.subscribe<docent_msgs::PersonBeams>(topics::kPersonBeams, see);
  bus_.subscribe<docent_msgs::Event>(topics::kEvent, see);
  bus_.every(kShowPeriod, [this, &server] {
    server.broadcast(slots::kField, view_.field(bus_.now()));
    if (auto log = view_.log()) server.broadcast(slots::kLog, std::move(*log));
  });
}

}  // namespace docent::modules
