#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "docent/modules/host/registry.h"

namespace docent::modules {

/// One module at work on its end of the bus: makes it, and says at 2 Hz how it is (architecture 10.10). Destroying the
/// host ends the module, as killing its process would.
class ModuleHost {
 public:
  struct Options {
    std::filesystem::path state;
    std::uint64_t seed = 0;
    bool virtual_time = false;
    int pid = 0;                                   ///< 0 in virtual time
    transport::Bus* truth = nullptr;               ///< see ModuleContext; outlives the host
    Duration day_begins = std::chrono::hours{10};  ///< see ModuleContext
    std::filesystem::path cache{};                 ///< likewise
    bool is_setup = false;                         ///< likewise
    std::string handicap{};                        ///< of its process, told in its health; empty: none
  };
  /// Error: what the module's factory says of the configuration.
  [[nodiscard]] static Result<std::unique_ptr<ModuleHost>> create(const ModuleEntry& entry,
                                                                  std::unique_ptr<transport::Bus> bus,
                                                                  const museum::Museum& museum,
                                                                  const robot::RobotConfig& config,
                                                                  const Options& options);
  ModuleHost(const ModuleHost&) = delete;
  ModuleHost& operator=(const ModuleHost&) = delete;

  [[nodiscard]] transport::Bus& bus() { return *bus_; }
  [[nodiscard]] const char* name() const { return name_; }

 private:
  ModuleHost(const char* name, std::unique_ptr<transport::Bus> bus) : name_{name}, bus_{std::move(bus)} {}
  void publish_health();

  const char* name_;
  std::unique_ptr<transport::Bus> bus_;  ///< outlives the module
  std::unique_ptr<Module> module_;
  transport::Publisher<docent_msgs::Health> health_;
  int pid_ = 0;
  std::string handicap_;
};

}  // namespace docent::modules
