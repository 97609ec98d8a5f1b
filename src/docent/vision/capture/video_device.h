#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/vision/capture/video_calls.h"

namespace docent::vision {

/// How the pixels of a camera come.
enum class VideoFormat {
  mjpeg,  ///< a JPEG file each
  yuyv    ///< 16 bits a pixel: Y U Y V
};

struct VideoParams {
  std::string device = "/dev/video0";
  int width = 640;   ///< [pixels] > 0
  int height = 480;  ///< [pixels] > 0
  double rate = 10;  ///< [Hz] > 0
  VideoFormat format = VideoFormat::mjpeg;
  [[nodiscard]] Result<void> validate() const;
};

/// A frame that is whole.
struct VideoFrame {
  int width = 0, height = 0;        ///< [pixels]
  std::size_t step = 0;             ///< [bytes] from row to row; 0 of a JPEG file
  Duration age{};                   ///< since it was taken, as the kernel says
  std::vector<std::uint8_t> bytes;  ///< [height * step], or the file
};

/// A camera that streams into mapped memory. What is not whole is left out and counted. One thread.
class VideoDevice {
 public:
  /// Error: none there, no camera, one that is busy, or has not what is asked for. `calls` must outlive it.
  [[nodiscard]] static Result<VideoDevice> open(VideoCalls& calls, const VideoParams& params);
  VideoDevice(VideoDevice&&) noexcept;
  VideoDevice& operator=(VideoDevice&&) = delete;
  ~VideoDevice();

  /// The newest frame; waits so long [ms] for one. nullopt: none came, or half of one. Error: the camera is gone, and
  /// must be opened anew.
  [[nodiscard]] Result<std::optional<VideoFrame>> read(int milliseconds);
  /// Frames so far that were not whole.
  [[nodiscard]] std::uint64_t halves() const { return halves_; }

 private:
  struct Buffer {
    void* memory = nullptr;
    std::size_t length = 0;
  };
  VideoDevice(VideoCalls& calls, int descriptor, const VideoParams& params)
      : calls_{&calls}, descriptor_{descriptor}, params_{params} {}
  Result<void> agree();
  Result<void> start();
  [[nodiscard]] bool is_whole(const std::uint8_t* bytes, std::size_t size, bool is_marked) const;

  VideoCalls* calls_;
  int descriptor_;
  VideoParams params_;
  int width_ = 0, height_ = 0;
  std::size_t step_ = 0;
  std::vector<Buffer> buffers_;
  bool streams_ = false;
  std::uint64_t halves_ = 0;
};

}  // namespace docent::vision
