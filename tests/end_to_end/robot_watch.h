#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "docent/evaluation/deployment_evaluator.h"
#include "docent/transport/dds_bus.h"

namespace docent {

/// Looks at a robot that runs as processes, from outside: what its modules say, and in the truth's domain what is so.
class RobotWatch {
 public:
  using Clock = std::chrono::steady_clock;
  struct Heard {
    docent_msgs::Health health;
    Clock::time_point at;        ///< of the last
    Clock::time_point first_at;  ///< of the first with this pid that is past its start
    int count = 0;
  };
  struct Snapshot {
    std::map<std::string, Heard> health;              ///< by module
    std::map<std::string, Clock::time_point> topics;  ///< last message
    docent_msgs::TrueState truth;
    docent_msgs::SpeechState speech;
    docent_msgs::TaskState task;
    docent_msgs::GoalState goal;
    docent_msgs::MissionState mission;
    docent_msgs::RequestBoard board;
    docent_msgs::AvoidState avoid;
    std::map<std::string, Clock::time_point> faults;  ///< by the simulator's sensor: when it last broke
    std::map<std::string, std::pair<docent_msgs::Stop, Clock::time_point>> stops;  ///< by keeper: its last word
    std::map<std::string, int> events;                                             ///< by kind: how many there were
    bool localized = false;
    Clock::time_point localized_at;  ///< last belief that was sure
  };

  explicit RobotWatch(int domain);
  ~RobotWatch();
  RobotWatch(const RobotWatch&) = delete;
  RobotWatch& operator=(const RobotWatch&) = delete;

  [[nodiscard]] Snapshot look() const;
  /// Since the beginning; contacts are judged as in every other evaluation.
  [[nodiscard]] evaluation::DeploymentReport report() const;
  /// As a visitor on the Web would.
  void ask_for(const std::string& kind, const std::string& target);

 private:
  template <class T>
  void follow(transport::DdsBus& bus, const Topic<T>& topic);
  template <class T>
  void note(const Topic<T>& topic, const T& message, Clock::time_point at);

  std::unique_ptr<transport::DdsBus> robot_;
  std::unique_ptr<transport::DdsBus> truth_;
  transport::Publisher<docent_msgs::Request> requests_;
  int asked_ = 0;
  mutable std::mutex mutex_;
  Snapshot now_;
  evaluation::DeploymentEvaluator evaluator_;
  std::jthread robot_thread_;
  std::jthread truth_thread_;
};

}  // namespace docent
