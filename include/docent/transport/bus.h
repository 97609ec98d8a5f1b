#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "docent/base/time.h"
#include "docent/messages/cdr.h"
#include "docent/messages/message_fitness.h"
#include "docent/messages/topics.h"

namespace docent::transport {

/// What a body of the bus must know of a message type.
struct TypeSupport {
  const char* name;  ///< "sensor_msgs/msg/LaserScan"
  /// CDR bytes.
  std::vector<std::uint8_t> (*encode)(const void* message);
  std::shared_ptr<const void> (*decode)(std::span<const std::uint8_t> bytes);  ///< null when damaged
  MessageFault (*fault)(const void* message);                                  ///< message_fitness.h
};

/// The one of T, which is the type of a topic in messages/topics.h. type_support.cpp compiles them all, once.
template <Message T>
[[nodiscard]] const TypeSupport& type_support();

/// A topic without its type.
struct TopicInfo {
  const char* name;         ///< without ROS 2's prefix
  Qos qos;                  ///< how it is delivered
  const TypeSupport* type;  ///< of its messages
  int depth = 0;            ///< samples kept for a late reader; 0: as the class says
  double max_age_s = 0;     ///< older samples are dropped; 0: any age
};
/// Of a topic of messages/topics.h.
template <class T>
[[nodiscard]] TopicInfo topic_info(const Topic<T>& topic) {
  return {topic.name, topic.qos, &type_support<T>(), topic.depth, topic.max_age_s};
}

class Bus;

/// One module's right to publish on one topic.
template <class T>
class Publisher {
 public:
  Publisher() = default;
  /// Without a bus nothing happens.
  void publish(T message) const;

 private:
  friend class Bus;
  Publisher(Bus* bus, int handle) : bus_{bus}, handle_{handle} {}
  Bus* bus_ = nullptr;
  int handle_ = -1;
};

/// One module's end of the bus (architecture 4): the same module runs on the in-process bus in virtual time and on DDS.
/// Every handler and timer of one Bus runs on one thread, one after the other. Destroying the Bus ends them all.
class Bus {
 public:
  using Handler = std::function<void(const std::shared_ptr<const void>&)>;  ///< takes a message of its topic's type

  Bus() = default;
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;
  virtual ~Bus() = default;

  /// Virtual time since the start, or wall time under DDS. Never steps back.
  [[nodiscard]] virtual Time now() const = 0;

  /// One more publisher on the topic.
  template <class T>
  [[nodiscard]] Publisher<T> publisher(const Topic<T>& topic) {
    return {this, add_publisher(topic_info(topic))};
  }
  /// A latched topic (Qos::state) delivers its present value at once. A message that is not fit (message_fitness.h) is
  /// none: it is refused and counted, and the handler does not see it; `refused` is called instead.
  template <class T>
  void subscribe(const Topic<T>& topic, std::function<void(const T&)> handler, std::function<void()> refused = {}) {
    const TopicInfo info = topic_info(topic);
    add_subscription(info, [this, topic, type = info.type, handler = std::move(handler),
                            refused = std::move(refused)](const std::shared_ptr<const void>& message) {
      const T& content = *static_cast<const T*>(message.get());
      if (const MessageFault fault = fault_on(topic, content, type->fault(message.get()))) {
        refuse(topic.name, fault);
        if (refused) refused();
      } else {
        handler(content);
      }
    });
  }
  /// First after one period. Calls that are overdue are skipped, never made up for.
  virtual void every(Duration period, std::function<void()> action) = 0;
  /// Once.
  virtual void after(Duration delay, std::function<void()> action) = 0;
  /// Runs `action` on the bus's thread. The one call that any thread may make.
  virtual void post(std::function<void()> action) = 0;

  /// 99th percentile of the wall time of recent handler and timer calls; 0 in virtual time, where a run may not depend
  /// on how fast it was.
  [[nodiscard]] virtual double step_p99_ms() const { return 0.0; }

  /// Programs beside this one that publish on a topic: one writer counts once, whatever type and quality it offers.
  [[nodiscard]] virtual int other_writers(const TopicInfo& topic) = 0;

  /// What came on a topic and could not be used.
  struct Refusals {
    std::uint64_t count = 0;  ///< messages
    MessageFault last;        ///< what was wrong
    Time last_at{};           ///< when
  };
  /// By topic; empty as long as all was well.
  [[nodiscard]] const std::map<std::string, Refusals>& refusals() const { return refusals_; }

  /// For what only the module can find wrong: counted as what `subscribe` refuses, and told in the module's health.
  void refuse(const std::string& topic, const MessageFault& fault) {
    Refusals& refusals = refusals_[topic];
    ++refusals.count;
    refusals.last = fault;
    refusals.last_at = now();
  }

  /// For recorders and gateways that do not care about the type: they get all that decodes.
  virtual void add_subscription(const TopicInfo& topic, Handler handler) = 0;

 protected:
  template <class T>
  friend class Publisher;
  /// @returns its handle
  virtual int add_publisher(const TopicInfo& topic) = 0;
  /// By a handle.
  virtual void publish(int publisher, std::shared_ptr<const void> message) = 0;
  /// The same on another bus: for a bus that passes on.
  static int add_publisher_on(Bus& bus, const TopicInfo& topic) { return bus.add_publisher(topic); }
  /// By a handle of that other bus.
  static void publish_on(Bus& bus, int publisher, std::shared_ptr<const void> message) {
    bus.publish(publisher, std::move(message));
  }

 private:
  std::map<std::string, Refusals> refusals_;
};

template <class T>
void Publisher<T>::publish(T message) const {
  if (bus_ != nullptr) bus_->publish(handle_, std::make_shared<const T>(std::move(message)));
}

}  // namespace docent::transport
