#include "docent/telepresence/views/inside_view.h"

#include <utility>

#include "docent/messages/conversions.h"
#include "docent/telepresence/document_json.h"
#include "docent/telepresence/live_encoding.h"

namespace docent::telepresence {
namespace {

constexpr std::size_t kMostLines = 60;
constexpr Duration kFreshState = std::chrono::seconds{2};

}  // namespace

void InsideView::see(const docent_msgs::Event& event) {
  lines_.push_front({to_seconds(from_message(event.header.stamp)), event.kind, event.subject, event.detail});
  if (lines_.size() > kMostLines) lines_.pop_back();
  is_log_new_ = true;
}

std::string InsideView::field(Time now) const {
  const auto fresh = [now](const auto& message) {
    using T = std::decay_t<decltype(message)>;
    return now - from_message(message.header.stamp) <= kFreshState ? message : T{};
  };
  return encode_field(fresh(virtual_scan_), fresh(beams_));
}

std::optional<std::string> InsideView::log() {
  if (!std::exchange(is_log_new_, false)) return std::nullopt;
  return json_text(documents::LogMessage{{lines_.begin(), lines_.end()}});
}

}  // namespace docent::telepresence
