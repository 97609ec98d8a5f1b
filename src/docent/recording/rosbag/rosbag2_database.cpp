#include "docent/recording/rosbag/rosbag2_database.h"

#include <sqlite3.h>

#include <map>
#include <memory>
#include <unordered_set>
#include <utility>

#include "docent/recording/rosbag/unpacking.h"
#include "docent/recording/rosbag/whole_pages.h"

namespace docent::recording {
namespace {

using Handler = std::function<bool(const Rosbag2Message&)>;

constexpr std::int64_t kMostGap = 20'000;  ///< ids one after the other that are gone; then nothing is behind them

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
};
using Database = std::unique_ptr<sqlite3, CloseDatabase>;
struct Finalize {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Statement = std::unique_ptr<sqlite3_stmt, Finalize>;

std::string text_of(sqlite3_stmt* row, int column) {
  const auto* text = sqlite3_column_text(row, column);
  return text == nullptr ? std::string{} : std::string{reinterpret_cast<const char*>(text)};
}

Statement prepared(sqlite3* database, const char* query) {
  sqlite3_stmt* statement = nullptr;
  sqlite3_prepare_v2(database, query, -1, &statement, nullptr);
  return Statement{statement};
}

class DatabaseReading {
 public:
  DatabaseReading(const std::filesystem::path& path, const Handler& handler, std::vector<std::string>& notes)
      : path_{path}, handler_{handler}, notes_{notes} {}

  Result<void> read() {
    sqlite3* opened = nullptr;
    const int status = sqlite3_open_v2(path_.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr);
    const Database database{opened};
    if (status != SQLITE_OK) return fault(opened);
    const Statement rows =
        prepared(opened,
                 "SELECT messages.id, topics.name, topics.type, messages.timestamp, messages.data FROM messages "
                 "JOIN topics ON messages.topic_id = topics.id ORDER BY messages.timestamp, messages.id");
    while (rows && wants_more_) {
      const int step = sqlite3_step(rows.get());
      if (step == SQLITE_DONE) return {};
      if (step != SQLITE_ROW) break;
      done_.insert(sqlite3_column_int64(rows.get(), 0));
      hand_over(text_of(rows.get(), 1), text_of(rows.get(), 2), rows.get(), 3);
    }
    if (!wants_more_) return {};
    if ((sqlite3_errcode(opened) & 0xff) != SQLITE_CORRUPT) return fault(opened);
    return read_what_is_whole();
  }

 private:
  [[nodiscard]] Result<void> fault(sqlite3* database) const {
    return fail(path_.string() + ": " + sqlite3_errmsg(database));
  }

  /// @param column  of the time; the data stands behind it
  void hand_over(const std::string& topic, const std::string& type, sqlite3_stmt* row, int column) {
    const Time time{sqlite3_column_int64(row, column)};
    const auto* data = static_cast<const std::uint8_t*>(sqlite3_column_blob(row, column + 1));
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(row, column + 1));
    std::span<const std::uint8_t> content{data, data == nullptr ? 0 : size};
    std::vector<std::uint8_t> unpacked;
    if (is_zstd(content)) {
      if (auto whole = unpack_zstd(content)) unpacked = std::move(*whole);
      content = unpacked;  // nothing, where it is damaged
    }
    wants_more_ = handler_({topic, type, time, content});
  }

  /// Of a file that was cut or is damaged: message by message in the order of the table, over all gaps.
  Result<void> read_what_is_whole() {
    const auto pages = WholePages::of(path_);
    if (!pages) return tl::unexpected<Error>(pages.error());
    sqlite3* opened = nullptr;
    (void)sqlite3_open_v2(":memory:", &opened, SQLITE_OPEN_READWRITE, nullptr);
    const Database database{opened};
    const auto bytes = (*pages)->bytes();
    const auto size = static_cast<sqlite3_int64>(bytes.size());
    // A file that is shorter than it says is opened only by who may repair its tables.
    if (sqlite3_deserialize(opened, "main", bytes.data(), size, size, SQLITE_DESERIALIZE_READONLY) != SQLITE_OK ||
        sqlite3_exec(opened, "PRAGMA writable_schema=ON", nullptr, nullptr, nullptr) != SQLITE_OK)
      return fault(opened);
    std::map<std::int64_t, std::pair<std::string, std::string>> topics;
    const Statement of_topics = prepared(opened, "SELECT id, name, type FROM topics NOT INDEXED");
    while (of_topics && sqlite3_step(of_topics.get()) == SQLITE_ROW)
      topics[sqlite3_column_int64(of_topics.get(), 0)] = {text_of(of_topics.get(), 1), text_of(of_topics.get(), 2)};
    const Statement rows =
        prepared(opened, "SELECT id, topic_id, timestamp, data FROM messages NOT INDEXED WHERE id >= ? ORDER BY id");
    if (topics.empty() || !rows)
      return fail(path_.string() + ": " + (*pages)->what_is_wrong() +
                  ": the beginning, which says what is in it, cannot be read");
    std::size_t found = 0;
    for (std::int64_t from = 0, gap = 0; gap < kMostGap && wants_more_;) {
      sqlite3_reset(rows.get());
      sqlite3_bind_int64(rows.get(), 1, from);
      int step = SQLITE_ROW;
      while (wants_more_ && (step = sqlite3_step(rows.get())) == SQLITE_ROW) {
        const std::int64_t id = sqlite3_column_int64(rows.get(), 0);
        const auto topic = topics.find(sqlite3_column_int64(rows.get(), 1));
        from = id;
        gap = 0;
        ++found;
        if (topic != topics.end() && done_.insert(id).second)
          hand_over(topic->second.first, topic->second.second, rows.get(), 2);
      }
      if (step == SQLITE_DONE) break;
      ++from;
      ++gap;
    }
    notes_.push_back(path_.string() + ": " + (*pages)->what_is_wrong() + "; its " + std::to_string(found) +
                     " messages that are whole are used");
    return {};
  }

  const std::filesystem::path& path_;
  const Handler& handler_;
  std::vector<std::string>& notes_;
  std::unordered_set<std::int64_t> done_;  ///< ids
  bool wants_more_ = true;
};

}  // namespace

Result<void> read_rosbag2_database(const std::filesystem::path& path, const Handler& handler,
                                   std::vector<std::string>& notes) {
  return DatabaseReading{path, handler, notes}.read();
}

}  // namespace docent::recording
