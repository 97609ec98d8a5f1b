#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace docent::vision {

/// The system calls by which a camera is read; they fail as the kernel's do, with errno. A test stands for the kernel.
class VideoCalls {
 public:
  VideoCalls() = default;
  VideoCalls(const VideoCalls&) = delete;
  VideoCalls& operator=(const VideoCalls&) = delete;
  virtual ~VideoCalls() = default;

  /// @returns a descriptor; -1: errno says why
  [[nodiscard]] virtual int open(const std::string& path) = 0;
  virtual void close(int descriptor) = 0;
  /// @param argument  the request's structure of linux/videodev2.h. @returns 0; -1: errno says why
  [[nodiscard]] virtual int control(int descriptor, unsigned long request, void* argument) = 0;
  /// @returns nullptr: errno says why
  [[nodiscard]] virtual void* map(int descriptor, std::size_t length, std::size_t offset) = 0;
  virtual void unmap(void* memory, std::size_t length) = 0;
  /// @returns 1 a frame may be there, 0 none within the time, -1 errno says why
  [[nodiscard]] virtual int wait(int descriptor, int milliseconds) = 0;
  /// [ns] of the clock by which the kernel stamps frames (CLOCK_MONOTONIC).
  [[nodiscard]] virtual long long clock() const = 0;
};

/// Those of the kernel.
[[nodiscard]] std::unique_ptr<VideoCalls> kernel_video_calls();

}  // namespace docent::vision
