#include "docent/modules/web/inside_desk.h"

#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"
#include "docent/modules/web/slots.h"
#include "docent/telepresence/document_json.h"
#include "docent/telepresence/live_encoding.h"

namespace docent::modules {
namespace {

constexpr Duration kShowPeriod = std::chrono::milliseconds{500};
constexpr std::size_t kMostLines = 60;
constexpr Duration kFreshState = std::chrono::seconds{2};

}  // namespace

void InsideDesk::begin(telepresence::WebServer& server) {
  server_ = &server;
  server.restrict_to(telepresence::Stream::details, kField);
  server.restrict_to(telepresence::Stream::details, kLog);
  bus_.subscribe<sensor_msgs::LaserScan>(topics::kVirtualScan, [this](const auto& m) { virtual_scan_ = m; });
  bus_.subscribe<docent_msgs::PersonBeams>(topics::kPersonBeams, [this](const auto& m) { beams_ = m; });
  bus_.subscribe<docent_msgs::Event>(topics::kEvent, [this](const auto& m) {
    lines_.push_front({to_seconds(from_message(m.header.stamp)), m.kind, m.subject, m.detail});
    if (lines_.size() > kMostLines) lines_.pop_back();
    is_log_new_ = true;
  });
  bus_.every(kShowPeriod, [this] { show(); });
}

void InsideDesk::show() {
  const Time now = bus_.now();
  const auto fresh = [now](const auto& message) {
    using T = std::decay_t<decltype(message)>;
    return now - from_message(message.header.stamp) <= kFreshState ? message : T{};
  };
  server_->broadcast(kField, telepresence::encode_field(fresh(virtual_scan_), fresh(beams_)));
  if (!std::exchange(is_log_new_, false)) return;
  server_->broadcast(kLog,
                     telepresence::json_text(telepresence::documents::LogMessage{{lines_.begin(), lines_.end()}}));
}

}  // namespace docent::modules
