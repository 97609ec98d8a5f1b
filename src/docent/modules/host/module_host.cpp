#include "docent/modules/host/module_host.h"

#include "docent/messages/conversions.h"
#include "docent/modules/drive/plan_module.h"

namespace docent::modules {

namespace {
constexpr Duration kHealthPeriod = std::chrono::milliseconds{500};
constexpr Duration kRefusalsShown = std::chrono::seconds{5};  // after the last one

/// What has come lately that could not be used; empty: all was well.
std::string lately_refused(const transport::Bus& bus) {
  std::string text;
  for (const auto& [topic, refusals] : bus.refusals()) {
    if (bus.now() - refusals.last_at > kRefusalsShown) continue;
    text += (text.empty() ? "" : "; ") + std::to_string(refusals.count) + " messages of " + topic +
            " refused: " + refusals.last.text();
  }
  return text;
}

}  // namespace

Result<std::unique_ptr<ModuleHost>> ModuleHost::create(const ModuleEntry& entry, std::unique_ptr<transport::Bus> bus,
                                                       const museum::Museum& museum, const robot::RobotConfig& config,
                                                       const Options& options) {
  std::unique_ptr<ModuleHost> host{new ModuleHost{entry.name, std::move(bus)}};
  host->pid_ = options.pid;
  host->handicap_ = options.handicap;
  host->health_ = host->bus_->publisher(topics::kHealth);
  const auto checked_robot = checked_robot_of_plan(config);
  if (!checked_robot) return tl::unexpected<Error>(checked_robot.error());
  auto module = entry.make({*host->bus_, museum, config, options.state, options.seed, options.virtual_time,
                            options.truth, options.day_begins, options.cache, options.is_setup, *checked_robot});
  if (!module) return tl::unexpected<Error>(module.error());
  host->module_ = std::move(*module);
  host->bus_->every(kHealthPeriod, [raw = host.get()] { raw->publish_health(); });
  host->publish_health();
  return host;
}

void ModuleHost::publish_health() {
  ModuleHealth health = module_->health();
  if (const std::string refused = lately_refused(*bus_); !refused.empty()) {
    if (health.state == "ready") health.state = "degraded";
    health.reason += (health.reason.empty() ? "" : "; ") + refused;
  }
  if (!handicap_.empty()) {
    if (health.state == "ready") health.state = "degraded";
    health.reason += (health.reason.empty() ? "" : "; ") + handicap_;
  }
  docent_msgs::Health message;
  message.header.stamp = to_message(bus_->now());
  message.module = name_;
  message.state = health.state;
  message.reason = health.reason;
  message.pid = pid_;
  message.step_p99_ms = bus_->step_p99_ms();
  health_.publish(std::move(message));
}

}  // namespace docent::modules
