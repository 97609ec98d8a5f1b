#include "docent/telepresence/store/postgres_database.h"

#include <libpq-fe.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <utility>

namespace docent::telepresence {
namespace {

// Of pg_type, which never change.
constexpr Oid kInt8 = 20;
constexpr Oid kInt2 = 21;
constexpr Oid kInt4 = 23;
constexpr Oid kBool = 16;
constexpr Oid kFloat4 = 700;
constexpr Oid kFloat8 = 701;
constexpr Oid kNumeric = 1700;

using Connection = std::unique_ptr<PGconn, decltype(&PQfinish)>;
using Reply = std::unique_ptr<PGresult, decltype(&PQclear)>;

/// One line, without the password that an address may hold.
std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

Value value_of(const PGresult* reply, int row, int column) {
  if (PQgetisnull(reply, row, column) != 0) return std::monostate{};
  const std::string text = PQgetvalue(reply, row, column);
  switch (PQftype(reply, column)) {
    case kInt2:
    case kInt4:
    case kInt8:
      return static_cast<std::int64_t>(std::strtoll(text.c_str(), nullptr, 10));
    case kBool:
      return std::int64_t{text == "t"};
    case kFloat4:
    case kFloat8:
      return std::strtod(text.c_str(), nullptr);
    case kNumeric:  // sums of whole numbers
      if (text.find('.') == std::string::npos)
        return static_cast<std::int64_t>(std::strtoll(text.c_str(), nullptr, 10));
      return std::strtod(text.c_str(), nullptr);
    default:
      return text;
  }
}

class PostgresDatabase final : public Database {
 public:
  explicit PostgresDatabase(Connection connection) : connection_{std::move(connection)} {}

  [[nodiscard]] Result<QueryResult> run(const std::string& statement, const std::vector<Value>& arguments) override {
    std::vector<std::string> texts(arguments.size());
    std::vector<const char*> values(arguments.size(), nullptr);
    std::vector<Oid> types(arguments.size(), 0);
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      if (std::holds_alternative<std::monostate>(arguments[i])) continue;
      if (const auto* whole = std::get_if<std::int64_t>(&arguments[i])) {
        texts[i] = std::to_string(*whole);
        types[i] = kInt8;
      } else if (const auto* real = std::get_if<double>(&arguments[i])) {
        char text[40];
        const auto end = std::to_chars(text, text + sizeof text, *real).ptr;
        texts[i].assign(text, end);
        types[i] = kFloat8;
      } else {
        texts[i] = std::get<std::string>(arguments[i]);
        if (texts[i].find('\0') != std::string::npos) return fail("PostgreSQL: a text holds a zero byte");
      }
      values[i] = texts[i].c_str();
    }
    if (auto live = reconnect(); !live) return tl::unexpected<Error>(live.error());
    const Reply reply{PQexecParams(connection_.get(), statement.c_str(), static_cast<int>(values.size()), types.data(),
                                   values.data(), nullptr, nullptr, 0),
                      &PQclear};
    return answer_of(reply.get());
  }
  [[nodiscard]] Result<void> run_script(const std::string& statements) override {
    if (auto live = reconnect(); !live) return live;
    const Reply reply{PQexec(connection_.get(), statements.c_str()), &PQclear};
    auto answer = answer_of(reply.get());
    if (!answer) return tl::unexpected<Error>(answer.error());
    return {};
  }

 protected:
  [[nodiscard]] const char* begin_statement() const override { return "BEGIN"; }

 private:
  [[nodiscard]] Result<void> reconnect() {
    if (PQstatus(connection_.get()) == CONNECTION_OK) return {};
    PQreset(connection_.get());
    if (PQstatus(connection_.get()) == CONNECTION_OK) return {};
    return fail("PostgreSQL: " + one_line(PQerrorMessage(connection_.get())));
  }
  [[nodiscard]] Result<QueryResult> answer_of(const PGresult* reply) const {
    const ExecStatusType status = PQresultStatus(reply);
    if (status != PGRES_COMMAND_OK && status != PGRES_TUPLES_OK)
      return fail("PostgreSQL: " + one_line(PQerrorMessage(connection_.get())));
    QueryResult answer;
    answer.changed = std::strtoll(PQcmdTuples(const_cast<PGresult*>(reply)), nullptr, 10);
    const int columns = PQnfields(reply);
    for (int row = 0; row < PQntuples(reply); ++row) {
      std::vector<Value> values;
      for (int column = 0; column < columns; ++column) values.push_back(value_of(reply, row, column));
      answer.rows.emplace_back(std::move(values));
    }
    if (!answer.rows.empty() && status == PGRES_TUPLES_OK) answer.changed = 0;
    return answer;
  }

  Connection connection_;
};

}  // namespace

Result<std::unique_ptr<Database>> open_postgres(const std::string& address) {
  Connection connection{PQconnectdb(address.c_str()), &PQfinish};
  if (PQstatus(connection.get()) != CONNECTION_OK)
    return fail("PostgreSQL: " + one_line(PQerrorMessage(connection.get())));
  // Notices go nowhere: they would mix with what the program prints.
  PQsetNoticeProcessor(
      connection.get(), [](void*, const char*) {}, nullptr);
  return std::make_unique<PostgresDatabase>(std::move(connection));
}

}  // namespace docent::telepresence
