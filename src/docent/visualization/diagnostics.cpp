#include "docent/visualization/diagnostics.h"

#include <cstdio>

#include "docent/messages/conversions.h"

namespace docent::visualization {
namespace {

constexpr std::uint8_t kOk = 0, kWarn = 1, kError = 2, kStale = 3;  // of diagnostic_msgs/DiagnosticStatus
constexpr Duration kSilent = std::chrono::seconds{2};               // four times the period of a module's health
constexpr std::size_t kMostModules = 100;                           // more are nobody's of ours

std::uint8_t level_of(const docent_msgs::Health& health) {
  if (health.state == "ready") return kOk;
  return health.state == "faulted" ? kError : kWarn;
}

std::string digits(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", number);
  return text;
}

}  // namespace

void Diagnostics::hear(const docent_msgs::Health& health, Time now) {
  if (modules_.size() < kMostModules || modules_.contains(health.module)) modules_[health.module] = {health, now};
}

diagnostic_msgs::DiagnosticArray Diagnostics::message(Time now) const {
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = to_message(now);
  for (const auto& [name, heard] : modules_) {
    const docent_msgs::Health& health = heard.health;
    const bool is_silent = now - heard.at > kSilent;
    diagnostic_msgs::DiagnosticStatus status;
    status.level = is_silent ? kStale : level_of(health);
    status.name = "docent_" + name + ": health";
    status.message = is_silent ? "silent" : health.reason.empty() ? health.state : health.reason;
    status.hardware_id = "docent";
    status.values = {
        {"state", health.state}, {"pid", std::to_string(health.pid)}, {"step_p99_ms", digits(health.step_p99_ms)}};
    array.status.push_back(std::move(status));
  }
  return array;
}

}  // namespace docent::visualization
