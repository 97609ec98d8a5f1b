#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "docent/messages/conversions.h"
#include "docent/modules/shared/module.h"
#include "docent/transport/virtual_time_bus.h"

// For tests of one module: it is alone on a bus of virtual time, and the test says and hears all the rest.

namespace docent::modules {

class ModuleBench : public ::testing::Test {
 protected:
  ModuleBench(std::string name, ModuleFactory make) : name_{std::move(name)}, make_{make} {
    std::filesystem::remove_all(state);
    std::filesystem::create_directories(state);
  }
  ~ModuleBench() override {
    kill();
    std::filesystem::remove_all(state);
  }

  /// A new process of the module, in place of the one before.
  void start() {
    kill();
    bus_ = hub.connect(name_);
    auto made = make_({*bus_, museum, config, state, 1, true});
    ASSERT_TRUE(made) << made.error().message;
    module = std::move(*made);
  }
  void kill() {
    module.reset();
    bus_.reset();
  }
  void run(double duration) { hub.run_until(hub.now() + seconds(duration)); }
  [[nodiscard]] double now_s() const { return to_seconds(hub.now() - Time{}); }

  /// `last` will hold the last message of a topic, and `count` how many there were.
  template <class T>
  void keep(const Topic<T>& topic, T& last, int& count) {
    world->subscribe(topic, std::function<void(const T&)>{[&last, &count](const T& message) {
                       last = message;
                       ++count;
                     }});
  }

  transport::VirtualTimeHub hub;
  museum::Museum museum;
  robot::RobotConfig config;
  std::filesystem::path state = std::filesystem::temp_directory_path() / ("docent_module_" + std::to_string(getpid()));
  std::unique_ptr<transport::Bus> world = hub.connect("world");
  std::unique_ptr<Module> module;

 private:
  std::string name_;
  ModuleFactory make_;
  std::unique_ptr<transport::Bus> bus_;
};

}  // namespace docent::modules
