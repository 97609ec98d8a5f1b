#include "docent/modules/eyes/capture_module.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "docent/base/yaml.h"
#include "docent/messages/conversions.h"
#include "docent/messages/dock_topics.h"
#include "docent/modules/eyes/camera_messages.h"
#include "docent/pictures/jpeg/jpeg.h"
#include "docent/vision/capture/video_device.h"
#include "docent/vision/lens/lens_file.h"

namespace docent::modules {
namespace {

constexpr std::array kCaptureEyes{"front", "ceiling", "head"};
constexpr std::array kCaptureFormats{"mjpeg", "yuyv"};

/// Section `capture`.
struct CaptureParams {
  bool enabled = false;                ///< the computer has a camera that no driver of ROS 2 reads
  std::string device = "/dev/video0";  ///< of the camera
  std::string eye = "front";           ///< which of the robot's it is: front, ceiling or head (for people)
  std::string format = "mjpeg";        ///< mjpeg or yuyv, as the camera has it
  int width = 640;                     ///< [pixels]
  int height = 480;                    ///< [pixels]
  double rate = 5.0;                   ///< [Hz] of its pictures, about
  std::string lens;                    ///< file of docent calibrate-camera; the head's camera needs none
  template <class V>
  void visit(V& v) {
    v("enabled", enabled);
    v("device", device);
    v("eye", eye);
    v("format", format);
    v("width", width);
    v("height", height);
    v("rate", rate);
    v("lens", lens);
  }
  [[nodiscard]] vision::VideoParams video() const {
    return {device, width, height, rate, format == "yuyv" ? vision::VideoFormat::yuyv : vision::VideoFormat::mjpeg};
  }
  [[nodiscard]] Result<void> validate() const {
    const auto is_one = [](const auto& words, const std::string& word) {
      return std::find(words.begin(), words.end(), word) != words.end();
    };
    if (!is_one(kCaptureEyes, eye)) return fail("eye must be front, ceiling or head");
    if (!is_one(kCaptureFormats, format)) return fail("format must be mjpeg or yuyv");
    if (enabled && eye != "head" && lens.empty())
      return fail("lens must name the file that docent calibrate-camera wrote");
    if (enabled && eye == "head" && format != "mjpeg") return fail("format must be mjpeg for the head's camera");
    return video().validate();
  }
};

/// What the camera's thread says of itself.
class CameraWord {
 public:
  void say(std::string word) {
    const std::lock_guard lock{mutex_};
    word_ = std::move(word);
  }
  [[nodiscard]] std::string heard() const {
    const std::lock_guard lock{mutex_};
    return word_;
  }

 private:
  mutable std::mutex mutex_;
  std::string word_ = "is not open yet";
};

class CaptureModule final : public Module {
 public:
  CaptureModule(const ModuleContext& context, const CaptureParams& params, std::optional<sensor_msgs::CameraInfo> info,
                std::unique_ptr<vision::VideoCalls> calls)
      : bus_{context.bus}, params_{params}, info_{std::move(info)}, calls_{std::move(calls)} {
    const bool is_front = params.eye == "front", is_ceiling = params.eye == "ceiling";
    if (is_front || is_ceiling) {
      infos_.emplace(bus_.publisher(is_front ? topics::kFrontInfo : topics::kCeilingInfo));
      images_.emplace(bus_.publisher(is_front ? topics::kFrontImage : topics::kCeilingImage));
    }
    if (!is_ceiling) files_.emplace(bus_.publisher(is_front ? topics::kFrontPicture : topics::kCamera));
    thread_ = std::jthread{[this](const std::stop_token& stop) { read(stop); }};
  }
  ~CaptureModule() override { *is_alive_ = false; }
  CaptureModule(const CaptureModule&) = delete;
  CaptureModule& operator=(const CaptureModule&) = delete;

  [[nodiscard]] ModuleHealth health() const override {
    std::string reason = word_.heard();
    if (reason.empty() && is_late_) reason = "its frames are " + std::to_string(late_ms_) + " ms old when they come";
    return reason.empty() ? ModuleHealth{} : ModuleHealth{"degraded", "camera " + params_.device + ": " + reason};
  }

 private:
  static constexpr int kWaitMs = 100;
  static constexpr Duration kSilent = std::chrono::milliseconds{1500};
  static constexpr std::chrono::milliseconds kTryAgain{500};
  static constexpr Duration kTooOld = std::chrono::milliseconds{500};

  /// On its own thread: opens the camera, and once more where it was lost.
  void read(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      auto device = vision::VideoDevice::open(*calls_, params_.video());
      if (!device) word_.say(device.error().message);
      if (device) stream(*device, stop);
      for (auto waited = std::chrono::milliseconds{0}; waited < kTryAgain && !stop.stop_requested();
           waited += std::chrono::milliseconds{20})
        std::this_thread::sleep_for(std::chrono::milliseconds{20});
    }
  }

