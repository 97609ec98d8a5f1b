#include "docent/recording/mcap/writer.h"

#include <unistd.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <vector>

#include "docent/base/check.h"
#include "docent/base/destination.h"
#include "docent/recording/mcap/format.h"

namespace docent::recording {
namespace {

using mcap::ByteWriter;
using mcap::Kind;

constexpr int kCompressionLevel = 1;

std::uint32_t crc_of(const std::vector<std::uint8_t>& bytes, std::uint32_t before = 0) {
  return static_cast<std::uint32_t>(crc32_z(before, bytes.data(), bytes.size()));
}

struct IndexEntry {
  std::uint64_t time;
  std::uint64_t offset;  ///< in the uncompressed chunk
};

/// What the summary says of one chunk.
struct ChunkEntry {
  std::uint64_t first_time = 0;
  std::uint64_t last_time = 0;
  std::uint64_t start = 0;
  std::uint64_t length = 0;
  std::map<std::uint16_t, std::uint64_t> index_offsets;
  std::uint64_t index_length = 0;
  std::uint64_t compressed_size = 0;
  std::uint64_t size = 0;
};

}  // namespace

std::filesystem::path unfinished_path(const std::filesystem::path& path) {
  const auto to = destination_of(path);
  return (to ? to->path : path).string() + ".part";
}

struct McapWriter::State {
  std::filesystem::path path;
  Destination to;
  McapWriterOptions options;
  int file = -1;
  bool failed = false;
  std::uint64_t position = 0;
  std::uint32_t data_crc = 0;

  std::vector<std::uint8_t> chunk;
  std::map<std::uint16_t, std::vector<IndexEntry>> chunk_index;
  std::uint64_t chunk_first = 0;
  std::uint64_t chunk_last = 0;

  std::vector<std::uint8_t> schemas;  ///< their records, once more for the summary
  std::vector<std::uint8_t> channels;
  std::map<std::pair<std::string, std::string>, std::uint16_t> schema_ids;
  std::uint16_t channel_count = 0;
  std::vector<std::uint32_t> sequences;
  std::map<std::uint16_t, std::uint64_t> counts;
  std::vector<ChunkEntry> chunks;
  std::uint64_t messages = 0;
  std::uint64_t first_time = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t last_time = 0;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (file >= 0) ::close(file);
  }

  [[nodiscard]] Result<void> put(const std::vector<std::uint8_t>& bytes) {
    if (failed) return fail(path.string() + ": the recording has failed before");
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t written = ::write(file, bytes.data() + done, bytes.size() - done);
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) {
        const int reason = errno;
        // Half a chunk would hide whatever came after it, and a stream takes nothing back.
        failed = to.is_stream || ::ftruncate(file, static_cast<off_t>(position)) != 0 ||
                 ::lseek(file, static_cast<off_t>(position), SEEK_SET) < 0;
        return fail(path.string() + ": cannot be written: " + std::strerror(reason));
      }
      done += static_cast<std::size_t>(written);
    }
    position += bytes.size();
    data_crc = crc_of(bytes, data_crc);
    return {};
  }
  [[nodiscard]] Result<void> flush_chunk();
  [[nodiscard]] ChunkEntry append_chunk(std::vector<std::uint8_t>& out, const std::vector<std::uint8_t>& content) const;
  void begin_chunk(bool is_written);
  [[nodiscard]] Result<void> finish();
  void append_statistics(ByteWriter& writer) const;
  void append_chunk_index(ByteWriter& writer, const ChunkEntry& entry) const;
  [[nodiscard]] std::vector<std::uint8_t> summary() const;
};

/// A chunk of this content with its message indices. @returns what the summary says of it
ChunkEntry McapWriter::State::append_chunk(std::vector<std::uint8_t>& out,
                                           const std::vector<std::uint8_t>& content) const {
  ChunkEntry entry;
  entry.first_time = chunk_first;
  entry.last_time = chunk_last;
  entry.start = position;
  entry.size = chunk.size();
  entry.compressed_size = content.size();
  ByteWriter writer{out};
  const std::size_t begun = writer.begin(Kind::chunk);
  writer.number(entry.first_time);
  writer.number(entry.last_time);
  writer.number(entry.size);
  writer.number(crc_of(chunk));
  writer.text(options.compress ? "zstd" : "");
  writer.number(entry.compressed_size);
  writer.raw(content.data(), content.size());
  writer.end(begun);
  entry.length = out.size();
  for (const auto& [channel, entries] : chunk_index) {
    entry.index_offsets[channel] = position + out.size();
    const std::size_t index_begun = writer.begin(Kind::message_index);
    writer.number(channel);
    writer.number(static_cast<std::uint32_t>(entries.size() * sizeof(IndexEntry)));
    writer.raw(entries.data(), entries.size() * sizeof(IndexEntry));
    writer.end(index_begun);
  }
  entry.index_length = out.size() - entry.length;
  return entry;
}

