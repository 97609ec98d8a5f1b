#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "docent/messages/operation_messages.h"
#include "docent/messages/stop_button/stop_register.h"
#include "docent/modules/shared/module.h"
#include "docent/robot/write_behind.h"

namespace docent::modules {

/// One process's copy of the stop button, on the bus and in a file of its own (STATE/stops/NAME). Its file is written
/// behind: what the others hold is what counts.
class StopKeeper {
 public:
  /// @param name     no other keeper's on this bus; the file's is what stands before its first slash
  /// @param changed  called when `holds` or the state may have changed. The bus outlives it.
  StopKeeper(const ModuleContext& context, std::string name, std::function<void()> changed);

  [[nodiscard]] bool holds() const { return register_.holds(bus_.now()); }
  [[nodiscard]] StopRegister& button() { return register_; }
  [[nodiscard]] const StopRegister& button() const { return register_; }
  /// After the button was pressed or released: at once, not with the next repetition.
  void tell();
  /// Why the file does not hold it, or that it asks still; empty: all is well.
  [[nodiscard]] ModuleHealth health() const;

 private:
  void keep();
  void hear(const docent_msgs::Stop& stop);

  transport::Bus& bus_;
  const std::filesystem::path file_;
  std::string read_fault_;
  StopRegister register_;
  StopState kept_;  ///< as the file holds it, or soon will
  const std::function<void()> changed_;
  transport::Publisher<docent_msgs::Stop> says_;
  bool held_ = true;
  robot::WriteBehind writer_;
};

/// For modules that keep no copy: whether the robot is stopped, of what all keepers say.
class StopView {
 public:
  /// @returns whether the robot is stopped now
  bool see(const docent_msgs::Stop& stop);

 private:
  StopState state_;
};

}  // namespace docent::modules
