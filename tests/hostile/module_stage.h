#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "docent/base/random.h"
#include "docent/modules/host/module_host.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent {

/// One module of the robot on the in-process bus, in a room of 5 x 4 m, and somebody who publishes on every topic.
class ModuleStage {
 public:
  /// @param module  a name of the registry
  ModuleStage(const std::string& module, std::filesystem::path state);
  ~ModuleStage();
  ModuleStage(const ModuleStage&) = delete;
  ModuleStage& operator=(const ModuleStage&) = delete;

  /// How many topics there are to publish on.
  [[nodiscard]] static std::size_t topics();
  /// A message such as a sound robot sends, of which each field is spoiled with probability `share`.
  void publish(std::size_t topic, Rng& rng, double share);
  /// A message of any bytes; nothing when they do not decode.
  void publish(std::size_t topic, std::span<const std::uint8_t> cdr);
  void run(double seconds);

  /// What the module published that is itself not fit: "TOPIC: why", each once.
  [[nodiscard]] const std::vector<std::string>& unfit_output() const { return unfit_; }
  [[nodiscard]] const docent_msgs::Health& health() const { return health_; }
  [[nodiscard]] Time now() const { return hub_.now(); }
  [[nodiscard]] std::uint64_t refused() const;

 private:
  museum::Museum museum_;
  robot::RobotConfig config_;
  transport::VirtualTimeHub hub_;
  std::unique_ptr<transport::Bus> world_;
  std::vector<std::function<void(Rng&, double)>> spoilt_;                    ///< by topic
  std::vector<std::function<void(std::span<const std::uint8_t>)>> decoded_;  ///< by topic
  bool is_ours_ = false;  ///< what is published now comes from the stage
  std::vector<std::string> unfit_;
  docent_msgs::Health health_;
  std::unique_ptr<modules::ModuleHost> host_;
};

}  // namespace docent