/// The next chunk, after one that stands in the file or was lost.
void McapWriter::State::begin_chunk(bool is_written) {
  chunk.clear();
  if (is_written) {
    for (const auto& [channel, entries] : chunk_index) {
      counts[channel] += entries.size();
      messages += entries.size();
    }
    if (!chunk_index.empty()) {
      first_time = std::min(first_time, chunk_first);
      last_time = std::max(last_time, chunk_last);
    }
  } else {
    // The messages are lost; what later chunks build upon must not be.
    chunk.insert(chunk.end(), schemas.begin(), schemas.end());
    chunk.insert(chunk.end(), channels.begin(), channels.end());
  }
  chunk_index.clear();
  chunk_first = chunk_last = 0;
}

Result<void> McapWriter::State::flush_chunk() {
  if (chunk.empty()) return {};
  std::vector<std::uint8_t> packed;
  if (options.compress) {
    packed.resize(ZSTD_compressBound(chunk.size()));
    const std::size_t size = ZSTD_compress(packed.data(), packed.size(), chunk.data(), chunk.size(), kCompressionLevel);
    if (ZSTD_isError(size) != 0) return fail(path.string() + ": zstd: " + ZSTD_getErrorName(size));
    packed.resize(size);
  }
  const std::vector<std::uint8_t>& content = options.compress ? packed : chunk;

  std::vector<std::uint8_t> out;
  out.reserve(content.size() + 100);
  ChunkEntry entry = append_chunk(out, content);
  auto written = put(out);
  begin_chunk(written.has_value());
  if (written) chunks.push_back(std::move(entry));
  return written;
}

void McapWriter::State::append_statistics(ByteWriter& writer) const {
  const std::size_t begun = writer.begin(Kind::statistics);
  writer.number(messages);
  writer.number(static_cast<std::uint16_t>(schema_ids.size()));
  writer.number(static_cast<std::uint32_t>(channel_count));
  writer.number(std::uint32_t{0});  // attachments
  writer.number(std::uint32_t{0});  // metadata
  writer.number(static_cast<std::uint32_t>(chunks.size()));
  writer.number(messages > 0 ? first_time : std::uint64_t{0});
  writer.number(last_time);
  writer.number(static_cast<std::uint32_t>(counts.size() * (sizeof(std::uint16_t) + sizeof(std::uint64_t))));
  for (const auto& [channel, count] : counts) {
    writer.number(channel);
    writer.number(count);
  }
  writer.end(begun);
}

void McapWriter::State::append_chunk_index(ByteWriter& writer, const ChunkEntry& entry) const {
  const std::size_t begun = writer.begin(Kind::chunk_index);
  writer.number(entry.first_time);
  writer.number(entry.last_time);
  writer.number(entry.start);
  writer.number(entry.length);
  writer.number(
      static_cast<std::uint32_t>(entry.index_offsets.size() * (sizeof(std::uint16_t) + sizeof(std::uint64_t))));
  for (const auto& [channel, offset] : entry.index_offsets) {
    writer.number(channel);
    writer.number(offset);
  }
  writer.number(entry.index_length);
  writer.text(options.compress ? "zstd" : "");
  writer.number(entry.compressed_size);
  writer.number(entry.size);
  writer.end(begun);
}

std::vector<std::uint8_t> McapWriter::State::summary() const {
  std::vector<std::uint8_t> out;
  ByteWriter writer{out};
  struct Group {
    Kind kind;
    std::uint64_t start;
    std::uint64_t length;
  };
  std::vector<Group> groups;
  const auto close_group = [&](Kind kind, std::size_t start) {
    if (out.size() > start) groups.push_back({kind, position + start, out.size() - start});
  };
  writer.raw(schemas.data(), schemas.size());
  close_group(Kind::schema, 0);
  std::size_t start = out.size();
  writer.raw(channels.data(), channels.size());
  close_group(Kind::channel, start);

  start = out.size();
  append_statistics(writer);
  close_group(Kind::statistics, start);

  start = out.size();
  for (const ChunkEntry& entry : chunks) append_chunk_index(writer, entry);
  close_group(Kind::chunk_index, start);

  const std::uint64_t offsets_start = position + out.size();
  for (const Group& group : groups) {
    const std::size_t begun = writer.begin(Kind::summary_offset);
    writer.number(static_cast<std::uint8_t>(group.kind));
    writer.number(group.start);
    writer.number(group.length);
    writer.end(begun);
  }
  // The footer's checksum covers the summary and the footer up to itself.
  const std::size_t footer = writer.begin(Kind::footer);
  writer.number(position);
  writer.number(offsets_start);
  writer.number(std::uint32_t{0});
  writer.end(footer);
  out.resize(out.size() - sizeof(std::uint32_t));
  writer.number(crc_of(out));
  writer.raw(mcap::kMagic.data(), mcap::kMagic.size());
  return out;
}

Result<void> McapWriter::State::finish() {
  if (auto flushed = flush_chunk(); !flushed) return flushed;
  std::vector<std::uint8_t> end;
  ByteWriter writer{end};
  const std::size_t begun = writer.begin(Kind::data_end);
  writer.number(data_crc);
  writer.end(begun);
  if (auto written = put(end); !written) return written;
  if (auto written = put(summary()); !written) return written;
  const bool synced = to.is_stream || ::fsync(file) == 0;
  const bool closed = ::close(file) == 0;
  file = -1;
  if (!synced || !closed) return fail(path.string() + ": cannot be written: " + std::strerror(errno));
  if (to.is_stream) return {};
  std::error_code error;
  std::filesystem::rename(unfinished_path(to.path), to.path, error);
  if (error) return fail(path.string() + ": cannot be named: " + error.message());
  return {};
}

