#include "docent/vision/capture/video_device.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

namespace docent::vision {
namespace {

constexpr std::uint32_t kBuffers = 4;
constexpr std::uint32_t kCapture = V4L2_BUF_TYPE_VIDEO_CAPTURE;
constexpr int kMostPixels = 4096;

std::uint32_t code_of(VideoFormat format) {
  return format == VideoFormat::mjpeg ? V4L2_PIX_FMT_MJPEG : V4L2_PIX_FMT_YUYV;
}

std::string why() { return std::strerror(errno); }

v4l2_buffer buffer_of(std::uint32_t index) {
  v4l2_buffer buffer{};
  buffer.type = kCapture;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = index;
  return buffer;
}

}  // namespace

Result<void> VideoParams::validate() const {
  constexpr double kFastest = 120.0;
  if (device.empty()) return fail("device must be the path of a camera, such as /dev/video0");
  if (!(width > 0 && height > 0 && width <= kMostPixels && height <= kMostPixels))
    return fail("width and height must be 1..4096");
  if (!(rate > 0.0 && rate <= kFastest)) return fail("rate must be above 0 and at most 120");
  return {};
}

Result<VideoDevice> VideoDevice::open(VideoCalls& calls, const VideoParams& params) {
  const int descriptor = calls.open(params.device);
  if (descriptor < 0) return fail(params.device + " cannot be opened: " + why());
  VideoDevice device{calls, descriptor, params};
  if (auto agreed = device.agree(); !agreed) return tl::unexpected<Error>(agreed.error());
  if (auto started = device.start(); !started) return tl::unexpected<Error>(started.error());
  return device;
}

VideoDevice::VideoDevice(VideoDevice&& other) noexcept
    : calls_{other.calls_},
      descriptor_{std::exchange(other.descriptor_, -1)},
      params_{std::move(other.params_)},
      width_{other.width_},
      height_{other.height_},
      step_{other.step_},
      buffers_{std::exchange(other.buffers_, {})},
      streams_{std::exchange(other.streams_, false)},
      halves_{other.halves_} {}

VideoDevice::~VideoDevice() {
  if (descriptor_ < 0) return;
  std::uint32_t type = kCapture;
  if (streams_) (void)calls_->control(descriptor_, VIDIOC_STREAMOFF, &type);
  for (const Buffer& buffer : buffers_) calls_->unmap(buffer.memory, buffer.length);
  calls_->close(descriptor_);
}

/// Size, format and rate: the device may change what it is asked for, and says so.
Result<void> VideoDevice::agree() {
  const std::string name = params_.device;
  v4l2_capability can{};
  if (calls_->control(descriptor_, VIDIOC_QUERYCAP, &can) != 0) return fail(name + " is no camera: " + why());
  const std::uint32_t has = (can.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? can.device_caps : can.capabilities;
  if ((has & V4L2_CAP_VIDEO_CAPTURE) == 0 || (has & V4L2_CAP_STREAMING) == 0)
    return fail(name + " gives no pictures that stream: another of /dev/video* may");
  v4l2_format format{};
  format.type = kCapture;
  format.fmt.pix.width = static_cast<std::uint32_t>(params_.width);
  format.fmt.pix.height = static_cast<std::uint32_t>(params_.height);
  format.fmt.pix.pixelformat = code_of(params_.format);
  format.fmt.pix.field = V4L2_FIELD_ANY;
  if (calls_->control(descriptor_, VIDIOC_S_FMT, &format) != 0) return fail(name + " takes no format: " + why());
  if (format.fmt.pix.pixelformat != code_of(params_.format))
    return fail(name + " has no " + (params_.format == VideoFormat::mjpeg ? "MJPEG" : "YUYV") + ": try the other");
  width_ = static_cast<int>(format.fmt.pix.width), height_ = static_cast<int>(format.fmt.pix.height);
  if (width_ != params_.width || height_ != params_.height)
    return fail(name + " gives " + std::to_string(width_) + " x " + std::to_string(height_) + " pixels, not " +
                std::to_string(params_.width) + " x " + std::to_string(params_.height));
  if (params_.format == VideoFormat::yuyv)
    step_ = std::max<std::size_t>(format.fmt.pix.bytesperline, 2 * static_cast<std::size_t>(width_));
  v4l2_streamparm stream{};
  stream.type = kCapture;
  stream.parm.capture.timeperframe = {1000U, static_cast<std::uint32_t>(std::lround(1000.0 * params_.rate))};
  (void)calls_->control(descriptor_, VIDIOC_S_PARM, &stream);  // one that has but one rate has that
  return {};
}

Result<void> VideoDevice::start() {
  const std::string name = params_.device;
  v4l2_requestbuffers request{};
  request.count = kBuffers;
  request.type = kCapture;
  request.memory = V4L2_MEMORY_MMAP;
  if (calls_->control(descriptor_, VIDIOC_REQBUFS, &request) != 0 || request.count < 2)
    return fail(name + " has no memory for frames, or another program reads it: " + why());
  for (std::uint32_t i = 0; i < request.count; ++i) {
    v4l2_buffer buffer = buffer_of(i);
    if (calls_->control(descriptor_, VIDIOC_QUERYBUF, &buffer) != 0) return fail(name + ": " + why());
    void* memory = calls_->map(descriptor_, buffer.length, buffer.m.offset);
    if (memory == nullptr) return fail(name + ": its memory cannot be mapped: " + why());
    buffers_.push_back({memory, buffer.length});
    if (calls_->control(descriptor_, VIDIOC_QBUF, &buffer) != 0) return fail(name + ": " + why());
  }
  std::uint32_t type = kCapture;
  if (calls_->control(descriptor_, VIDIOC_STREAMON, &type) != 0) return fail(name + " does not stream: " + why());
  streams_ = true;
  return {};
}

bool VideoDevice::is_whole(const std::uint8_t* bytes, std::size_t size, bool is_marked) const {
  if (is_marked) return false;
  if (params_.format == VideoFormat::yuyv) return size >= step_ * static_cast<std::size_t>(height_);
  // A JPEG file begins with FF D8 and ends with FF D9, behind which cameras may leave zeros.
  constexpr std::uint8_t kMark = 0xFF, kBegin = 0xD8, kEnd = 0xD9;
  if (size < 4 || bytes[0] != kMark || bytes[1] != kBegin) return false;
  while (size > 2 && bytes[size - 1] == 0) --size;
  return bytes[size - 2] == kMark && bytes[size - 1] == kEnd;
}

Result<std::optional<VideoFrame>> VideoDevice::read(int milliseconds) {
  const auto gone = [&] { return fail(params_.device + " is gone: " + why()); };
  const int found = calls_->wait(descriptor_, milliseconds);
  if (found < 0) return gone();
  if (found == 0) return std::optional<VideoFrame>{};
  std::optional<VideoFrame> newest;
  // Whoever was slow wants no old frames.
  for (std::size_t i = 0; i <= buffers_.size(); ++i) {
    v4l2_buffer buffer = buffer_of(0);
    if (calls_->control(descriptor_, VIDIOC_DQBUF, &buffer) != 0) {
      if (errno == EAGAIN) break;
      if (errno != EIO) return gone();
      ++halves_;  // the frame is lost, and the device goes on
      break;
    }
    if (buffer.index >= buffers_.size()) return fail(params_.device + " names memory that it has not");
    const Buffer& at = buffers_[buffer.index];
    const auto* bytes = static_cast<const std::uint8_t*>(at.memory);
    const std::size_t size = std::min<std::size_t>(buffer.bytesused, at.length);
    if (is_whole(bytes, size, (buffer.flags & V4L2_BUF_FLAG_ERROR) != 0)) {
      const bool is_file = params_.format == VideoFormat::mjpeg;
      const std::size_t used = is_file ? size : step_ * static_cast<std::size_t>(height_);
      VideoFrame frame{width_, height_, step_, {}, {bytes, bytes + used}};
      if ((buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC) {
        const long long taken = 1000000000LL * buffer.timestamp.tv_sec + 1000LL * buffer.timestamp.tv_usec;
        frame.age = std::max(Duration{0}, Duration{calls_->clock() - taken});
      }
      newest = std::move(frame);
    } else {
      ++halves_;
    }
    if (calls_->control(descriptor_, VIDIOC_QBUF, &buffer) != 0) return gone();
  }
  return newest;
}

}  // namespace docent::vision
