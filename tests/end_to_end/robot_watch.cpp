#include "robot_watch.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "docent/messages/conversions.h"

namespace docent {
namespace {

std::unique_ptr<transport::DdsBus> join(int domain) {
  auto bus = transport::DdsBus::create({domain, "", {}});
  if (!bus) {
    std::fprintf(stderr, "%s\n", bus.error().message.c_str());
    std::exit(2);
  }
  return std::move(*bus);
}

}  // namespace

template <class T>
void RobotWatch::note(const Topic<T>& topic, const T& message, Clock::time_point at) {
  now_.topics[topic.name] = at;
  if constexpr (std::is_same_v<T, docent_msgs::Health>) {
    auto& heard = now_.health[message.module];
    const bool is_new = heard.count == 0 || heard.health.pid != message.pid || heard.health.state == "starting";
    if (is_new && message.state != "starting") heard.first_at = at;
    heard.health = message;
    heard.at = at;
    ++heard.count;
  }
  if constexpr (std::is_same_v<T, docent_msgs::TrueState>) now_.truth = message;
  if constexpr (std::is_same_v<T, docent_msgs::SpeechState>) now_.speech = message;
  if constexpr (std::is_same_v<T, docent_msgs::TaskState>) now_.task = message;
  if constexpr (std::is_same_v<T, docent_msgs::GoalState>) now_.goal = message;
  if constexpr (std::is_same_v<T, docent_msgs::MissionState>) now_.mission = message;
  if constexpr (std::is_same_v<T, docent_msgs::RequestBoard>) now_.board = message;
  if constexpr (std::is_same_v<T, docent_msgs::AvoidState>) now_.avoid = message;
  if constexpr (std::is_same_v<T, docent_msgs::Stop>) now_.stops[message.keeper] = {message, at};
  if constexpr (std::is_same_v<T, docent_msgs::Event>) ++now_.events[message.kind];
  if constexpr (std::is_same_v<T, docent_msgs::TrueOffer>) {
    if (message.kind == "fault") now_.faults[message.subject] = at;
  }
  if constexpr (std::is_same_v<T, docent_msgs::Belief>) {
    now_.localized = message.localized;
    if (message.localized) now_.localized_at = at;
  }
}

template <class T>
void RobotWatch::follow(transport::DdsBus& bus, const Topic<T>& topic) {
  bus.add_subscription(transport::topic_info(topic), [this, &bus, topic](const std::shared_ptr<const void>& message) {
    const std::scoped_lock lock{mutex_};
    note(topic, *static_cast<const T*>(message.get()), Clock::now());
    evaluator_.add(transport::topic_info(topic), bus.now(), message);
  });
}

RobotWatch::RobotWatch(int domain) : robot_{join(domain)}, truth_{join(transport::truth_domain(domain))} {
  for_each_robot_topic([&](const auto& topic) { follow(*robot_, topic); });
  for_each_truth_topic([&](const auto& topic) { follow(*truth_, topic); });
  requests_ = robot_->publisher(topics::kRequest);
  robot_thread_ = std::jthread{[this](const std::stop_token& stop) { robot_->run(stop); }};
  truth_thread_ = std::jthread{[this](const std::stop_token& stop) { truth_->run(stop); }};
}

RobotWatch::~RobotWatch() {
  robot_thread_ = {};
  truth_thread_ = {};
}

RobotWatch::Snapshot RobotWatch::look() const {
  const std::scoped_lock lock{mutex_};
  return now_;
}

evaluation::DeploymentReport RobotWatch::report() const {
  const std::scoped_lock lock{mutex_};
  return evaluator_.report();
}

void RobotWatch::ask_for(const std::string& kind, const std::string& target) {
  char id[48];
  std::snprintf(id, sizeof id, "01890000-0000-7000-8000-%06x%06x", static_cast<unsigned>(getpid() & 0xffffff),
                static_cast<unsigned>(asked_++));
  const Time now = robot_->now();
  robot_->post([this, request = docent_msgs::Request{id, to_message(now), "web", "the kill protocol", kind, target, -1,
                                                     "en"}] { requests_.publish(request); });
}

}  // namespace docent
