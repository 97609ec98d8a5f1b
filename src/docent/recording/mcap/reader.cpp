#include "docent/recording/mcap/reader.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <limits>
#include <queue>

#include "docent/recording/mcap/chunk.h"
#include "docent/recording/mcap/format.h"

namespace docent::recording {
namespace {

using Bytes = std::span<const std::uint8_t>;
using mcap::ByteReader;
using mcap::crc_of;
using mcap::Kind;
using mcap::Record;
using mcap::record_at;

/// Chunks that overlap in time are held together; no sound recording needs so much.
constexpr std::uint64_t kMaxHeld = std::uint64_t{1} << 30U;
constexpr std::size_t kMostDamage = 1000;  ///< entries in the list
constexpr std::uint64_t kMaxTime = std::numeric_limits<std::int64_t>::max();

Time time_of(std::uint64_t nanoseconds) { return {static_cast<std::int64_t>(std::min(nanoseconds, kMaxTime))}; }

/// A file in memory: mapped, or owned.
class Source {
 public:
  explicit Source(std::vector<std::uint8_t> bytes) : owned_{std::move(bytes)}, bytes_{owned_} {}
  explicit Source(Bytes mapped) : bytes_{mapped}, is_mapped_{true} {}
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;
  ~Source() {
    if (is_mapped_ && !bytes_.empty()) ::munmap(const_cast<std::uint8_t*>(bytes_.data()), bytes_.size());
  }
  [[nodiscard]] Bytes bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> owned_;
  Bytes bytes_;
  bool is_mapped_ = false;
};

/// A chunk, or a message that stands alone.
struct Piece {
  std::uint64_t first_time = 0;
  std::size_t offset = 0;
  bool is_chunk = true;
  bool is_cut = false;  ///< a chunk that the end of the file cuts
};

struct Schema {
  std::string name, encoding, text;
};

}  // namespace

struct McapReader::State {
  std::string name;
  std::unique_ptr<Source> source;
  std::string profile;
  bool complete = false;
  std::vector<Piece> pieces;  ///< by first time, then by place
  std::map<std::uint16_t, Schema> schemas;
  std::map<std::uint16_t, McapChannel> channels;
  std::map<std::uint16_t, std::uint16_t> schema_of_channel;
  std::optional<std::uint64_t> message_count;
  std::map<std::uint16_t, std::uint64_t> counts;
  std::vector<std::string> damage;
  std::size_t searched_to = 0;  ///< the chunks that begin before this byte were searched for channels

