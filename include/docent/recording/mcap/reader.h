#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/recording/mcap/writer.h"

namespace docent::recording {

/// A message as it lies in a recording. Valid during the call that hands it over.
struct McapMessage {
  const McapChannel& channel;          ///< its topic and type
  Time log_time;                       ///< when it was written down
  Time publish_time;                   ///< when it was sent
  std::uint32_t sequence = 0;          ///< as the writer counted; 0: it did not
  std::span<const std::uint8_t> data;  ///< as encoded; valid until the next message
};

/// Reads MCAP files, those of others too: chunked or not, plain or zstd. By the index where there is a sound one, else
/// by walking through the records, so a file that ends early (a killed recorder) gives what it still holds. No input
/// makes it crash, hang, or take memory without bound (a chunk may unpack to 256 MiB).
class McapReader {
 public:
  /// PATH, or PATH.part where the recorder did not come to an end. Error: "FILE: …": unreadable, or not MCAP.
  [[nodiscard]] static Result<McapReader> open(const std::filesystem::path& path);
  /// From memory; `name` stands where the file's name would.
  [[nodiscard]] static Result<McapReader> from_bytes(std::vector<std::uint8_t> bytes, std::string name);
  McapReader(McapReader&&) noexcept;
  McapReader& operator=(McapReader&&) noexcept;
  ~McapReader();

  [[nodiscard]] const std::string& profile() const;  ///< as the header says
  /// False: the file has no sound end; it was cut, or the recorder killed.
  [[nodiscard]] bool is_complete() const;
  /// Messages according to the file's own statistics; nullopt without a summary.
  [[nodiscard]] std::optional<std::uint64_t> message_count() const;
  [[nodiscard]] std::map<std::string, std::uint64_t> counts_by_topic() const;  ///< likewise; empty without a summary

  /// Which messages to read.
  struct Selection {
    std::set<std::string> topics;  ///< "/scan_front"; empty: all
    std::optional<Time> from;      ///< log time, both included
    std::optional<Time> to;        ///< before this; null: to the end
    bool skip_damaged = false;     ///< leave out damaged chunks instead of failing
  };
  /// Hands over the messages in the order of their log times (of equal ones: as they lie in the file) until `handler`
  /// returns false. Error: damage in the middle of the file, with the place; what lay before it was handed over.
  [[nodiscard]] Result<void> read(const Selection& selection, const std::function<bool(const McapMessage&)>& handler);
  /// All of them.
  [[nodiscard]] Result<void> read(const std::function<bool(const McapMessage&)>& handler) { return read({}, handler); }

  /// What the last read left out, in words.
  [[nodiscard]] const std::vector<std::string>& damage() const;

 private:
  struct State;
  class Reading;
  explicit McapReader(std::unique_ptr<State> state);
  [[nodiscard]] static Result<McapReader> from_state(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace docent::recording
