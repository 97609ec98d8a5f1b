#pragma once

#include <linux/videodev2.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <deque>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "docent/vision/capture/video_calls.h"

namespace docent::vision::fed_video {

/// A camera that a test feeds: what it has been given waits in its buffers, as a kernel's driver has it. Any thread.
class FedVideo final : public VideoCalls {
 public:
  /// A frame from now on. @param age  [ms] since it was taken
  void feed(std::vector<std::uint8_t> bytes, int age = 10, bool is_marked = false) {
    const std::lock_guard lock{mutex_};
    frames_.push_back({std::move(bytes), age, is_marked});
  }
  void unplug() { is_there_ = false; }
  void plug() { is_there_ = true; }

  std::uint32_t formats = V4L2_PIX_FMT_YUYV;  ///< the one that it has
  std::uint32_t width = 64, height = 48;
  std::uint32_t padding = 0;  ///< [bytes] behind each row
  std::uint32_t capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  std::atomic<int> opened{0}, mapped{0};

  [[nodiscard]] int open(const std::string& path) override {
    if (!is_there_ || path != "/dev/video7") return refuse(ENOENT);
    ++opened;
    return 7;
  }
  void close(int) override { --opened; }
  [[nodiscard]] int control(int, unsigned long request, void* argument) override {
    if (!is_there_) return refuse(ENODEV);
    const std::lock_guard lock{mutex_};
    switch (request) {
      case VIDIOC_QUERYCAP:
        static_cast<v4l2_capability*>(argument)->capabilities = capabilities;
        return 0;
      case VIDIOC_S_FMT: {
        auto& pix = static_cast<v4l2_format*>(argument)->fmt.pix;
        pix.pixelformat = formats;
        pix.width = width, pix.height = height;
        pix.bytesperline = formats == V4L2_PIX_FMT_YUYV ? 2 * width + padding : 0;
        return 0;
      }
      case VIDIOC_REQBUFS:
        memory_.assign(static_cast<v4l2_requestbuffers*>(argument)->count, std::vector<std::uint8_t>(1 << 16));
        free_.clear();
        return 0;
      case VIDIOC_QUERYBUF: {
        auto& buffer = *static_cast<v4l2_buffer*>(argument);
        buffer.length = static_cast<std::uint32_t>(memory_[buffer.index].size());
        buffer.m.offset = buffer.index;
        return 0;
      }
      case VIDIOC_QBUF:
        free_.push_back(static_cast<v4l2_buffer*>(argument)->index);
        return 0;
      case VIDIOC_DQBUF:
        return take(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_STREAMON:
      case VIDIOC_STREAMOFF:
        return 0;
      default:
        return refuse(EINVAL);
    }
  }
  [[nodiscard]] void* map(int, std::size_t, std::size_t offset) override {
    ++mapped;
    return memory_[offset].data();
  }
  void unmap(void*, std::size_t) override { --mapped; }
  [[nodiscard]] int wait(int, int milliseconds) override {
    for (int i = 0; i <= milliseconds; ++i) {
      if (!is_there_) return refuse(ENODEV);
      {
        const std::lock_guard lock{mutex_};
        if (!frames_.empty()) return 1;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds{1});
    }
    return 0;
  }
  [[nodiscard]] long long clock() const override { return kNow; }

 private:
  static constexpr long long kNow = 100'000'000'000;  // [ns]
  struct Frame {
    std::vector<std::uint8_t> bytes;
    int age = 0;
    bool is_marked = false;
  };
  static int refuse(int number) {
    errno = number;
    return -1;
  }
  int take(v4l2_buffer& buffer) {
    if (frames_.empty() || free_.empty()) return refuse(EAGAIN);
    const Frame frame = std::move(frames_.front());
    frames_.pop_front();
    buffer.index = free_.front();
    free_.pop_front();
    std::memcpy(memory_[buffer.index].data(), frame.bytes.data(), frame.bytes.size());
    buffer.bytesused = static_cast<std::uint32_t>(frame.bytes.size());
    buffer.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | (frame.is_marked ? V4L2_BUF_FLAG_ERROR : 0U);
    const long long taken = kNow - 1'000'000LL * frame.age;
    buffer.timestamp.tv_sec = taken / 1'000'000'000;
    buffer.timestamp.tv_usec = taken % 1'000'000'000 / 1000;
    return 0;
  }

  std::atomic<bool> is_there_{true};
  std::mutex mutex_;
  std::deque<Frame> frames_;
  std::deque<std::uint32_t> free_;
  std::vector<std::vector<std::uint8_t>> memory_;
};

}  // namespace docent::vision::fed_video
