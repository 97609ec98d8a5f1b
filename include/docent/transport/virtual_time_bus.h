#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <queue>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "docent/base/quantiles.h"
#include "docent/transport/bus.h"

namespace docent::transport {

/// The in-process body of the bus: one queue ordered by time, then by the order of posting. One thread; the same inputs
/// give the same run, bit for bit. Messages are shared, not copied.
class VirtualTimeHub {
 public:
  /// Sees every message in the order of publishing: for recording and evaluation.
  using Tap = std::function<void(const TopicInfo&, Time, const std::shared_ptr<const void>&)>;

  VirtualTimeHub() = default;
  VirtualTimeHub(const VirtualTimeHub&) = delete;
  VirtualTimeHub& operator=(const VirtualTimeHub&) = delete;

  /// One module's end. It must not outlive the hub.
  [[nodiscard]] std::unique_ptr<Bus> connect(std::string name);

  [[nodiscard]] Time now() const { return now_; }  ///< since the start
  /// Runs everything due up to and at `end`; then now() == end.
  void run_until(Time end);
  void tap(Tap tap) { taps_.push_back(std::move(tap)); }  ///< one more, after the others
  /// Every message of the topic passes through this before anybody sees it: for faults between modules.
  using Alteration = std::function<std::shared_ptr<const void>(Time, std::shared_ptr<const void>)>;
  /// The last one given counts.
  void alter(const TopicInfo& info, Alteration alteration) { topic(info).alteration = std::move(alteration); }

  /// Topics that the modules of this name have made publishers for so far: what a replay leaves to them.
  [[nodiscard]] std::set<std::string> topics_published_by(std::string_view name) const;

  /// What the handlers of each module have cost so far, by the clock.
  struct Cost {
    double total_s = 0.0;  ///< [s]
    Quantiles steps_ms;    ///< of handler calls that took longer than 1 us
  };
  /// The wall's clock, or, for a profile, this thread's time of the processor [s]: that is slower to ask.
  using CostClock = double (*)();
  [[nodiscard]] static double wall_clock();                                                       ///< [s]
  [[nodiscard]] static double processor_clock();                                                  ///< [s]
  void measure_by(CostClock clock) { clock_ = clock; }                                            ///< for the costs
  [[nodiscard]] double cost_clock() const { return clock_(); }                                    ///< [s] now
  [[nodiscard]] const std::map<std::string, Cost, std::less<>>& costs() const { return costs_; }  ///< by name of module

 private:
  class Node;
  struct Subscription {
    std::weak_ptr<Node*> node;
    Bus::Handler handler;
  };
  struct TopicState {
    TopicInfo info{};
    std::vector<Subscription> subscriptions;
    std::vector<std::weak_ptr<Node*>> publishers;
    std::shared_ptr<const void> latched;
    Alteration alteration;  ///< empty: none
  };
  struct Event {
    Time time;
    std::uint64_t order;
    std::weak_ptr<Node*> node;  ///< the event dies with its node
    std::function<void()> action;
    friend bool operator<(const Event& a, const Event& b) {  // the earliest is on top
      return a.time != b.time ? a.time > b.time : a.order > b.order;
    }
  };
  void schedule(Time time, std::weak_ptr<Node*> node, std::function<void()> action);
  TopicState& topic(const TopicInfo& info);
  void drain_posts();

  Time now_{};
  CostClock clock_ = wall_clock;
  std::uint64_t next_order_ = 0;
  std::priority_queue<Event> queue_;
  std::map<std::string, TopicState, std::less<>> topics_;
  std::vector<Tap> taps_;
  std::map<std::string, Cost, std::less<>> costs_;
  std::map<std::string, std::set<std::string>, std::less<>> published_;
  std::mutex posts_mutex_;
  std::vector<std::pair<std::weak_ptr<Node*>, std::function<void()>>> posts_;
};

}  // namespace docent::transport