  void stream(vision::VideoDevice& device, const std::stop_token& stop) {
    Duration silent{};
    while (!stop.stop_requested()) {
      auto frame = device.read(kWaitMs);
      if (!frame) return word_.say(frame.error().message);
      const bool is_whole = frame->has_value();
      silent = is_whole ? Duration{} : silent + std::chrono::milliseconds{kWaitMs};
      if (is_whole) {
        word_.say("");
        // What is posted may come after the module's end.
        bus_.post([this, alive = is_alive_, frame = std::move(**frame)]() mutable {
          if (*alive) publish(std::move(frame));
        });
      } else if (silent >= kSilent) {
        const std::uint64_t halves = device.halves();
        word_.say(halves > 0 ? "no whole frame comes; " + std::to_string(halves) +
                                   " were half: its cable, or too many "
                                   "cameras at one USB hub"
                             : "no frame comes");
      }
    }
  }

  void publish(vision::VideoFrame frame) {
    const Time now = bus_.now(), taken = now - frame.age;
    is_late_ = frame.age > kTooOld;
    late_ms_ = frame.age / std::chrono::milliseconds{1};
    if (sent_ && now - *sent_ < seconds(0.7 / params_.rate)) return;  // a camera that has only faster rates
    sent_ = now;
    const std_msgs::Header header{to_message(taken), params_.eye + "_camera"};
    if (info_) {
      info_->header = header;
      infos_->publish(*info_);
    }
    if (params_.format == "yuyv") {
      images_->publish({header, static_cast<std::uint32_t>(frame.height), static_cast<std::uint32_t>(frame.width),
                        "yuv422_yuy2", 0, static_cast<std::uint32_t>(frame.step), std::move(frame.bytes)});
    } else if (files_) {
      files_->publish({header, "jpeg", std::move(frame.bytes)});
    } else if (const auto image = pictures::decode_jpeg(frame.bytes)) {
      const auto width = static_cast<std::uint32_t>(image->width());
      images_->publish(
          {header, static_cast<std::uint32_t>(image->height()), width, "mono8", 0, width, grey_of(*image)});
    }
  }

  transport::Bus& bus_;
  CaptureParams params_;
  std::optional<sensor_msgs::CameraInfo> info_;
  std::optional<transport::Publisher<sensor_msgs::CameraInfo>> infos_;
  std::optional<transport::Publisher<sensor_msgs::Image>> images_;
  std::optional<transport::Publisher<sensor_msgs::CompressedImage>> files_;
  bool is_late_ = false;
  long late_ms_ = 0;
  std::optional<Time> sent_;
  CameraWord word_;
  std::shared_ptr<bool> is_alive_ = std::make_shared<bool>(true);  ///< of the bus's thread
  std::unique_ptr<vision::VideoCalls> calls_;
  std::jthread thread_;  ///< last: it uses all of the above
};

/// A robot whose cameras have drivers of their own.
class NoCapture final : public Module {};

Result<sensor_msgs::CameraInfo> read_info(const CaptureParams& params) {
  const auto file = YamlFile::load(params.lens);
  if (!file) return tl::unexpected<Error>(file.error());
  const auto lens = vision::read_lens(*file, file->root());
  if (!lens) return tl::unexpected<Error>(lens.error());
  if (lens->params().columns != params.width || lens->params().rows != params.height)
    return fail("capture.lens: " + params.lens + " is of pictures of another size than capture.width and height");
  return info_of(lens->params());
}

}  // namespace

Result<std::unique_ptr<Module>> make_capture(const ModuleContext& context) {
  return make_capture_with(context, vision::kernel_video_calls());
}

Result<std::unique_ptr<Module>> make_capture_with(const ModuleContext& context,
                                                  std::unique_ptr<vision::VideoCalls> calls) {
  auto params = context.config.section<CaptureParams>("capture");
  if (!params) return tl::unexpected<Error>(params.error());
  if (!params->enabled) return std::make_unique<NoCapture>();
  std::optional<sensor_msgs::CameraInfo> info;
  if (params->eye != "head") {
    auto read = read_info(*params);
    if (!read) return tl::unexpected<Error>(read.error());
    info = std::move(*read);
  }
  return std::make_unique<CaptureModule>(context, *params, std::move(info), std::move(calls));
}

Result<robot::ParameterRows> parameters_of_capture(const robot::RobotConfig& config) {
  return robot::list_parameters<CaptureParams>(config, "capture");
}

}  // namespace docent::modules
