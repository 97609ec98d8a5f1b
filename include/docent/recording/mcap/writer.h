#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>

#include "docent/base/result.h"
#include "docent/base/time.h"

namespace docent::recording {

/// A channel of a recording: one topic with its type.
struct McapChannel {
  std::string topic;                            ///< "/scan_front"
  std::string type;                             ///< "sensor_msgs/msg/LaserScan"
  std::string schema_encoding;                  ///< "ros2msg"
  std::string schema;                           ///< the text of the type
  std::string encoding;                         ///< of the messages: "cdr"
  std::map<std::string, std::string> metadata;  ///< as MCAP has it
  friend bool operator==(const McapChannel&, const McapChannel&) = default;
};

/// How a file is written.
struct McapWriterOptions {
  std::size_t chunk_bytes = 1U << 20U;            ///< a chunk is closed at this size …
  Duration chunk_time = std::chrono::seconds{1};  ///< … or when its messages span this time
  bool compress = true;                           ///< zstd, level 1
  std::string library = "docent";                 ///< that wrote it, in the header
};

/// Writes an MCAP file (mcap.dev/spec): profile ros2, chunks, message index, summary with statistics, all checksums.
///
/// PATH.part grows and is named PATH when it is closed: that is always whole. What a killed writer leaves lacks at most
/// the last chunk; `McapReader` reads it, `recover_mcap` makes a file of it. Devices and pipes are written into.
class McapWriter {
 public:
  using Channel = std::uint16_t;  ///< a number of this file

  /// Error: the file cannot be made.
  [[nodiscard]] static Result<McapWriter> create(const std::filesystem::path& path,
                                                 const McapWriterOptions& options = {});
  McapWriter(McapWriter&&) noexcept;
  McapWriter& operator=(McapWriter&&) noexcept;
  /// Closes; errors are lost, so call close() where they matter.
  ~McapWriter();

  /// Channels with the same type share one schema. Error: more than 65,534 channels.
  [[nodiscard]] Result<Channel> add_channel(const McapChannel& channel);
  /// Error: the disk is full or gone; the message is lost and the file stays readable up to the last chunk.
  /// @pre time >= 0
  [[nodiscard]] Result<void> write(Channel channel, Time log_time, Time publish_time,
                                   std::span<const std::uint8_t> data);
  /// Puts what is pending on the disk.
  [[nodiscard]] Result<void> flush();
  /// Writes index and summary and gives the file its name. Afterwards nothing else may be called.
  [[nodiscard]] Result<void> close();

  [[nodiscard]] std::uint64_t messages() const;       ///< written so far
  [[nodiscard]] std::uint64_t bytes_written() const;  ///< to the file so far

 private:
  struct State;
  explicit McapWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// PATH.part, where the writer of PATH writes; beside its file where PATH is a link.
[[nodiscard]] std::filesystem::path unfinished_path(const std::filesystem::path& path);

}  // namespace docent::recording
