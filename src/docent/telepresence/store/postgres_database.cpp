#include "docent/telepresence/store/postgres_database.h"

#include <libpq-fe.h>
#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <deque>
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

using Clock = std::chrono::steady_clock;

constexpr auto kPatienceAtStart = std::chrono::seconds{10};  // for tables that another gateway is making
constexpr auto kRests = std::chrono::seconds{1};             // after a try that found nobody
constexpr const char* kPatienceToConnect = "2";              // [s] the least that libpq knows

/// Whoever has an address and no password gets what libpq finds elsewhere.
Connection connect(const std::string& address) {
  const char* const names[] = {"dbname", "connect_timeout", nullptr};
  const char* const values[] = {address.c_str(), kPatienceToConnect, nullptr};
  Connection connection{PQconnectdbParams(names, values, 1), &PQfinish};
  // Notices go nowhere: they would mix with what the program prints.
  PQsetNoticeProcessor(
      connection.get(), [](void*, const char*) {}, nullptr);
  PQsetnonblocking(connection.get(), 1);
  return connection;
}

/// Waits until the connection can be read, or written to. False: not until then.
bool wait_for(PGconn* connection, short what, Clock::time_point until) {
  pollfd watched{PQsocket(connection), what, 0};
  if (watched.fd < 0) return false;
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
    if (left.count() <= 0) return false;
    const int ready = ::poll(&watched, 1, static_cast<int>(left.count()));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
  }
}

class PostgresDatabase final : public Database {
 public:
  PostgresDatabase(std::string address, Try when) : address_{std::move(address)} {
    if (when == Try::now) connection_ = connect(address_);
    if (is_gone()) rests_until_ = Clock::now() + kRests;
  }

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
    if (auto live = make_ready(); !live) return tl::unexpected<Error>(live.error());
    return answer_to(PQsendQueryParams(connection_.get(), statement.c_str(), static_cast<int>(values.size()),
                                       types.data(), values.data(), nullptr, nullptr, 0));
  }
  [[nodiscard]] Result<void> run_script(const std::string& statements) override {
    if (auto live = make_ready(); !live) return live;
    auto answer = answer_to(PQsendQuery(connection_.get(), statements.c_str()));
    if (!answer) return tl::unexpected<Error>(answer.error());
    return {};
  }
  void set_patience(Duration patience) override { patience_ = patience; }
  [[nodiscard]] bool is_gone() const override { return PQstatus(connection_.get()) != CONNECTION_OK; }
  [[nodiscard]] bool put_off(std::function<Result<void>()> work) override {
    if (!is_gone()) return false;
    put_off_.push_back(std::move(work));
    return true;
  }

 protected:
  [[nodiscard]] const char* begin_statement() const override { return "BEGIN"; }

 private:
  [[nodiscard]] Result<void> reconnect() {
    if (!is_gone()) return {};
    if (Clock::now() < rests_until_) return fail(why_gone());
    connection_ = connect(address_);
    if (!is_gone()) return {};
    rests_until_ = Clock::now() + kRests;
    return fail(why_gone());
  }
  [[nodiscard]] std::string why_gone() const {
    const std::string why = connection_ ? one_line(PQerrorMessage(connection_.get())) : std::string{};
    return "PostgreSQL: " + (why.empty() ? "does not answer" : why);
  }
  /// Connects, and does what was put off until somebody answers.
  [[nodiscard]] Result<void> make_ready() {
    if (auto live = reconnect(); !live || is_catching_up_) return live;
    is_catching_up_ = true;
    Result<void> done;
    while (done && !put_off_.empty()) {
      done = put_off_.front()();
      if (done) put_off_.pop_front();
    }
    is_catching_up_ = false;
    return done;
  }
  /// To what was sent, within the patience; a server that does not answer in time is left.
  [[nodiscard]] Result<QueryResult> answer_to(int sent) {
    const auto until = Clock::now() + patience_;
    if (sent == 0) return fail("PostgreSQL: " + one_line(PQerrorMessage(connection_.get())));
    int left = 0;
    while ((left = PQflush(connection_.get())) > 0) {
      if (!wait_for(connection_.get(), POLLOUT | POLLIN, until)) return leave();
      if (PQconsumeInput(connection_.get()) == 0) left = -1;
    }
    Result<QueryResult> answer = fail("PostgreSQL: " + one_line(PQerrorMessage(connection_.get())));
    while (left == 0) {
      while (PQisBusy(connection_.get()) != 0) {
        if (!wait_for(connection_.get(), POLLIN, until)) return leave();
        if (PQconsumeInput(connection_.get()) == 0) break;
      }
      const Reply reply{PQgetResult(connection_.get()), &PQclear};
      if (!reply) break;
      answer = answer_of(reply.get());
    }
    return answer;
  }
  [[nodiscard]] Result<QueryResult> leave() {
    connection_.reset();  // whoever asks next connects anew
    rests_until_ = Clock::now() + kRests;
    return fail("PostgreSQL: does not answer");
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

  const std::string address_;
  Connection connection_{nullptr, &PQfinish};
  std::deque<std::function<Result<void>()>> put_off_;
  bool is_catching_up_ = false;
  Clock::duration patience_ = kPatienceAtStart;
  Clock::time_point rests_until_;  ///< after a try that found nobody
};

}  // namespace

Result<std::unique_ptr<Database>> open_postgres(const std::string& address, Database::Try when) {
  char* why = nullptr;
  PQconninfoOption* const parts = PQconninfoParse(address.c_str(), &why);
  const std::string fault = why != nullptr ? one_line(why) : "that is no address";
  PQfreemem(why);
  if (parts == nullptr) return fail("PostgreSQL: " + fault);
  PQconninfoFree(parts);
  return std::make_unique<PostgresDatabase>(address, when);
}

}  // namespace docent::telepresence