McapWriter::McapWriter(std::unique_ptr<State> state) : state_{std::move(state)} {}
McapWriter::McapWriter(McapWriter&&) noexcept = default;
McapWriter& McapWriter::operator=(McapWriter&& other) noexcept {
  if (state_ && state_->file >= 0) (void)close();
  state_ = std::move(other.state_);
  return *this;
}
McapWriter::~McapWriter() {
  if (state_ && state_->file >= 0) (void)close();
}

Result<McapWriter> McapWriter::create(const std::filesystem::path& path, const McapWriterOptions& options) {
  auto to = destination_of(path);
  if (!to) return tl::unexpected<Error>(to.error());
  auto state = std::make_unique<State>();
  state->path = path;
  state->to = std::move(*to);
  state->options = options;
  state->file = open_destination(state->to, unfinished_path(state->to.path));
  if (state->file < 0) return fail(path.string() + ": cannot be written: " + std::strerror(errno));
  std::vector<std::uint8_t> head;
  ByteWriter writer{head};
  writer.raw(mcap::kMagic.data(), mcap::kMagic.size());
  const std::size_t begun = writer.begin(Kind::header);
  writer.text("ros2");
  writer.text(options.library);
  writer.end(begun);
  if (auto written = state->put(head); !written) return tl::unexpected<Error>(written.error());
  return McapWriter{std::move(state)};
}

Result<McapWriter::Channel> McapWriter::add_channel(const McapChannel& channel) {
  State& state = *state_;
  if (state.channel_count >= 65534) return fail(state.path.string() + ": too many channels");
  // Schemas and channels stand in the chunk of their first use, and once more in the summary.
  ByteWriter chunk{state.chunk};
  std::uint16_t schema_id = 0;
  if (!channel.type.empty()) {
    const auto [place, is_new] = state.schema_ids.try_emplace({channel.type, channel.schema},
                                                              static_cast<std::uint16_t>(state.schema_ids.size() + 1));
    schema_id = place->second;
    if (is_new) {
      std::vector<std::uint8_t> record;
      ByteWriter writer{record};
      const std::size_t begun = writer.begin(Kind::schema);
      writer.number(schema_id);
      writer.text(channel.type);
      writer.text(channel.schema_encoding);
      writer.text(channel.schema);
      writer.end(begun);
      chunk.raw(record.data(), record.size());
      state.schemas.insert(state.schemas.end(), record.begin(), record.end());
    }
  }
  const std::uint16_t id = ++state.channel_count;
  std::vector<std::uint8_t> record;
  ByteWriter writer{record};
  const std::size_t begun = writer.begin(Kind::channel);
  writer.number(id);
  writer.number(schema_id);
  writer.text(channel.topic);
  writer.text(channel.encoding);
  writer.texts(channel.metadata);
  writer.end(begun);
  chunk.raw(record.data(), record.size());
  state.channels.insert(state.channels.end(), record.begin(), record.end());
  state.sequences.push_back(0);
  return id;
}

Result<void> McapWriter::write(Channel channel, Time log_time, Time publish_time, std::span<const std::uint8_t> data) {
  State& state = *state_;
  DOCENT_CHECK(channel >= 1 && channel <= state.channel_count);
  DOCENT_CHECK(log_time.nanoseconds >= 0 && publish_time.nanoseconds >= 0);
  const auto time = static_cast<std::uint64_t>(log_time.nanoseconds);
  if (state.chunk_index.empty()) state.chunk_first = state.chunk_last = time;
  state.chunk_first = std::min(state.chunk_first, time);
  state.chunk_last = std::max(state.chunk_last, time);
  state.chunk_index[channel].push_back({time, state.chunk.size()});
  ByteWriter writer{state.chunk};
  const std::size_t begun = writer.begin(Kind::message);
  writer.number(channel);
  writer.number(++state.sequences[static_cast<std::size_t>(channel) - 1]);
  writer.number(time);
  writer.number(static_cast<std::uint64_t>(publish_time.nanoseconds));
  writer.raw(data.data(), data.size());
  writer.end(begun);
  const auto span = static_cast<std::uint64_t>(state.options.chunk_time.count());
  if (state.chunk.size() >= state.options.chunk_bytes || state.chunk_last - state.chunk_first >= span)
    return state.flush_chunk();
  return {};
}

Result<void> McapWriter::flush() { return state_->chunk_index.empty() ? Result<void>{} : state_->flush_chunk(); }

Result<void> McapWriter::close() { return state_->finish(); }

std::uint64_t McapWriter::messages() const {
  std::uint64_t pending = 0;
  for (const auto& [channel, entries] : state_->chunk_index) pending += entries.size();
  return state_->messages + pending;
}
std::uint64_t McapWriter::bytes_written() const { return state_->position; }

}  // namespace docent::recording
