// A stand-in for rclcpp of ROS 2 Jazzy: what docent_ros uses of it, with the same names and signatures, in one process
// and with a clock that a test sets. Our own text; what is real about it are the signatures.
#pragma once

#include <algorithm>
#include <any>
#include <builtin_interfaces/msg/time.hpp>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#define RCLCPP_LOG_STUB(logger, level, ...)                          \
  do {                                                               \
    char text_of_log[500];                                           \
    std::snprintf(text_of_log, sizeof text_of_log, __VA_ARGS__);     \
    (logger).lines->push_back(std::string(level " ") + text_of_log); \
  } while (false)
#define RCLCPP_INFO(logger, ...) RCLCPP_LOG_STUB(logger, "info", __VA_ARGS__)
#define RCLCPP_WARN(logger, ...) RCLCPP_LOG_STUB(logger, "warn", __VA_ARGS__)
#define RCLCPP_ERROR(logger, ...) RCLCPP_LOG_STUB(logger, "error", __VA_ARGS__)

namespace rclcpp {

struct Logger {
  std::shared_ptr<std::vector<std::string>> lines = std::make_shared<std::vector<std::string>>();
};

class Duration {
 public:
  explicit Duration(std::chrono::nanoseconds duration) : value_{duration.count()} {}
  static Duration from_seconds(double seconds) {
    return Duration{std::chrono::nanoseconds{static_cast<std::int64_t>(seconds * 1e9)}};
  }
  [[nodiscard]] std::int64_t nanoseconds() const { return value_; }

 private:
  std::int64_t value_;
};

class Time {
 public:
  explicit Time(std::int64_t nanoseconds = 0) : value_{nanoseconds} {}
  [[nodiscard]] std::int64_t nanoseconds() const { return value_; }
  operator builtin_interfaces::msg::Time() const {  // NOLINT(google-explicit-constructor): as rclcpp
    builtin_interfaces::msg::Time message;
    message.sec = static_cast<std::int32_t>(value_ / 1'000'000'000);
    message.nanosec = static_cast<std::uint32_t>(value_ % 1'000'000'000);
    return message;
  }

 private:
  std::int64_t value_;
};

class QoS {
 public:
  explicit QoS(std::size_t depth) : depth_{depth} {}
  QoS& reliable() { return is_reliable_ = true, *this; }
  QoS& best_effort() { return is_reliable_ = false, *this; }
  QoS& transient_local() { return is_latched_ = true, *this; }
  [[nodiscard]] bool is_latched() const { return is_latched_; }
  [[nodiscard]] bool is_reliable() const { return is_reliable_; }

 private:
  std::size_t depth_;
  bool is_reliable_ = true;
  bool is_latched_ = false;
};

class TimerBase {
 public:
  using SharedPtr = std::shared_ptr<TimerBase>;
  std::int64_t period = 0;
  std::int64_t due = 0;
  std::function<void()> callback;
};

class SubscriptionBase {
 public:
  virtual ~SubscriptionBase() = default;
  [[nodiscard]] const char* get_topic_name() const { return topic.c_str(); }
  std::string topic;
  std::function<void(const std::any&)> take;
};

template <class MessageT>
class Subscription : public SubscriptionBase {
 public:
  using SharedPtr = std::shared_ptr<Subscription<MessageT>>;
};

/// What takes the place of the middleware and of time.
struct World {
  static World& get() {
    static World world;
    return world;
  }
  std::map<std::string, std::vector<std::weak_ptr<SubscriptionBase>>> subscriptions;
  std::map<std::string, std::any> latched;
  std::vector<std::weak_ptr<TimerBase>> timers;
  std::map<std::string, std::any> actions;  ///< by name: std::weak_ptr<Server<…>>
  std::int64_t now = 0;

  void send(const std::string& topic, const std::any& message, bool is_latched) {
    if (is_latched) latched[topic] = message;
    for (const auto& subscription : std::vector{subscriptions[topic]})
      if (const auto open = subscription.lock()) open->take(message);
  }
  void run_until(std::int64_t time) {
    for (;;) {
      std::shared_ptr<TimerBase> first;
      for (const auto& each : timers)
        if (const auto timer = each.lock(); timer && timer->due <= time && (!first || timer->due < first->due))
          first = timer;
      if (!first) break;
      now = std::max(now, first->due);
      first->due += first->period;
      first->callback();
    }
    now = time;
  }
};

class Clock {
 public:
  using SharedPtr = std::shared_ptr<Clock>;
  [[nodiscard]] Time now() const { return Time{World::get().now}; }
};

using ParameterValue = std::variant<bool, std::int64_t, double, std::string>;

class NodeOptions {
 public:
  NodeOptions& parameter_overrides(std::map<std::string, ParameterValue> overrides) {
    overrides_ = std::move(overrides);
    return *this;
  }
  std::map<std::string, ParameterValue> overrides_;  // rclcpp takes a vector of Parameter; only the test says some
};

class Parameter {
 public:
  explicit Parameter(ParameterValue value) : value_{std::move(value)} {}
  [[nodiscard]] bool as_bool() const { return std::get<bool>(value_); }
  [[nodiscard]] std::int64_t as_int() const { return std::get<std::int64_t>(value_); }
  [[nodiscard]] double as_double() const { return std::get<double>(value_); }
  [[nodiscard]] std::string as_string() const { return std::get<std::string>(value_); }

 private:
  ParameterValue value_;
};

namespace node_interfaces {
struct NodeBaseInterface {
  using SharedPtr = std::shared_ptr<NodeBaseInterface>;
};
}  // namespace node_interfaces

template <class NodeT, class CallbackT>
TimerBase::SharedPtr create_timer(NodeT node, Clock::SharedPtr clock, Duration period, CallbackT&& callback) {
  if (node == nullptr || clock == nullptr) throw std::invalid_argument{"clock cannot be null"};
  auto timer = std::make_shared<TimerBase>();
  timer->period = period.nanoseconds();
  timer->due = clock->now().nanoseconds() + timer->period;
  timer->callback = std::forward<CallbackT>(callback);
  World::get().timers.push_back(timer);
  return timer;
}

inline void init(int /*argc*/, char const* const* /*argv*/) {}
inline void spin(node_interfaces::NodeBaseInterface::SharedPtr /*node*/) {}
inline bool shutdown() { return true; }

}  // namespace rclcpp
