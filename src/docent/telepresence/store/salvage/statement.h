#pragma once

#include <sqlite3.h>

#include <string>
#include <vector>

#include "docent/telepresence/store/salvage/value.h"

namespace docent::telepresence {

/// A statement of SQLite that throws nothing: what it works on may be damaged.
class Statement {
 public:
  Statement(sqlite3* database, const std::string& text) {
    is_good_ = sqlite3_prepare_v2(database, text.c_str(), -1, &statement_, nullptr) == SQLITE_OK;
  }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;
  ~Statement() { sqlite3_finalize(statement_); }

  [[nodiscard]] bool is_good() const { return is_good_; }  ///< so far
  [[nodiscard]] int columns() const { return sqlite3_column_count(statement_); }
  [[nodiscard]] std::string name(int column) const { return sqlite3_column_name(statement_, column); }
  /// The next row. @returns false: there is none, or it has failed
  bool step() {
    const int status = is_good_ ? sqlite3_step(statement_) : SQLITE_ERROR;
    is_good_ = status == SQLITE_ROW || status == SQLITE_DONE;
    return status == SQLITE_ROW;
  }
  [[nodiscard]] Value value(int column) const {
    switch (sqlite3_column_type(statement_, column)) {
      case SQLITE_INTEGER:
        return static_cast<std::int64_t>(sqlite3_column_int64(statement_, column));
      case SQLITE_FLOAT:
        return sqlite3_column_double(statement_, column);
      case SQLITE_NULL:
        return std::monostate{};
      default:
        break;
    }
    const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement_, column));
    const auto length = static_cast<std::size_t>(sqlite3_column_bytes(statement_, column));
    return length == 0 ? std::string{} : std::string{bytes, length};
  }
  [[nodiscard]] std::vector<Value> values() const {
    std::vector<Value> all;
    for (int i = 0; i < columns(); ++i) all.push_back(value(i));
    return all;
  }
  [[nodiscard]] std::string text(int column) const {
    const Value found = value(column);
    const auto* as_text = std::get_if<std::string>(&found);
    return as_text != nullptr ? *as_text : std::string{};
  }
  /// From its beginning to its end, with these arguments. @returns whether it could
  bool run(const std::vector<Value>& arguments) {
    sqlite3_reset(statement_);
    for (std::size_t i = 0; i < arguments.size(); ++i) bind(static_cast<int>(i + 1), arguments[i]);
    int status = sqlite3_step(statement_);
    while (status == SQLITE_ROW) status = sqlite3_step(statement_);
    sqlite3_reset(statement_);
    return status == SQLITE_DONE;
  }

 private:
  void bind(int place, const Value& value) {
    if (const auto* whole = std::get_if<std::int64_t>(&value)) {
      sqlite3_bind_int64(statement_, place, *whole);
    } else if (const auto* real = std::get_if<double>(&value)) {
      sqlite3_bind_double(statement_, place, *real);
    } else if (const auto* text = std::get_if<std::string>(&value)) {
      sqlite3_bind_text(statement_, place, text->data(), static_cast<int>(text->size()), SQLITE_TRANSIENT);
    } else {
      sqlite3_bind_null(statement_, place);
    }
  }

  sqlite3_stmt* statement_ = nullptr;
  bool is_good_ = false;
};

}  // namespace docent::telepresence
