#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "docent/transport/bus.h"

namespace docent::apps::ablations {

/// What a module hears and says otherwise than the others.
class BusAlterations {
 public:
  /// Another message in the place of one; what it was stays as it is for everybody else.
  template <class T>
  using Alteration = std::function<T(const T&)>;

  /// What the module says on the topic.
  template <class T>
  void said(const Topic<T>& topic, Alteration<T> alteration) {
    said_[topic.name] = erased(std::move(alteration));
  }
  /// What it hears there.
  template <class T>
  void heard(const Topic<T>& topic, Alteration<T> alteration) {
    heard_[topic.name] = erased(std::move(alteration));
  }
  /// It hears nothing there.
  template <class T>
  void deaf_to(const Topic<T>& topic) {
    deaf_to_.insert(topic.name);
  }
  [[nodiscard]] bool empty() const { return said_.empty() && heard_.empty() && deaf_to_.empty(); }

 private:
  friend class AlteredBus;
  using Erased = std::function<std::shared_ptr<const void>(const std::shared_ptr<const void>&)>;
  template <class T>
  static Erased erased(Alteration<T> alteration) {
    return [alteration = std::move(alteration)](const std::shared_ptr<const void>& message) {
      return std::make_shared<const T>(alteration(*static_cast<const T*>(message.get())));
    };
  }

  std::map<std::string, Erased, std::less<>> said_;
  std::map<std::string, Erased, std::less<>> heard_;
  std::set<std::string, std::less<>> deaf_to_;
};

/// One module's end of another bus, which passes everything on but for the alterations.
class AlteredBus final : public transport::Bus {
 public:
  AlteredBus(std::unique_ptr<transport::Bus> bus, BusAlterations alterations)
      : bus_{std::move(bus)}, alterations_{std::move(alterations)} {}

  [[nodiscard]] Time now() const override { return bus_->now(); }
  void every(Duration period, std::function<void()> action) override { bus_->every(period, std::move(action)); }
  void after(Duration delay, std::function<void()> action) override { bus_->after(delay, std::move(action)); }
  void post(std::function<void()> action) override { bus_->post(std::move(action)); }
  [[nodiscard]] int other_writers(const transport::TopicInfo& topic) override { return bus_->other_writers(topic); }
  [[nodiscard]] double step_p99_ms() const override { return bus_->step_p99_ms(); }
  void add_subscription(const transport::TopicInfo& topic, Handler handler) override;

 protected:
  int add_publisher(const transport::TopicInfo& topic) override;
  void publish(int publisher, std::shared_ptr<const void> message) override;

 private:
  std::unique_ptr<transport::Bus> bus_;
  BusAlterations alterations_;
  std::map<int, const BusAlterations::Erased*> said_;  ///< by publisher
};

}  // namespace docent::apps::ablations
