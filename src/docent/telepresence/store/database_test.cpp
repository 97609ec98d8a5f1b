#include "docent/telepresence/store/database.h"

#include <signal.h>
#include <sys/wait.h>

#include <cstdio>
#include <thread>

#include "docent/telepresence/store/migrations.h"
#include "docent/telepresence/store/postgres_fixture.h"

// The same for a file and for a server.

namespace docent::telepresence {
namespace {

enum class Kind { file, server };

class Store : public testing::TestWithParam<Kind> {
 protected:
  static void SetUpTestSuite() { postgres = std::make_unique<Postgres>(); }
  static void TearDownTestSuite() { postgres.reset(); }
  void SetUp() override {
    if (GetParam() == Kind::file) {
      char name[] = "/tmp/docent-store-XXXXXX";
      folder_ = ::mkdtemp(name);
      where_ = (folder_ / "web.sqlite").string();
    } else if (!postgres->is_installed()) {
      GTEST_SKIP() << "skipped: no PostgreSQL is installed";
    } else {
      ASSERT_TRUE(postgres->is_running());
      where_ = postgres->address();
    }
    database_ = open();
    if (GetParam() == Kind::server) {
      ASSERT_TRUE(database_->run_script("DROP SCHEMA public CASCADE; CREATE SCHEMA public"));
    }
  }
  void TearDown() override {
    database_.reset();
    std::filesystem::remove_all(folder_);
  }
  [[nodiscard]] std::unique_ptr<Database> open() const {
    auto database = Database::open(where_);
    EXPECT_TRUE(database) << database.error().message;
    return database ? std::move(*database) : nullptr;
  }
  [[nodiscard]] std::int64_t count(const std::string& table) const {
    auto answer = database_->run("SELECT count(*) FROM " + table);
    EXPECT_TRUE(answer) << answer.error().message;
    return answer ? answer->rows.at(0).number(0) : -1;
  }
  static std::unique_ptr<Postgres> postgres;
  std::filesystem::path folder_;
  std::string where_;
  std::unique_ptr<Database> database_;
};
std::unique_ptr<Postgres> Store::postgres;

TEST_P(Store, ValuesComeBackAsTheyWere) {
  ASSERT_TRUE(database_->run_script("CREATE TABLE t (a BIGINT, b DOUBLE PRECISION, c TEXT, d TEXT)"));
  const std::string odd = "Zo\xc3\xab'); DROP TABLE t; -- \"$1\"";
  auto put = database_->run("INSERT INTO t (a, b, c, d) VALUES ($1, $2, $3, $4)",
                            {std::int64_t{-9'000'000'000'000'000'000}, 0.1, odd, std::monostate{}});
  ASSERT_TRUE(put) << put.error().message;
  EXPECT_EQ(put->changed, 1);
  auto got = database_->run("SELECT a, b, c, d FROM t WHERE c = $1", {odd});
  ASSERT_TRUE(got) << got.error().message;
  ASSERT_EQ(got->rows.size(), 1U);
  EXPECT_EQ(got->rows[0].number(0), -9'000'000'000'000'000'000);
  EXPECT_EQ(got->rows[0].real(1), 0.1);
  EXPECT_EQ(got->rows[0].text(2), odd);
  EXPECT_TRUE(got->rows[0].is_null(3));
  EXPECT_EQ(got->rows[0].text(3), "");
}

TEST_P(Store, ATransactionIsWholeOrNothing) {
  ASSERT_TRUE(database_->run_script("CREATE TABLE t (a BIGINT PRIMARY KEY)"));
  const auto two = [&](std::int64_t second) {
    return database_->in_transaction([&]() -> Result<void> {
      for (const std::int64_t value : {std::int64_t{1}, second}) {
        auto put = database_->run("INSERT INTO t (a) VALUES ($1)", {value});
        if (!put) return tl::unexpected<Error>(put.error());
      }
      return {};
    });
  };
  EXPECT_FALSE(two(1)) << "twice the same key";
  EXPECT_EQ(count("t"), 0);
  EXPECT_TRUE(two(2));
  EXPECT_EQ(count("t"), 2);
}

TEST_P(Store, ATransactionWithinAnotherIsPartOfIt) {
  ASSERT_TRUE(database_->run_script("CREATE TABLE t (a BIGINT PRIMARY KEY)"));
  const auto put = [&](std::int64_t value) {
    return database_->in_transaction([&]() -> Result<void> {
      auto done = database_->run("INSERT INTO t (a) VALUES ($1)", {value});
      if (!done) return tl::unexpected<Error>(done.error());
      return {};
    });
  };
  EXPECT_FALSE(database_->in_transaction([&]() -> Result<void> {
    if (auto first = put(1); !first) return first;
    return put(1);
  }));
  EXPECT_EQ(count("t"), 0);
  EXPECT_TRUE(database_->in_transaction([&] { return put(1); }));
  EXPECT_TRUE(put(2));
  EXPECT_EQ(count("t"), 2);
}

TEST_P(Store, FaultsAreSaidAndHarmNothing) {
  EXPECT_FALSE(database_->run("SELECT nonsense"));
  EXPECT_FALSE(database_->run("INSERT INTO nowhere (a) VALUES ($1)", {std::int64_t{1}}));
  ASSERT_TRUE(database_->run_script("CREATE TABLE t (a BIGINT)"));
  EXPECT_EQ(count("t"), 0);
}

TEST_P(Store, MigratesForward) {
  const Migration first[] = {{"one", "CREATE TABLE a (x BIGINT)"}};
  const Migration both[] = {{"one", "CREATE TABLE a (x BIGINT)"},
                            {"two", "ALTER TABLE a ADD COLUMN y TEXT; CREATE TABLE b (z BIGINT)"}};
  ASSERT_TRUE(migrate(*database_, "part", first));
  ASSERT_TRUE(database_->run("INSERT INTO a (x) VALUES ($1)", {std::int64_t{7}}));
  ASSERT_TRUE(migrate(*database_, "part", both));
  ASSERT_TRUE(migrate(*database_, "part", both)) << "nothing to do";
  EXPECT_EQ(count("a"), 1);
  EXPECT_EQ(count("b"), 0);
  EXPECT_FALSE(migrate(*database_, "part", first)) << "an older program must not touch it";
  // A step that fails leaves everything as it was.
  const Migration bad[] = {both[0], both[1], {"three", "CREATE TABLE c (x BIGINT); CREATE TABLE a (x BIGINT)"}};
  EXPECT_FALSE(migrate(*database_, "part", bad));
  EXPECT_FALSE(database_->run("SELECT * FROM c"));
  EXPECT_TRUE(migrate(*database_, "part", both));
}

TEST_P(Store, TwoThatMigrateAtOnceDoItOnce) {
  const Migration steps[] = {{"one", "CREATE TABLE a (x BIGINT)"}, {"two", "INSERT INTO a (x) VALUES (1)"}};
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      const auto mine = open();
      auto done = migrate(*mine, "part", steps);
      if (!done) done = migrate(*mine, "part", steps);  // both may have begun to make the very first table
      EXPECT_TRUE(done) << done.error().message;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(count("a"), 1);
}

/// Starts a writer, kills it in the middle, and returns the last number that it said was stored.
std::int64_t write_and_die(const std::string& where, const std::string& name, int after_ms) {
  int ends[2];
  if (::pipe(ends) != 0) return 0;
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(ends[1], STDOUT_FILENO);
    ::close(ends[0]);
    ::execl(DOCENT_STORE_WRITER, DOCENT_STORE_WRITER, where.c_str(), name.c_str(), nullptr);
    ::_exit(127);
  }
  ::close(ends[1]);
  FILE* said = ::fdopen(ends[0], "r");
  long long number = 0;
  long long last = 0;
  if (std::fscanf(said, "%lld", &number) == 1) last = number;  // it has begun
  std::this_thread::sleep_for(std::chrono::milliseconds{after_ms});
  ::kill(child, SIGKILL);
  while (std::fscanf(said, "%lld", &number) == 1) last = number;
  std::fclose(said);
  ::waitpid(child, nullptr, 0);
  return last;
}

TEST_P(Store, NothingThatWasStoredIsLostWhenTheWriterIsKilled) {
  const char* wanted = std::getenv("DOCENT_KILLS");
  const int kills = wanted != nullptr ? std::atoi(wanted) : 10;
  std::int64_t all = 0;
  for (int i = 0; i < kills; ++i) {
    const std::string name = "w" + std::to_string(i);
    const std::int64_t last = write_and_die(where_, name, 5 + 7 * (i % 6));
    ASSERT_GT(last, 0);
    auto found = database_->run("SELECT count(*), max(number) FROM rows WHERE writer = $1", {name});
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_GE(found->rows[0].number(1), last) << name;
    EXPECT_EQ(found->rows[0].number(0), found->rows[0].number(1)) << "without gaps";
    all += last;
  }
  std::printf("%d kills, %lld rows that were said to be stored, none lost\n", kills, static_cast<long long>(all));
}

TEST_P(Store, AFileThatIsNoDatabaseIsKeptBesideANewOne) {
  if (GetParam() != Kind::file) GTEST_SKIP() << "of files alone";
  database_.reset();
  std::ofstream{where_} << "this is no database, but long enough to be looked at as if it were one "
                        << std::string(600, 'x');
  const auto again = open();
  ASSERT_TRUE(again);
  EXPECT_NE(again->notice().find("web.sqlite.damaged-"), std::string::npos) << again->notice();
  EXPECT_TRUE(again->run_script("CREATE TABLE t (a BIGINT)"));
}

TEST_P(Store, AServerThatCameBackIsUsedAgain) {
  if (GetParam() != Kind::server) GTEST_SKIP() << "of servers alone";
  ASSERT_TRUE(database_->run_script("CREATE TABLE t (a BIGINT)"));
  ASSERT_TRUE(postgres->restart());
  Result<QueryResult> put = fail("not tried");
  for (int i = 0; i < 100 && !put; ++i) {
    put = database_->run("INSERT INTO t (a) VALUES (1)");
    if (!put) std::this_thread::sleep_for(std::chrono::milliseconds{50});
  }
  ASSERT_TRUE(put) << put.error().message;
  EXPECT_EQ(count("t"), 1);
}

TEST_P(Store, AServerThatHangsIsGoneAfterThePatienceAndUsedAgainWhenItAnswers) {
  if (GetParam() != Kind::server) GTEST_SKIP() << "of servers alone";
  using Clock = std::chrono::steady_clock;
  ASSERT_TRUE(database_->run_script("CREATE TABLE t (a BIGINT)"));
  database_->set_patience(seconds(0.3));
  ASSERT_TRUE(postgres->hang(true));
  const auto begun = Clock::now();
  EXPECT_FALSE(database_->run("INSERT INTO t (a) VALUES (1)"));
  EXPECT_TRUE(database_->is_gone());
  EXPECT_LT(Clock::now() - begun, std::chrono::seconds{2});
  const auto again = Clock::now();
  EXPECT_FALSE(database_->run("INSERT INTO t (a) VALUES (1)")) << "and nobody waits for it a second time";
  EXPECT_LT(Clock::now() - again, std::chrono::milliseconds{300});
  ASSERT_TRUE(postgres->hang(false));
  Result<QueryResult> put = fail("not tried");
  for (int i = 0; i < 100 && !put; ++i) {
    put = database_->run("INSERT INTO t (a) VALUES (2)");
    if (!put) std::this_thread::sleep_for(std::chrono::milliseconds{50});
  }
  ASSERT_TRUE(put) << put.error().message;
}

TEST_P(Store, AServerThatWasGoneAtTheStartIsTakenUpWhenItAnswers) {
  if (GetParam() != Kind::server) GTEST_SKIP() << "of servers alone";
  const Migration steps[] = {{"one", "CREATE TABLE a (x BIGINT)"}};
  for (const Database::Try when : {Database::Try::now, Database::Try::later}) {
    ASSERT_TRUE(database_->run_script("DROP SCHEMA public CASCADE; CREATE SCHEMA public"));
    ASSERT_TRUE(postgres->hang(true));
    const auto begun = std::chrono::steady_clock::now();
    auto late = Database::open(where_, when);
    ASSERT_TRUE(late) << late.error().message;
    EXPECT_TRUE((*late)->is_gone());
    EXPECT_TRUE(migrate(**late, "part", steps)) << "put off";
    EXPECT_FALSE((*late)->run("SELECT count(*) FROM a"));
    EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds{4});
    ASSERT_TRUE(postgres->hang(false));
    Result<QueryResult> put = fail("not tried");
    for (int i = 0; i < 100 && !put; ++i) {
      put = (*late)->in_transaction([&] { return done((*late)->run("INSERT INTO a (x) VALUES (1)")); })
                ? (*late)->run("SELECT count(*) FROM a")
                : Result<QueryResult>{fail("not yet")};
      if (!put) std::this_thread::sleep_for(std::chrono::milliseconds{50});
    }
    ASSERT_TRUE(put) << put.error().message;
    EXPECT_EQ(put->rows.at(0).number(0), 1);
    EXPECT_FALSE((*late)->put_off([] { return Result<void>{}; })) << "somebody answers";
  }
}

TEST(StoreAddress, WhereNobodyAnswersEachStatementFails) {
  auto nobody = Database::open("postgresql:///nothing?host=/nowhere");
  ASSERT_TRUE(nobody);
  EXPECT_TRUE((*nobody)->is_gone());
  const auto asked = (*nobody)->run("SELECT 1");
  ASSERT_FALSE(asked);
  EXPECT_NE(asked.error().message.find("PostgreSQL: "), std::string::npos) << asked.error().message;
  const Migration bad[] = {{"one", "CREATE nonsense"}};
  EXPECT_TRUE(migrate(**nobody, "part", bad)) << "put off";
  EXPECT_FALSE(Database::open("postgresql://docent@[nowhere/docent")) << "that is no address";
  EXPECT_FALSE(Database::open("/dev/null/at/all/web.sqlite"));
}

INSTANTIATE_TEST_SUITE_P(Both, Store, testing::Values(Kind::file, Kind::server),
                         [](const auto& kind) { return kind.param == Kind::file ? "file" : "server"; });

}  // namespace
}  // namespace docent::telepresence
