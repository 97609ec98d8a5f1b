#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace docent::web_load {

/// How a viewer reads.
enum class Pace { prompt, slow, never };

/// One viewer of the live channel: a bare socket, so that ten thousand cost little and can misbehave.
class Viewer {
 public:
  /// Begins to connect; nothing blocks. `is_broken()` tells whether that failed.
  Viewer(int port, std::string_view path, Pace pace);
  Viewer(Viewer&& other) noexcept;
  Viewer& operator=(Viewer&&) = delete;
  ~Viewer();

  [[nodiscard]] int descriptor() const { return descriptor_; }
  [[nodiscard]] Pace pace() const { return pace_; }
  [[nodiscard]] bool is_open() const { return is_open_; }
  [[nodiscard]] bool is_broken() const { return descriptor_ < 0; }
  /// Sends the handshake once the socket is connected.
  void greet();
  /// Reads at most `most` bytes and appends the texts that are complete.
  void read(std::size_t most, std::vector<std::string>& texts);

 private:
  void close();
  /// The next complete frame; false: there is none yet.
  bool take_frame(std::vector<std::string>& texts);

  int descriptor_ = -1;
  Pace pace_;
  std::string path_;
  std::string buffer_;
  bool has_greeted_ = false;
  bool is_open_ = false;
};

}  // namespace docent::web_load
