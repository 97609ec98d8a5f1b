#include "docent/telepresence/store/database.h"

#include "docent/telepresence/store/postgres_database.h"
#include "docent/telepresence/store/sqlite_database.h"

namespace docent::telepresence {

std::int64_t Row::number(std::size_t column) const {
  const Value& value = values_.at(column);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return *whole;
  if (const auto* real = std::get_if<double>(&value)) return static_cast<std::int64_t>(*real);
  return 0;
}

double Row::real(std::size_t column) const {
  const Value& value = values_.at(column);
  if (const auto* real = std::get_if<double>(&value)) return *real;
  return static_cast<double>(number(column));
}

const std::string& Row::text(std::size_t column) const {
  static const std::string kNone;
  const auto* text = std::get_if<std::string>(&values_.at(column));
  return text != nullptr ? *text : kNone;
}

bool Database::is_shared(const std::string& where) {
  return where.starts_with("postgresql://") || where.starts_with("postgres://");
}

Result<std::unique_ptr<Database>> Database::open(const std::string& where, Try when) {
  return is_shared(where) ? open_postgres(where, when) : open_sqlite(where);
}

Result<void> Database::in_transaction(const std::function<Result<void>()>& work) {
  if (is_in_transaction_) return work();
  if (auto begun = run_script(begin_statement()); !begun) return begun;
  is_in_transaction_ = true;
  auto done = work();
  is_in_transaction_ = false;
  if (done) done = run_script("COMMIT");
  if (!done) (void)run_script("ROLLBACK");
  return done;
}

}  // namespace docent::telepresence
