#include "docent/telepresence/views/health_view.h"

namespace docent::telepresence {

void HealthView::see(const docent_msgs::Health& health, Time now) {
  constexpr std::size_t kMostModules = 64;  // whoever invents names shall not fill the memory
  if (modules_.size() < kMostModules || modules_.contains(health.module)) modules_[health.module] = {health, now};
}

std::string HealthView::show(std::size_t viewers, Time now) {
  std::string text = encode_health(modules_, viewers, now);
  const std::scoped_lock lock{mutex_};
  text_ = text;
  return text;
}

std::string HealthView::document() const {
  const std::scoped_lock lock{mutex_};
  return text_;
}

std::string metrics_text(const WebServerFigures& figures) {
  const auto line = [](const char* name, auto value) {
    return "docent_web_" + (name + (" " + std::to_string(value))) + "\n";
  };
  return line("connections", figures.connections) + line("viewers", figures.viewers) +
         line("viewers_total", figures.viewers_ever) + line("http_requests_total", figures.http_requests) +
         line("messages_received_total", figures.messages_in) +
         line("messages_refused_total", figures.messages_refused) + line("messages_sent_total", figures.messages_out) +
         line("values_skipped_total", figures.values_skipped);
}

}  // namespace docent::telepresence
