#include "docent/transport/virtual_time_bus.h"

#include <time.h>

#include <algorithm>
#include <chrono>

#include "docent/base/check.h"

namespace docent::transport {

class VirtualTimeHub::Node final : public Bus {
 public:
  Node(VirtualTimeHub& hub, std::string name)
      : hub_{hub},
        published_{hub.published_[name]},
        cost_{hub.costs_[std::move(name)]},
        self_{std::make_shared<Node*>(this)} {}
  ~Node() override {
    self_.reset();
    for (auto& [name, state] : hub_.topics_) {
      std::erase_if(state.subscriptions, [](const Subscription& subscription) { return subscription.node.expired(); });
    }
  }

  [[nodiscard]] Time now() const override { return hub_.now_; }

  void every(Duration period, std::function<void()> action) override {
    DOCENT_CHECK(period.count() > 0);
    repeat(hub_.now_ + period, period, std::make_shared<std::function<void()>>(std::move(action)));
  }
  void after(Duration delay, std::function<void()> action) override {
    hub_.schedule(hub_.now_ + delay, self_, std::move(action));
  }
  void post(std::function<void()> action) override {
    const std::scoped_lock lock{hub_.posts_mutex_};
    hub_.posts_.emplace_back(self_, std::move(action));
  }
  void add_subscription(const TopicInfo& info, Handler handler) override {
    auto& state = hub_.topic(info);
    state.subscriptions.push_back({self_, handler});
    if (state.latched) {
      hub_.schedule(hub_.now_, self_, [handler = std::move(handler), message = state.latched] { handler(message); });
    }
  }
  [[nodiscard]] int other_writers(const TopicInfo& info) override {
    const auto& publishers = hub_.topic(info).publishers;
    return static_cast<int>(std::count_if(publishers.begin(), publishers.end(), [this](const auto& publisher) {
      const auto node = publisher.lock();
      return node && node != self_;
    }));
  }
  void run(const std::function<void()>& action) {
    const double start = hub_.cost_clock();
    action();
    const double ms = 1e3 * (hub_.cost_clock() - start);
    cost_.total_s += ms * 1e-3;
    if (ms > 1e-3) cost_.steps_ms.add(ms);
  }

 protected:
  int add_publisher(const TopicInfo& info) override {
    publishers_.push_back(&hub_.topic(info));
    publishers_.back()->publishers.push_back(self_);
    published_.insert(info.name);
    return static_cast<int>(publishers_.size()) - 1;
  }
  void publish(int publisher, std::shared_ptr<const void> message) override {
    TopicState& state = *publishers_[static_cast<std::size_t>(publisher)];
    if (state.alteration) message = state.alteration(hub_.now_, std::move(message));
    for (const auto& tap : hub_.taps_) tap(state.info, hub_.now_, message);
    if (state.info.qos == Qos::state) state.latched = message;
    for (const auto& subscription : state.subscriptions) {
      if (subscription.node.expired()) continue;
      hub_.schedule(hub_.now_, subscription.node, [handler = subscription.handler, message] { handler(message); });
    }
  }

 private:
  void repeat(Time due, Duration period, std::shared_ptr<std::function<void()>> action) {
    hub_.schedule(due, self_, [this, due, period, action] {
      repeat(due + period, period, action);
      (*action)();
    });
  }

  VirtualTimeHub& hub_;
  std::set<std::string>& published_;
  Cost& cost_;
  std::shared_ptr<Node*> self_;
  std::vector<TopicState*> publishers_;
};

double VirtualTimeHub::wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double VirtualTimeHub::processor_clock() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::unique_ptr<Bus> VirtualTimeHub::connect(std::string name) {
  return std::make_unique<Node>(*this, std::move(name));
}

std::set<std::string> VirtualTimeHub::topics_published_by(std::string_view name) const {
  const auto found = published_.find(name);
  return found == published_.end() ? std::set<std::string>{} : found->second;
}

void VirtualTimeHub::run_until(Time end) {
  drain_posts();
  while (!queue_.empty() && queue_.top().time <= end) {
    // The event leaves the queue before it runs: it may schedule others.
    Event event = std::move(const_cast<Event&>(queue_.top()));
    queue_.pop();
    now_ = event.time;
    if (const auto node = event.node.lock()) (*node)->run(event.action);
    drain_posts();
  }
  now_ = end;
}

void VirtualTimeHub::schedule(Time time, std::weak_ptr<Node*> node, std::function<void()> action) {
  queue_.push({time, next_order_++, std::move(node), std::move(action)});
}

VirtualTimeHub::TopicState& VirtualTimeHub::topic(const TopicInfo& info) {
  auto [place, is_new] = topics_.try_emplace(info.name);
  if (is_new) place->second.info = info;
  DOCENT_CHECK(place->second.info.type == info.type);
  return place->second;
}

void VirtualTimeHub::drain_posts() {
  std::vector<std::pair<std::weak_ptr<Node*>, std::function<void()>>> posts;
  {
    const std::scoped_lock lock{posts_mutex_};
    posts.swap(posts_);
  }
  for (auto& [node, action] : posts) schedule(now_, std::move(node), std::move(action));
}

}  // namespace docent::transport
