#include "docent/telepresence/store/sqlite_database.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include <filesystem>
#include <system_error>
#include <utility>

namespace docent::telepresence {
namespace {

constexpr int kPatience = 2000;  ///< [ms] for another program that reads the file

class SqliteDatabase final : public Database {
 public:
  SqliteDatabase(const std::string& path, bool was_damaged)
      : name_{path},
        connection_{path, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, kPatience},
        was_damaged_{was_damaged} {
    connection_.exec("PRAGMA journal_mode = WAL");
    connection_.exec("PRAGMA synchronous = FULL");  // an acknowledgement must outlive a power cut
    connection_.exec("PRAGMA foreign_keys = ON");
    SQLite::Statement check{connection_, "PRAGMA quick_check"};
    if (!check.executeStep() || check.getColumn(0).getString() != "ok")
      throw SQLite::Exception("damaged", SQLITE_CORRUPT);
  }

  [[nodiscard]] Result<QueryResult> run(const std::string& statement, const std::vector<Value>& arguments) override {
    try {
      SQLite::Statement query{connection_, statement};
      for (std::size_t i = 0; i < arguments.size(); ++i) bind(query, "$" + std::to_string(i + 1), arguments[i]);
      QueryResult answer;
      const int before = connection_.getTotalChanges();
      while (query.executeStep()) answer.rows.emplace_back(values_of(query));
      answer.changed = connection_.getTotalChanges() - before;
      is_gone_ = false;
      return answer;
    } catch (const SQLite::Exception& why) {
      return failed(why);
    }
  }
  [[nodiscard]] Result<void> run_script(const std::string& statements) override {
    try {
      connection_.exec(statements);
      is_gone_ = false;
      return {};
    } catch (const SQLite::Exception& why) {
      return failed(why);
    }
  }
  [[nodiscard]] bool is_gone() const override { return is_gone_; }
  [[nodiscard]] bool was_damaged() const override { return was_damaged_; }

 protected:
  // At once for writing: else two writers could both have read, and neither could go on.
  [[nodiscard]] const char* begin_statement() const override { return "BEGIN IMMEDIATE"; }

 private:
  /// Another program that holds the file for the whole patience would do so again.
  [[nodiscard]] tl::unexpected<Error> failed(const SQLite::Exception& why) {
    is_gone_ = why.getErrorCode() == SQLITE_BUSY;
    return fail(name_ + ": " + why.what());
  }
  static void bind(SQLite::Statement& query, const std::string& name, const Value& value) {
    if (const auto* whole = std::get_if<std::int64_t>(&value)) {
      query.bind(name, *whole);
    } else if (const auto* real = std::get_if<double>(&value)) {
      query.bind(name, *real);
    } else if (const auto* text = std::get_if<std::string>(&value)) {
      query.bind(name, *text);
    } else {
      query.bind(name);
    }
  }
  static std::vector<Value> values_of(SQLite::Statement& query) {
    std::vector<Value> values;
    for (int i = 0; i < query.getColumnCount(); ++i) {
      const SQLite::Column column = query.getColumn(i);
      if (column.isInteger()) {
        values.emplace_back(static_cast<std::int64_t>(column.getInt64()));
      } else if (column.isFloat()) {
        values.emplace_back(column.getDouble());
      } else if (column.isNull()) {
        values.emplace_back(std::monostate{});
      } else {
        values.emplace_back(column.getString());
      }
    }
    return values;
  }

  std::string name_;
  SQLite::Database connection_;
  bool was_damaged_;
  bool is_gone_ = false;
};

}  // namespace

Result<std::unique_ptr<Database>> open_sqlite(const std::string& path) {
  for (const bool was_damaged : {false, true}) {
    try {
      return std::make_unique<SqliteDatabase>(path, was_damaged);
    } catch (const SQLite::Exception& why) {
      const bool is_damaged = why.getErrorCode() == SQLITE_CORRUPT || why.getErrorCode() == SQLITE_NOTADB;
      if (was_damaged || !is_damaged) return fail(path + ": cannot be opened: " + why.what());
      std::error_code ignored;
      for (const char* end : {"-wal", "-shm"}) std::filesystem::remove(path + end, ignored);
      std::filesystem::rename(path, path + ".damaged", ignored);
    }
  }
  return fail(path + ": cannot be opened");
}

}  // namespace docent::telepresence
