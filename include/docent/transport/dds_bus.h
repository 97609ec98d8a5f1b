#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <queue>
#include <stop_token>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/transport/bus.h"
#include "docent/transport/reader_watch.h"

struct ddsi_sertype;

namespace docent::transport {

class RosGraph;

/// The highest domain whose ports fit below 65536.
inline constexpr int kMaxDdsDomain = 230;
/// Where the simulator publishes what is true: a domain that no module of the robot is in (architecture 10.1).
[[nodiscard]] constexpr int truth_domain(int robot_domain) { return (robot_domain + 100) % (kMaxDdsDomain + 1); }

/// The interface of this computer alone: who is on it is let in by the computer.
inline constexpr const char* kLoopback = "lo";

/// Which bus to join, and how.
struct DdsOptions {
  int domain = 0;           ///< 0 … kMaxDdsDomain
  std::string name_prefix;  ///< several robots in one domain: "minerva" makes rt/minerva/scan_front
  /// Faults worth a line: a peer with another quality of service, damaged samples. Called on the bus's thread.
  std::function<void(const std::string&)> warn;
  bool stamped_commands = false;  ///< cmd_vel is a TwistStamped on the wire, else a Twist
  std::string node = "docent";    ///< of ROS 2: who `ros2 node list` says it is, in the name space of `name_prefix`
  /// Topics that are called otherwise on the wire: {"scan_front", "lidar/scan"}. One that begins with a slash has no
  /// prefix.
  std::map<std::string, std::string, std::less<>> renamed{};
  /// A network interface that is heard beside loopback; kLoopback: none. CYCLONEDDS_URI, where it is set, rules
  /// instead.
  std::string interface = kLoopback;
};

/// The DDS body of the bus: Cyclone DDS, seen by ROS 2 as an ordinary robot (architecture 4). Loopback only, unless
/// DdsOptions::interface or CYCLONEDDS_URI say otherwise. All handlers and timers run in `run`, on the caller's thread;
/// before it, nothing is delivered.
class DdsBus final : public Bus {
 public:
  /// Error: DDS refuses the domain, or there is no such interface; says the cure.
  [[nodiscard]] static Result<std::unique_ptr<DdsBus>> create(DdsOptions options);
  ~DdsBus() override;

  /// Until `stop`. May be called again.
  void run(std::stop_token stop);

  /// Wall clock. Follows steps forward; where the system's clock steps back it goes on at its own pace.
  [[nodiscard]] Time now() const override;
  void every(Duration period, std::function<void()> action) override;
  /// Once.
  void after(Duration delay, std::function<void()> action) override;
  void post(std::function<void()> action) override;
  void add_subscription(const TopicInfo& topic, Handler handler) override;

  /// Writers, also of other processes, that have shown life in the last second. Asks DDS for liveliness, because a
  /// killed writer stays matched for ten seconds. Subscribes to nothing; -1 for a topic that this bus does not
  /// subscribe to.
  [[nodiscard]] int alive_writers(const std::string& topic) const;

  /// One that was killed is told from one that lives as `alive_writers` does, if it is Docent's; others stay until
  /// their participant's lease is over (10 s of a ROS 2 program). O(writers of the domain)
  [[nodiscard]] int other_writers(const TopicInfo& topic) override;
  /// Its entity, for what asks Cyclone DDS itself.
  [[nodiscard]] std::int32_t participant() const { return participant_; }
  /// What a topic is called on the wire, and the type of its messages there.
  [[nodiscard]] std::string wire_name(const TopicInfo& topic) const;
  [[nodiscard]] std::string wire_type(const TopicInfo& topic) const;  ///< "sensor_msgs::msg::dds_::LaserScan_"

  /// What has come in, and what has not.
  struct Counters {
    std::uint64_t received = 0;  ///< samples given to handlers
    std::uint64_t damaged = 0;   ///< samples dropped, because they are not what their topic promises
    std::uint64_t stale = 0;     ///< samples dropped, because they are older than their topic allows
    std::uint64_t unsent = 0;    ///< samples that a reader who does not keep up has cost
    std::uint64_t renewed = 0;  ///< readers of sensors that heard nothing though their writer lived, and were made anew
  };
  [[nodiscard]] Counters counters() const { return counters_; }  ///< so far
  /// Of the last 512 calls.
  [[nodiscard]] double step_p99_ms() const override;

