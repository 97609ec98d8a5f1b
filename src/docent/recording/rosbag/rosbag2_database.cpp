#include "docent/recording/rosbag/rosbag2_database.h"

#include <sqlite3.h>

#include <memory>
#include <vector>

#include "docent/recording/rosbag/unpacking.h"

namespace docent::recording {
namespace {

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
};
struct Finalize {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};

std::string text_of(sqlite3_stmt* row, int column) {
  const auto* text = sqlite3_column_text(row, column);
  return text == nullptr ? std::string{} : std::string{reinterpret_cast<const char*>(text)};
}

}  // namespace

Result<void> read_rosbag2_database(const std::filesystem::path& path,
                                   const std::function<bool(const Rosbag2Message&)>& handler) {
  sqlite3* opened = nullptr;
  const int status = sqlite3_open_v2(path.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr);
  const std::unique_ptr<sqlite3, CloseDatabase> database{opened};
  const auto failed = [&] { return fail(path.string() + ": " + sqlite3_errmsg(opened)); };
  if (status != SQLITE_OK) return failed();
  sqlite3_stmt* prepared = nullptr;
  constexpr const char* kQuery =
      "SELECT topics.name, topics.type, messages.timestamp, messages.data FROM messages "
      "JOIN topics ON messages.topic_id = topics.id ORDER BY messages.timestamp, messages.id";
  if (sqlite3_prepare_v2(opened, kQuery, -1, &prepared, nullptr) != SQLITE_OK) return failed();
  const std::unique_ptr<sqlite3_stmt, Finalize> statement{prepared};
  for (;;) {
    const int step = sqlite3_step(prepared);
    if (step == SQLITE_DONE) return {};
    if (step != SQLITE_ROW) return failed();
    const std::string topic = text_of(prepared, 0);
    const std::string type = text_of(prepared, 1);
    const auto* data = static_cast<const std::uint8_t*>(sqlite3_column_blob(prepared, 3));
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(prepared, 3));
    std::span<const std::uint8_t> content{data, data == nullptr ? 0 : size};
    std::vector<std::uint8_t> unpacked;
    if (is_zstd(content)) {
      if (auto whole = unpack_zstd(content)) unpacked = std::move(*whole);
      content = unpacked;  // nothing, where it is damaged
    }
    if (!handler({topic, type, Time{sqlite3_column_int64(prepared, 2)}, content})) return {};
  }
}

}  // namespace docent::recording
