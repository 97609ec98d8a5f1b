#include "docent/telepresence/store/salvage/table_copy.h"

#include <sodium.h>
#include <sqlite3.h>

#include <charconv>
#include <set>
#include <string_view>

#include "docent/base/files.h"
#include "docent/telepresence/store/salvage/private_files.h"
#include "docent/telepresence/store/salvage/statement.h"

namespace docent::telepresence {
namespace {

constexpr std::string_view kTitle = "docent table copy 1\n";
constexpr std::size_t kHash = 16;  ///< [bytes]

std::string hash_of(std::string_view text) {
  std::string hash(kHash, '\0');
  crypto_generichash(reinterpret_cast<unsigned char*>(hash.data()), kHash,
                     reinterpret_cast<const unsigned char*>(text.data()), text.size(), nullptr, 0);
  return hash;
}

/// KIND LENGTH:BYTES
void add(std::string& to, char kind, const std::string& bytes) {
  to += kind + std::to_string(bytes.size()) + ":" + bytes;
}

void add(std::string& to, const Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return add(to, 't', *text);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return add(to, 'i', std::to_string(*whole));
  if (const auto* real = std::get_if<double>(&value)) return add(to, 'r', std::to_string(*real));
  add(to, 'n', "");
}

std::optional<Value> take(std::string_view& from) {
  if (from.size() < 3) return std::nullopt;
  const char kind = from[0];
  std::size_t length = 0;
  const auto [end, error] = std::from_chars(from.data() + 1, from.data() + from.size(), length);
  from.remove_prefix(static_cast<std::size_t>(end - from.data()));
  if (error != std::errc{} || from.empty() || from[0] != ':' || length > from.size() - 1) return std::nullopt;
  const std::string bytes{from.substr(1, length)};
  from.remove_prefix(1 + length);
  if (kind == 'i') return std::int64_t{std::strtoll(bytes.c_str(), nullptr, 10)};
  if (kind == 'r') return std::strtod(bytes.c_str(), nullptr);
  if (kind == 't') return bytes;
  return std::monostate{};
}

std::string joined(const std::vector<std::string>& columns, const char* before = "") {
  std::string text;
  for (const std::string& column : columns) text += (text.empty() ? "" : ", ") + (before + ("\"" + column + "\""));
  return text;
}

}  // namespace

std::optional<TableCopy> TableCopy::of(sqlite3* database) {
  TableCopy copy;
  Statement rows{database, std::string{"SELECT * FROM "} + kTable + " ORDER BY 1"};
  if (!rows.is_good()) return std::nullopt;
  for (int i = 0; i < rows.columns(); ++i) copy.columns.push_back(rows.name(i));
  while (rows.step()) copy.rows.push_back(rows.values());
  if (!rows.is_good()) return std::nullopt;
  return copy;
}

std::optional<TableCopy> TableCopy::read(const std::filesystem::path& file) {
  const auto content = read_file(file);
  if (!content || !content->starts_with(kTitle) || content->size() < kTitle.size() + kHash) return std::nullopt;
  std::string_view body = std::string_view{*content}.substr(kTitle.size() + kHash);
  if (content->substr(kTitle.size(), kHash) != hash_of(body)) return std::nullopt;
  TableCopy copy;
  const auto count = take(body);
  const auto* columns = count ? std::get_if<std::int64_t>(&*count) : nullptr;
  if (columns == nullptr || *columns < 1 || *columns > 100) return std::nullopt;
  for (std::int64_t i = 0; i < *columns; ++i) {
    const auto name = take(body);
    if (!name || !std::holds_alternative<std::string>(*name)) return std::nullopt;
    copy.columns.push_back(std::get<std::string>(*name));
  }
  while (!body.empty()) {
    std::vector<Value>& row = copy.rows.emplace_back();
    for (std::int64_t i = 0; i < *columns; ++i) {
      auto value = take(body);
      if (!value) return std::nullopt;
      row.push_back(std::move(*value));
    }
  }
  return copy;
}

Result<void> TableCopy::write(const std::filesystem::path& file) const {
  std::string body;
  add(body, static_cast<std::int64_t>(columns.size()));
  for (const std::string& column : columns) add(body, 't', column);
  for (const auto& row : rows)
    for (const Value& value : row) add(body, value);
  return write_private_file(file, std::string{kTitle} + hash_of(body) + body);
}

int TableCopy::put(sqlite3* database, bool only_known) const {
  const auto now = of(database);
  if (!now) return 0;
  std::set<std::vector<Value>> there{now->rows.begin(), now->rows.end()};
  std::set<Value> names;
  for (const auto& row : now->rows) names.insert(row.at(0));
  std::string marks;
  for (std::size_t i = 0; i < columns.size(); ++i) marks += (i == 0 ? "?" : ", ?");
  Statement insert{
      database, std::string{"INSERT OR REPLACE INTO "} + kTable + " (" + joined(columns) + ") VALUES (" + marks + ")"};
  int changed = 0;
  for (const auto& row : rows) {
    const bool is_same = now->columns == columns && there.contains(row);
    if (is_same || (only_known && !names.contains(row.at(0))) || !insert.is_good()) continue;
    insert.run(row);
    ++changed;
  }
  return changed;
}

int TableCopy::repair(sqlite3* database) const { return put(database, true); }

int TableCopy::restore(sqlite3* database) const {
  int changed = put(database, false);
  std::set<Value> names;
  for (const auto& row : rows) names.insert(row.at(0));
  const auto now = of(database);
  if (!now || columns.empty()) return changed;
  Statement remove{database, std::string{"DELETE FROM "} + kTable + " WHERE \"" + columns.front() + "\" = ?"};
  for (const auto& row : now->rows) {
    if (names.contains(row.at(0)) || !remove.is_good()) continue;
    remove.run({row.at(0)});
    ++changed;
  }
  return changed;
}

}  // namespace docent::telepresence
