#include "docent/modules/guide/buttons_module.h"

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "docent/interaction/kiosk/button_device.h"
#include "docent/interaction/kiosk/button_stream.h"
#include "docent/messages/conversions.h"
#include "docent/modules/shared/stop_keeper.h"

namespace docent::modules {
namespace {

/// Reads the device on a thread of its own, and opens it again whenever it is gone.
class DeviceReader {
 public:
  /// `bytes` came; `fault`: the device is not there. Called on the reader's thread.
  struct Listener {
    std::function<void(std::string bytes)> bytes;
    std::function<void(std::string fault)> fault;
  };

  DeviceReader(interaction::ButtonParams params, Listener listener)
      : params_{std::move(params)}, listener_{std::move(listener)}, thread_{[this] { work(); }} {}
  DeviceReader(const DeviceReader&) = delete;
  DeviceReader& operator=(const DeviceReader&) = delete;
  ~DeviceReader() {
    {
      const std::scoped_lock lock{mutex_};
      is_ending_ = true;
    }
    wake_.notify_one();
    thread_.join();
  }

 private:
  [[nodiscard]] bool is_ending() {
    const std::scoped_lock lock{mutex_};
    return is_ending_;
  }
  void work() {
    while (!is_ending()) {
      auto device = interaction::ButtonDevice::open(params_);
      listener_.fault(device ? "" : device.error().message);
      if (device) follow(*device);
      std::unique_lock lock{mutex_};
      wake_.wait_for(lock, seconds(params_.retry), [this] { return is_ending_; });
    }
  }
  void follow(interaction::ButtonDevice& device) {
    constexpr Duration kPatience = std::chrono::milliseconds{100};  // so long the end may have to wait
    while (!is_ending()) {
      auto bytes = device.read(kPatience);
      if (!bytes) return listener_.fault(bytes.error().message);
      if (!bytes->empty()) listener_.bytes(std::move(*bytes));
    }
  }

  const interaction::ButtonParams params_;
  const Listener listener_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool is_ending_ = false;
  std::thread thread_;  ///< last: it uses all of the above
};

class ButtonsModule final : public Module {
 public:
  ButtonsModule(const ModuleContext& context, const interaction::ButtonParams& params,
                const interaction::ButtonCodes& codes)
      : bus_{context.bus}, stream_{codes, seconds(params.debounce)}, presses_{bus_.publisher(topics::kButton)} {
    if (context.virtual_time || !params.is_configured()) return;
    if (codes.stop) stop_.emplace(context, "buttons", [] {});
    // The reader outlives no module: what it posts late finds the guard gone.
    const std::weak_ptr<ButtonsModule*> guard = guard_;
    const auto post = [&bus = bus_, guard](void (ButtonsModule::*take)(const std::string&)) {
      return [&bus, guard, take](std::string text) {
        bus.post([guard, take, text = std::move(text)] {
          if (const auto self = guard.lock()) ((*self)->*take)(text);
        });
      };
    };
    reader_ = std::make_unique<DeviceReader>(
        params, DeviceReader::Listener{post(&ButtonsModule::on_bytes), post(&ButtonsModule::on_fault)});
  }

  [[nodiscard]] ModuleHealth health() const override {
    if (!fault_.empty()) return {"degraded", (stop_ ? "no buttons and no stop key: " : "no buttons: ") + fault_};
    return stop_ ? stop_->health() : ModuleHealth{};
  }

 private:
  void on_bytes(const std::string& bytes) {
    for (const int number : stream_.take(bytes, bus_.now())) {
      if (number == interaction::kStopKey) {
        stop_->button().press("the stop key");
        stop_->tell();
      } else {
        presses_.publish({{to_message(bus_.now()), ""}, number});
      }
    }
  }
  void on_fault(const std::string& fault) {
    fault_ = fault;
    stream_.reset();
  }

  transport::Bus& bus_;
  interaction::ButtonStream stream_;
  transport::Publisher<docent_msgs::Button> presses_;
  std::optional<StopKeeper> stop_;  ///< where there is a stop key
  std::string fault_;
  std::shared_ptr<ButtonsModule*> guard_ = std::make_shared<ButtonsModule*>(this);
  std::unique_ptr<DeviceReader> reader_;  ///< last: its thread ends first
};

}  // namespace

Result<std::unique_ptr<Module>> make_buttons(const ModuleContext& context) {
  auto params = context.config.section<interaction::ButtonParams>("buttons");
  if (!params) return tl::unexpected<Error>(params.error());
  auto codes = interaction::button_codes(params->keys, params->stop_key);
  if (!codes) return tl::unexpected<Error>(codes.error());
  return std::make_unique<ButtonsModule>(context, *params, *codes);
}

Result<robot::ParameterRows> parameters_of_buttons(const robot::RobotConfig& config) {
  return robot::list_parameters<interaction::ButtonParams>(config, "buttons");
}

}  // namespace docent::modules