 protected:
  int add_publisher(const TopicInfo& topic) override;                         ///< see Bus
  void publish(int publisher, std::shared_ptr<const void> message) override;  ///< see Bus

 private:
  using Steady = std::chrono::steady_clock;
  struct DdsTopic {
    std::int32_t entity = 0;
    const ddsi_sertype* type = nullptr;
    const TypeSupport* support = nullptr;
  };
  struct Writer {
    std::int32_t entity = 0;
    DdsTopic topic;
    bool is_state = false;
    std::shared_ptr<const void> unsent;  ///< a state that could not be written yet
  };
  /// How old samples are at least, over the last minute or two: what the clocks of writer and reader differ by, and the
  /// way between them.
  struct AgeFilter {
    Duration current = Duration::max();
    Duration previous = Duration::max();
    Steady::time_point begin;
    /// How much older than that this sample is.
    [[nodiscard]] Duration excess(Duration age, Steady::time_point at);
  };
  struct Subscription {
    DdsBus* bus = nullptr;
    std::string name;
    std::int32_t reader = 0;
    const TypeSupport* support = nullptr;
    Handler handler;
    Duration max_age{};                       ///< 0: any
    std::map<std::uint64_t, AgeFilter> ages;  ///< by writer
    std::int32_t topic = 0;                   ///< entity
    TopicInfo info{};
    ReaderWatch watch;
    bool is_ready = false;  ///< guarded by mutex_
  };
  struct Timer {
    Steady::time_point due;
    std::uint64_t order = 0;
    Duration period{};  ///< 0: once
    std::shared_ptr<std::function<void()>> action;
    friend bool operator<(const Timer& a, const Timer& b) {  // the earliest is on top
      return a.due != b.due ? a.due > b.due : a.order > b.order;
    }
  };

  DdsBus(DdsOptions options, std::int32_t participant, std::int32_t own_domain);
  DdsTopic find_or_create(const TopicInfo& info);
  /// How the topic's messages look on the wire.
  [[nodiscard]] const TypeSupport* wire_support(const TopicInfo& topic) const;
  [[nodiscard]] int foreign_endpoints(const std::string& wire_name);
  void write(Writer& writer, const std::shared_ptr<const void>& message);
  void retry_unsent();
  void open_reader(Subscription& subscription);
  /// Of sensors; O(subscriptions).
  void renew_deaf_readers();
  void take(Subscription& subscription);
  [[nodiscard]] bool is_stale(Subscription& subscription, std::uint64_t writer, std::int64_t written_at);
  void add_timer(Steady::time_point due, Duration period, std::function<void()> action);
  void run_due_timers();
  void time_step(const std::function<void()>& step);
  void warn_later(std::string text);
  static void on_data(std::int32_t reader, void* subscription);

  DdsOptions options_;
  std::int32_t participant_ = 0;
  std::int32_t own_domain_ = 0;  ///< 0 where CYCLONEDDS_URI rules
  std::unique_ptr<RosGraph> graph_;
  std::map<std::string, DdsTopic> topics_;
  std::int32_t publications_ = 0;               ///< reads what DDS tells of all writers; 0: nobody has asked
  std::map<std::string, std::int32_t> probes_;  ///< by topic, readers that nobody listens to: whose writers live
  std::deque<Writer> writers_;
  std::vector<std::unique_ptr<Subscription>> subscriptions_;
  std::priority_queue<Timer> timers_;
  std::uint64_t next_order_ = 0;
  bool retry_is_due_ = false;
  bool watches_readers_ = false;
  Counters counters_;
  std::vector<float> steps_ms_;
  std::size_t next_step_ = 0;

  mutable std::mutex clock_mutex_;
  mutable std::int64_t last_now_ = 0;
  mutable Steady::time_point last_now_at_;

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::vector<Subscription*> ready_;
  std::vector<std::function<void()>> posts_;
};

}  // namespace docent::transport
