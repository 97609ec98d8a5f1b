#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"

namespace docent::telepresence {

/// NULL, a whole number, a number, a text.
using Value = std::variant<std::monostate, std::int64_t, double, std::string>;

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
  /// @param where  "postgresql://…", or the path of a file, which is made if it is not there; a damaged one is set
  /// aside as FILE.damaged, see `was_damaged`
  [[nodiscard]] static Result<std::unique_ptr<Database>> open(const std::string& where);
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
  [[nodiscard]] virtual bool was_damaged() const { return false; }
  /// How long a statement may take; then it has failed, and the database counts as gone. Before: as long as it takes.
  virtual void set_patience(Duration /*patience*/) {}
  /// Whether nobody answered the last statement: the next one would wait as long.
  [[nodiscard]] virtual bool is_gone() const { return false; }

  /// All that `work` does, or nothing when it fails. Within `work` another call is part of the same transaction.
  [[nodiscard]] Result<void> in_transaction(const std::function<Result<void>()>& work);

 protected:
  [[nodiscard]] virtual const char* begin_statement() const = 0;

 private:
  bool is_in_transaction_ = false;
};

}  // namespace docent::telepresence
