#include "docent/modules/edge/record_module.h"

#include <thread>

#include "docent/recording/mcap/recovery.h"
#include "docent/recording/rolling_recorder.h"

namespace docent::modules {
namespace {

constexpr Duration kFlushPeriod = std::chrono::seconds{1};
constexpr double kFaultShown = 5.0;  ///< [s] that a failed write shows in the health

/// Section `record`: recordings of all topics.
struct RecordParams {
  bool enabled = true;    ///< false: nothing is recorded
  bool pictures = false;  ///< those of the cameras too: some 50 kB a second
  recording::RollingRecorderParams files;
  template <class V>
  void visit(V& v) {
    v("enabled", enabled);
    v("pictures", pictures);
    files.visit(v);
  }
  [[nodiscard]] Result<void> validate() const { return files.validate(); }
};

bool is_picture(const transport::TopicInfo& topic) {
  const std::string_view name = topic.name;
  return name == topics::kCamera.name || name == topics::kSceneCamera.name || name == topics::kCameraImage.name ||
         name == topics::kSceneCameraImage.name || name == topics::kDepthImage.name ||
         name == topics::kCeilingImage.name;
}

class RecordModule final : public Module {
 public:
  RecordModule(const ModuleContext& context, const RecordParams& params)
      : bus_{context.bus}, recorder_{context.state / "recordings", params.files} {
    // What a killed recorder left is made whole beside the work: it may take seconds.
    const auto left = recording::RollingRecorder::unfinished(context.state / "recordings");
    recovery_ = std::jthread{[left](const std::stop_token& stop) {
      for (const auto& part : left) {
        if (stop.stop_requested()) return;
        const std::filesystem::path whole = std::filesystem::path{part}.replace_extension();
        // One without even a header can never be read.
        if (!recording::recover_mcap(part, whole)) std::filesystem::rename(part, part.string() + ".unreadable");
      }
    }};
    // A picture that nobody wants shall not even come here: those that are not compressed are some 30 MB a second.
    recording::subscribe_robot_topics(
        bus_, [this](const auto& topic, const auto& message) { write(topic, message); },
        [pictures = params.pictures](const transport::TopicInfo& topic) { return pictures || !is_picture(topic); });
    if (context.truth != nullptr) {
      const std::weak_ptr<RecordModule*> self = self_;
      recording::subscribe_truth_topics(*context.truth,
                                        [self, &bus = bus_](const transport::TopicInfo& topic, const auto& message) {
                                          bus.post([self, topic, message] {
                                            if (const auto module = self.lock()) (*module)->write(topic, message);
                                          });
                                        });
    }
    bus_.every(kFlushPeriod, [this] { note(recorder_.flush()); });
  }

  [[nodiscard]] ModuleHealth health() const override {
    if (!fault_.empty() && to_seconds(bus_.now() - fault_time_) < kFaultShown) return {"degraded", fault_};
    return {};
  }

 private:
  void write(const transport::TopicInfo& topic, const std::shared_ptr<const void>& message) {
    note(recorder_.write(topic, bus_.now(), message));
  }
  void note(const Result<void>& result) {
    if (result) return;
    fault_ = result.error().message;
    fault_time_ = bus_.now();
  }

  transport::Bus& bus_;
  recording::RollingRecorder recorder_;
  std::string fault_;
  Time fault_time_{};
  std::shared_ptr<RecordModule*> self_ = std::make_shared<RecordModule*>(this);
  std::jthread recovery_;
};

class NoRecording final : public Module {};

}  // namespace

Result<std::unique_ptr<Module>> make_record(const ModuleContext& context) {
  const auto params = context.config.section<RecordParams>("record");
  if (!params) return tl::unexpected<Error>(params.error());
  if (!params->enabled || context.virtual_time) return std::make_unique<NoRecording>();
  return std::make_unique<RecordModule>(context, *params);
}

Result<robot::ParameterRows> parameters_of_record(const robot::RobotConfig& config) {
  return robot::list_parameters<RecordParams>(config, "record");
}

}  // namespace docent::modules
