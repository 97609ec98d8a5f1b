#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/telepresence/store/salvage/value.h"

namespace docent::telepresence {

/// One row of an answer.
class Row {
 public:
  explicit Row(std::vector<Value> values) : values_{std::move(values)} {}
  /// 0 and "" where there is nothing of that kind. @pre column < number of columns
  [[nodiscard]] std::int64_t number(std::size_t column) const;
  [[nodiscard]] double real(std::size_t column) const;
  [[nodiscard]] const std::string& text(std::size_t column) const;
  [[nodiscard]] bool is_null(std::size_t column) const {
    return std::holds_alternative<std::monostate>(values_.at(column));
  }

 private:
  std::vector<Value> values_;
};

struct QueryResult {
  std::vector<Row> rows;
  std::int64_t changed = 0;  ///< rows that were inserted, updated or deleted
};

/// Of a statement whose rows nobody wants.
[[nodiscard]] inline Result<void> done(const Result<QueryResult>& answer) {
  if (!answer) return tl::unexpected<Error>(answer.error());
  return {};
}

/// A database of this computer (SQLite) or a shared one (PostgreSQL). A statement that changes something is on disk
/// when it returns, a transaction when `commit` does. One thread at a time.
class Database {
 public:
  /// When a server is tried first: at once, or with the first statement, since nobody answered there a moment ago.
  enum class Try { now, later };

  /// @param where  "postgresql://…", or the path of a file, which is made if it is not there; a damaged one is mended,
  /// see `notice`. A server that nobody answers at is opened, too: its statements fail until somebody does
  [[nodiscard]] static Result<std::unique_ptr<Database>> open(const std::string& where, Try when = Try::now);
  [[nodiscard]] static bool is_shared(const std::string& where);  ///< a server, not a file

  Database() = default;
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  virtual ~Database() = default;

  /// @param statement  one, with $1, $2 … where the arguments stand
  [[nodiscard]] virtual Result<QueryResult> run(const std::string& statement,
                                                const std::vector<Value>& arguments = {}) = 0;
  /// Several statements without arguments, as they stand in a migration.
  [[nodiscard]] virtual Result<void> run_script(const std::string& statements) = 0;
  /// What became of the database within a day, such as that it was damaged and what was recovered; empty: nothing. Any
  /// thread.
  [[nodiscard]] virtual std::string notice() const { return {}; }
  /// Now and then: sees whether its files are still there and whole, and mends them. What is committed into a file that
  /// is gone fails.
  [[nodiscard]] virtual Result<void> look() { return {}; }
  /// All of it as it is now, into a new file. Others may go on writing.
  [[nodiscard]] virtual Result<void> copy_to(const std::filesystem::path& /*file*/) {
    return fail("a database of a server is copied with its own programs");
  }
  /// How long a statement may take; then it has failed, and the database counts as gone. Before: as long as it takes.
  virtual void set_patience(Duration /*patience*/) {}
  /// Whether nobody answered the last statement: the next one would wait as long.
  [[nodiscard]] virtual bool is_gone() const { return false; }
  /// Where a server is gone: does that work before the next statement that somebody answers, which fails as long as the
  /// work does. False: it is not gone, or is no server, and nothing was put off.
  [[nodiscard]] virtual bool put_off(std::function<Result<void>()> /*work*/) { return false; }

  /// All that `work` does, or nothing when it fails. Within `work` another call is part of the same transaction.
  [[nodiscard]] Result<void> in_transaction(const std::function<Result<void>()>& work);

 protected:
  [[nodiscard]] virtual const char* begin_statement() const = 0;

 private:
  bool is_in_transaction_ = false;
};

}  // namespace docent::telepresence
