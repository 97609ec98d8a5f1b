// A stand-in for rclcpp_lifecycle of ROS 2 Jazzy; see ../rclcpp/rclcpp.hpp.
#pragma once

#include <functional>
#include <rclcpp/rclcpp.hpp>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace rclcpp_lifecycle {

class State {};

namespace node_interfaces {

class LifecycleNodeInterface {
 public:
  enum class CallbackReturn : std::uint8_t { SUCCESS = 97, FAILURE = 98, ERROR = 99 };
  virtual CallbackReturn on_configure(const State& /*previous*/) { return CallbackReturn::SUCCESS; }
  virtual CallbackReturn on_cleanup(const State& /*previous*/) { return CallbackReturn::SUCCESS; }
  virtual CallbackReturn on_shutdown(const State& /*previous*/) { return CallbackReturn::SUCCESS; }
  virtual CallbackReturn on_activate(const State& /*previous*/) { return CallbackReturn::SUCCESS; }
  virtual CallbackReturn on_deactivate(const State& /*previous*/) { return CallbackReturn::SUCCESS; }
  virtual CallbackReturn on_error(const State& /*previous*/) { return CallbackReturn::FAILURE; }
  virtual ~LifecycleNodeInterface() = default;
};

}  // namespace node_interfaces

template <class MessageT>
class LifecyclePublisher {
 public:
  using SharedPtr = std::shared_ptr<LifecyclePublisher<MessageT>>;
  LifecyclePublisher(std::string topic, const rclcpp::QoS& qos) : topic_{std::move(topic)}, qos_{qos} {}
  virtual ~LifecyclePublisher() = default;
  virtual void publish(const MessageT& message) {
    if (is_active_) rclcpp::World::get().send(topic_, message, qos_.is_latched());
  }
  [[nodiscard]] const char* get_topic_name() const { return topic_.c_str(); }
  void set_active(bool is_active) { is_active_ = is_active; }

 private:
  std::string topic_;
  rclcpp::QoS qos_;
  bool is_active_ = false;
};

class LifecycleNode : public node_interfaces::LifecycleNodeInterface,
                      public std::enable_shared_from_this<LifecycleNode> {
 public:
  explicit LifecycleNode(const std::string& /*name*/, const rclcpp::NodeOptions& options = rclcpp::NodeOptions(),
                         bool /*enable_communication_interface*/ = true)
      : overrides_{options.overrides_} {
    if (const auto space = overrides_.find("__ns"); space != overrides_.end())
      namespace_ = std::get<std::string>(space->second);
    declare_parameter("use_sim_time", false);
  }

  CallbackReturn on_activate(const State& /*previous*/) override { return set_active(true); }
  CallbackReturn on_deactivate(const State& /*previous*/) override { return set_active(false); }

  [[nodiscard]] rclcpp::Logger get_logger() const { return logger_; }
  [[nodiscard]] rclcpp::Clock::SharedPtr get_clock() { return clock_; }
  [[nodiscard]] rclcpp::Time now() const { return clock_->now(); }
  [[nodiscard]] rclcpp::node_interfaces::NodeBaseInterface::SharedPtr get_node_base_interface() {
    return std::make_shared<rclcpp::node_interfaces::NodeBaseInterface>();
  }

  template <class MessageT>
  std::shared_ptr<LifecyclePublisher<MessageT>> create_publisher(const std::string& topic, const rclcpp::QoS& qos) {
    auto publisher = std::make_shared<LifecyclePublisher<MessageT>>(resolved(topic), qos);
    switches_.push_back([weak = std::weak_ptr(publisher)](bool is_active) {
      if (const auto open = weak.lock()) open->set_active(is_active);
    });
    return publisher;
  }

  template <class MessageT, class CallbackT>
  std::shared_ptr<rclcpp::Subscription<MessageT>> create_subscription(const std::string& topic, const rclcpp::QoS& qos,
                                                                      CallbackT&& callback) {
    auto subscription = std::make_shared<rclcpp::Subscription<MessageT>>();
    subscription->topic = resolved(topic);
    subscription->take = [callback = std::forward<CallbackT>(callback)](const std::any& message) {
      callback(std::any_cast<const MessageT&>(message));
    };
    rclcpp::World& world = rclcpp::World::get();
    world.subscriptions[subscription->topic].push_back(subscription);
    if (const auto last = world.latched.find(subscription->topic); qos.is_latched() && last != world.latched.end())
      subscription->take(last->second);
    return subscription;
  }

  template <class ParameterT>
  ParameterT declare_parameter(const std::string& name, const ParameterT& default_value) {
    if (parameters_.count(name) > 0) throw std::runtime_error{"parameter '" + name + "' has already been declared"};
    const auto override = overrides_.find(name);
    parameters_.emplace(name, override == overrides_.end() ? value_of(default_value) : override->second);
    return default_value;
  }
  [[nodiscard]] rclcpp::Parameter get_parameter(const std::string& name) const {
    const auto place = parameters_.find(name);
    if (place == parameters_.end()) throw std::runtime_error{"parameter '" + name + "' is not declared"};
    return rclcpp::Parameter{place->second};
  }
  [[nodiscard]] std::string resolved(const std::string& name) const {
    return name.front() == '/' ? name : namespace_ + "/" + name;
  }

 private:
  template <class T>
  static rclcpp::ParameterValue value_of(const T& value) {
    if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>)
      return static_cast<std::int64_t>(value);
    else
      return value;
  }
  CallbackReturn set_active(bool is_active) {
    for (const auto& each : switches_) each(is_active);
    return CallbackReturn::SUCCESS;
  }

  std::map<std::string, rclcpp::ParameterValue> overrides_, parameters_;
  std::vector<std::function<void(bool)>> switches_;
  std::string namespace_;
  rclcpp::Logger logger_;
  rclcpp::Clock::SharedPtr clock_ = std::make_shared<rclcpp::Clock>();
};

}  // namespace rclcpp_lifecycle