  [[nodiscard]] Bytes bytes() const { return source->bytes(); }
  [[nodiscard]] Error fault(std::size_t offset, const std::string& what) const {
    return {name + ": " + what + " at byte " + std::to_string(offset)};
  }
  void learn_schema(Bytes content);
  void learn_channel(Bytes content);
  void name_type(std::uint16_t channel);
  [[nodiscard]] bool read_summary();
  void walk();
  [[nodiscard]] Result<std::vector<std::uint8_t>> unpack(const Piece& piece) const;
  [[nodiscard]] bool knows_channel(std::uint16_t id, std::size_t at);
};

void McapReader::State::learn_schema(Bytes content) {
  ByteReader reader{content};
  const auto id = reader.number<std::uint16_t>();
  Schema schema;
  schema.name = reader.text();
  schema.encoding = reader.text();
  schema.text = reader.text();
  if (reader.good() && id != 0) schemas.try_emplace(id, std::move(schema));
}

void McapReader::State::learn_channel(Bytes content) {
  ByteReader reader{content};
  const auto id = reader.number<std::uint16_t>();
  const auto schema_id = reader.number<std::uint16_t>();
  McapChannel channel;
  channel.topic = reader.text();
  channel.encoding = reader.text();
  channel.metadata = reader.texts();
  if (!reader.good() || !channels.try_emplace(id, std::move(channel)).second) return;
  schema_of_channel[id] = schema_id;
  name_type(id);
}

void McapReader::State::name_type(std::uint16_t id) {
  const auto schema = schemas.find(schema_of_channel[id]);
  if (schema == schemas.end()) return;
  McapChannel& channel = channels[id];
  channel.type = schema->second.name;
  channel.schema_encoding = schema->second.encoding;
  channel.schema = schema->second.text;
}

/// True when footer and summary are sound and list the chunks; then nothing else of the file is touched before reading.
bool McapReader::State::read_summary() {
  const Bytes all = bytes();
  const std::size_t tail = mcap::kFooterSize + mcap::kMagic.size();
  if (all.size() < mcap::kMagic.size() + tail) return false;
  if (!std::equal(mcap::kMagic.begin(), mcap::kMagic.end(),
                  all.end() - static_cast<std::ptrdiff_t>(mcap::kMagic.size())))
    return false;
  const std::size_t footer_at = all.size() - tail;
  const Record footer = record_at(all, footer_at);
  if (!footer.is(Kind::footer) || footer.size != mcap::kFooterSize) return false;
  complete = true;
  ByteReader reader{footer.content};
  const auto start = reader.number<std::uint64_t>();
  (void)reader.number<std::uint64_t>();
  const auto crc = reader.number<std::uint32_t>();
  if (start == 0 || start > footer_at) return false;
  const auto from = static_cast<std::size_t>(start);
  if (crc != 0 && crc != crc_of(all.subspan(from, all.size() - mcap::kMagic.size() - sizeof crc - from))) return false;

  std::uint32_t chunks_counted = 0;
  for (std::size_t at = from; at < footer_at;) {
    const Record record = record_at(all.first(footer_at), at);
    if (record.kind == 0) return false;
    if (record.is(Kind::schema)) learn_schema(record.content);
    if (record.is(Kind::channel)) learn_channel(record.content);
    if (record.is(Kind::statistics)) {
      ByteReader statistics{record.content};
      const auto messages = statistics.number<std::uint64_t>();
      (void)statistics.bytes(2 + 4 + 4 + 4);
      chunks_counted = statistics.number<std::uint32_t>();
      (void)statistics.bytes(8 + 8);
      ByteReader entries{statistics.bytes(statistics.number<std::uint32_t>())};
      while (entries.good() && entries.left() > 0) {
        const auto channel = entries.number<std::uint16_t>();
        counts[channel] = entries.number<std::uint64_t>();
      }
      if (statistics.good() && entries.good()) message_count = messages;
    }
    if (record.is(Kind::chunk_index)) {
      ByteReader index{record.content};
      Piece piece;
      piece.first_time = index.number<std::uint64_t>();
      (void)index.number<std::uint64_t>();
      const auto offset = index.number<std::uint64_t>();
      if (!index.good() || offset >= from) return false;
      piece.offset = static_cast<std::size_t>(offset);
      pieces.push_back(piece);
    }
    at += record.size;
  }
  // A file whose messages stand outside of chunks has no index to them.
  return message_count && !pieces.empty() && pieces.size() == chunks_counted;
}

/// Finds the chunks and lone messages by going from record to record, up to the first that is not whole.
void McapReader::State::walk() {
  const Bytes all = bytes();
  pieces.clear();
  for (std::size_t at = mcap::kMagic.size(); at < all.size();) {
    const Record record = record_at(all, at);
    if (record.is(Kind::data_end) || record.is(Kind::footer)) break;
    if (record.kind == 0) {
      complete = false;
      const Bytes rest = all.subspan(at);
      if (rest.size() > mcap::kRecordHead + sizeof(std::uint64_t) && rest[0] == static_cast<std::uint8_t>(Kind::chunk))
        pieces.push_back({ByteReader{rest.subspan(mcap::kRecordHead)}.number<std::uint64_t>(), at, true, true});
      break;
    }
    if (record.is(Kind::schema)) learn_schema(record.content);
    if (record.is(Kind::channel)) learn_channel(record.content);
    if (record.is(Kind::chunk) || record.is(Kind::message)) {
      ByteReader reader{record.content};
      if (record.is(Kind::message)) (void)reader.bytes(2 + 4);
      pieces.push_back({reader.number<std::uint64_t>(), at, record.is(Kind::chunk)});
    }
    at += record.size;
  }
}

Result<std::vector<std::uint8_t>> McapReader::State::unpack(const Piece& piece) const {
  if (piece.is_cut) return mcap::unpack_cut_chunk(bytes().subspan(piece.offset + mcap::kRecordHead));
  const Record record = record_at(bytes(), piece.offset);
  if (!record.is(Kind::chunk)) return tl::unexpected<Error>(fault(piece.offset, "no chunk where the index has one"));
  auto records = mcap::unpack_chunk(record.content);
  if (!records) return tl::unexpected<Error>(fault(piece.offset, records.error().message));
  return records;
}

/// Whether a channel is known to a message of the piece at byte `at`. Where no summary repeats the channels, each is
/// told once, in the piece that was written first; that need not be the earliest, by which the pieces are read.
bool McapReader::State::knows_channel(std::uint16_t id, std::size_t at) {
  if (channels.contains(id)) return true;
  std::vector<Piece> before;
  std::copy_if(pieces.begin(), pieces.end(), std::back_inserter(before),
               [&](const Piece& piece) { return piece.is_chunk && piece.offset >= searched_to && piece.offset < at; });
  std::sort(before.begin(), before.end(), [](const Piece& a, const Piece& b) { return a.offset < b.offset; });
  for (const Piece& piece : before) {
    searched_to = piece.offset + 1;
    const auto records = unpack(piece);  // a broken one is said when it is read
    for (std::size_t next = 0; records && next < records->size();) {
      const Record record = record_at(*records, next);
      if (record.kind == 0) break;
      if (record.is(Kind::schema)) learn_schema(record.content);
      if (record.is(Kind::channel)) learn_channel(record.content);
      next += record.size;
    }
    if (channels.contains(id)) return true;
  }
  return false;
}

McapReader::McapReader(std::unique_ptr<State> state) : state_{std::move(state)} {}
McapReader::McapReader(McapReader&&) noexcept = default;
McapReader& McapReader::operator=(McapReader&&) noexcept = default;
McapReader::~McapReader() = default;

const std::string& McapReader::profile() const { return state_->profile; }
bool McapReader::is_complete() const { return state_->complete; }
std::optional<std::uint64_t> McapReader::message_count() const { return state_->message_count; }
const std::vector<std::string>& McapReader::damage() const { return state_->damage; }

std::map<std::string, std::uint64_t> McapReader::counts_by_topic() const {
  std::map<std::string, std::uint64_t> result;
  for (const auto& [id, count] : state_->counts)
    if (const auto channel = state_->channels.find(id); channel != state_->channels.end())
      result[channel->second.topic] += count;
  return result;
}

Result<McapReader> McapReader::from_state(std::unique_ptr<State> state) {
  const Bytes all = state->bytes();
  if (all.size() < mcap::kMagic.size() || !std::equal(mcap::kMagic.begin(), mcap::kMagic.end(), all.begin()))
    return fail(state->name + ": is not an MCAP file");
  const Record header = record_at(all, mcap::kMagic.size());
  if (!header.is(Kind::header)) return fail(state->name + ": has no MCAP header");
  state->profile = ByteReader{header.content}.text();
  if (!state->read_summary()) {
    state->message_count.reset();
    state->counts.clear();
    state->walk();
  }
  // A summary may list channels before their schemas.
  for (const auto& [id, schema] : state->schema_of_channel) state->name_type(id);
  std::stable_sort(state->pieces.begin(), state->pieces.end(), [](const Piece& a, const Piece& b) {
    return a.first_time != b.first_time ? a.first_time < b.first_time : a.offset < b.offset;
  });
  return McapReader{std::move(state)};
}

Result<McapReader> McapReader::from_bytes(std::vector<std::uint8_t> bytes, std::string name) {
  auto state = std::make_unique<State>();
  state->name = std::move(name);
  state->source = std::make_unique<Source>(std::move(bytes));
  return from_state(std::move(state));
}

Result<McapReader> McapReader::open(const std::filesystem::path& path) {
  std::error_code error;
  const auto actual = !std::filesystem::exists(path, error) && std::filesystem::exists(unfinished_path(path), error)
                          ? unfinished_path(path)
                          : path;
  const int file = ::open(actual.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return fail(path.string() + ": cannot be read: " + std::strerror(errno));
  struct stat status {};
  void* mapped = MAP_FAILED;
  const bool is_file = ::fstat(file, &status) == 0 && S_ISREG(status.st_mode);
  const auto size = is_file ? static_cast<std::size_t>(status.st_size) : 0;
  if (size > 0) mapped = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
  ::close(file);
  if (!is_file) return fail(path.string() + ": is not a file");
  if (size == 0) return fail(path.string() + ": is not an MCAP file");
  if (mapped == MAP_FAILED) return fail(path.string() + ": cannot be read: " + std::strerror(errno));
  auto state = std::make_unique<State>();
  state->name = path.string();
  state->source = std::make_unique<Source>(Bytes{static_cast<const std::uint8_t*>(mapped), size});
  return from_state(std::move(state));
}

/// One reading: messages wait here until no chunk can hold an earlier one, and leave in the order of their times.
class McapReader::Reading {
 public:
  Reading(State& state, const Selection& selection, const std::function<bool(const McapMessage&)>& handler)
      : state_{state}, selection_{selection}, handler_{handler} {}
  Reading(const Reading&) = delete;  // chunks that wait know this one
  Reading& operator=(const Reading&) = delete;

  Result<void> run();

 private:
  using Chunk = std::shared_ptr<const std::vector<std::uint8_t>>;
  /// A message that waits for its turn, and the unpacked chunk that holds it.
  struct Waiting {
    std::uint64_t time;
    std::uint64_t order;
    std::uint64_t publish_time;
    std::uint32_t sequence;
    std::uint16_t channel;
    Bytes data;
    Chunk chunk;
    bool operator<(const Waiting& other) const {  // the earliest is on top
      return time != other.time ? time > other.time : order > other.order;
    }
  };

  bool wait(Bytes content, const Chunk& chunk, std::size_t offset);
  bool hand_over_before(std::uint64_t time);
  Result<void> damaged(Error error);
  Result<void> read_chunk(const Piece& piece);

  State& state_;
  const Selection& selection_;
  const std::function<bool(const McapMessage&)>& handler_;
  std::uint64_t held_ = 0;  ///< bytes of unpacked chunks that messages still wait in
  std::priority_queue<Waiting> waiting_;
  std::uint64_t order_ = 0;
  std::uint64_t handed_over_ = 0;  ///< time of the latest message that was
};

/// False for a message that cannot be right. @param offset  of its piece in the file
bool McapReader::Reading::wait(Bytes content, const Chunk& chunk, std::size_t offset) {
  ByteReader reader{content};
  Waiting message{};
  message.channel = reader.number<std::uint16_t>();
  message.sequence = reader.number<std::uint32_t>();
  message.time = reader.number<std::uint64_t>();
  message.publish_time = reader.number<std::uint64_t>();
  message.data = reader.bytes(reader.left());
  message.order = order_++;
  message.chunk = chunk;
  // A chunk that holds earlier messages than it says would break the order.
  if (!reader.good() || message.time > kMaxTime || message.time < handed_over_) return false;
  if (!state_.knows_channel(message.channel, offset)) return false;
  const std::string& topic = state_.channels.at(message.channel).topic;
  if (!selection_.topics.empty() && !selection_.topics.contains(topic)) return true;
  if (selection_.from && time_of(message.time) < *selection_.from) return true;
  if (selection_.to && time_of(message.time) > *selection_.to) return true;
  waiting_.push(std::move(message));
  return true;
}

/// False when the handler wants no more.
bool McapReader::Reading::hand_over_before(std::uint64_t time) {
  while (!waiting_.empty() && waiting_.top().time < time) {
    const Waiting message = waiting_.top();
    waiting_.pop();
    handed_over_ = message.time;
    if (!handler_({state_.channels.at(message.channel), time_of(message.time), time_of(message.publish_time),
                   message.sequence, message.data}))
      return false;
  }
  return true;
}

/// The error, after what lay before it; or none, when damage is only noted.
Result<void> McapReader::Reading::damaged(Error error) {
  if (!selection_.skip_damaged) {
    (void)hand_over_before(std::numeric_limits<std::uint64_t>::max());
    return tl::unexpected<Error>(std::move(error));
  }
  if (state_.damage.size() < kMostDamage) state_.damage.push_back(std::move(error.message));
  return {};
}

Result<void> McapReader::Reading::read_chunk(const Piece& piece) {
  auto unpacked = state_.unpack(piece);
  if (!unpacked && piece.is_cut) return {};  // is_complete says it
  if (!unpacked) return damaged(unpacked.error());
  held_ += unpacked->size();
  if (held_ > kMaxHeld) return tl::unexpected<Error>(state_.fault(piece.offset, "too many chunks of the same time"));
  const Chunk chunk{new std::vector<std::uint8_t>{std::move(*unpacked)},
                    [this](const std::vector<std::uint8_t>* records) {
                      held_ -= records->size();
                      delete records;
                    }};
  for (std::size_t at = 0; at < chunk->size();) {
    const Record record = record_at(*chunk, at);
    bool good = record.kind != 0;
    if (!good && piece.is_cut) break;
    if (record.is(Kind::schema)) state_.learn_schema(record.content);
    if (record.is(Kind::channel)) state_.learn_channel(record.content);
    if (record.is(Kind::message)) good = wait(record.content, chunk, piece.offset);
    if (!good) {
      if (auto result = damaged(state_.fault(piece.offset, "a broken record in the chunk")); !result) return result;
      if (record.kind == 0) break;
    }
    at += record.size;
  }
  return {};
}

Result<void> McapReader::Reading::run() {
  for (const Piece& piece : state_.pieces) {
    if (!hand_over_before(piece.first_time)) return {};
    if (piece.is_chunk) {
      if (auto result = read_chunk(piece); !result) return result;
    } else if (!wait(record_at(state_.bytes(), piece.offset).content, nullptr, piece.offset)) {
      if (auto result = damaged(state_.fault(piece.offset, "a broken message")); !result) return result;
    }
  }
  (void)hand_over_before(std::numeric_limits<std::uint64_t>::max());
  return {};
}

Result<void> McapReader::read(const Selection& selection, const std::function<bool(const McapMessage&)>& handler) {
  state_->damage.clear();
  return Reading{*state_, selection, handler}.run();
}

}  // namespace docent::recording
