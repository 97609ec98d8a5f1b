#include "docent/telepresence/counting/statistics.h"

#include <gtest/gtest.h>

#include "docent/telepresence/store/postgres_fixture.h"

namespace docent::telepresence {
namespace {

const Time kNoon = time_from_seconds(1'764'072'000);  // 2025-11-25 12:00 UTC
constexpr double kDay = 86'400.0;

void fill_and_check(Database& database, Database& other) {
  auto here = std::move(*Statistics::open(database));
  auto there = std::move(*Statistics::open(other));
  ASSERT_TRUE(here->add(kNoon, "open", {{Counted::distance_m, 100.5}, {Counted::max_speed, 0.7}, {Counted::web, 2}}));
  ASSERT_TRUE(there->add(kNoon, "open", {{Counted::distance_m, 50.0}, {Counted::max_speed, 0.5}}));
  ASSERT_TRUE(there->add(kNoon, "web", {{Counted::votes, 3}}));
  ASSERT_TRUE(here->add(kNoon + seconds(kDay), "open", {{Counted::tours, 1}}));
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(here->add_web_visitors(kNoon, "open", {"192.0.2.1"}));
    ASSERT_TRUE(there->add_web_visitors(kNoon, "open", {"192.0.2.1"}));
    ASSERT_TRUE(there->add_web_visitors(kNoon, "open", {"192.0.2.2"}));
  }
  const auto days = *there->days("");
  ASSERT_EQ(days.size(), 3U);
  EXPECT_EQ(days[0].day, "2025-11-25");
  EXPECT_EQ(days[0].mode, "open");
  EXPECT_EQ(days[0].counts, (Counts{{Counted::distance_m, 150.5}, {Counted::max_speed, 0.7}, {Counted::web, 2.0}}));
  EXPECT_EQ(days[0].web_visitors, 2) << "by the day's different addresses, through whichever gateway";
  EXPECT_EQ(days[1].mode, "web");
  EXPECT_EQ(days[2].counts, (Counts{{Counted::tours, 1.0}}));
  EXPECT_EQ(here->days("2025-11-26")->size(), 1U);

  EXPECT_TRUE(*here->may_count_robot("here", kNoon));
  EXPECT_FALSE(*there->may_count_robot("there", kNoon + seconds(10)));
  EXPECT_TRUE(*here->may_count_robot("here", kNoon + seconds(20)));
  EXPECT_TRUE(*there->may_count_robot("there", kNoon + seconds(51))) << "the first is gone";
  EXPECT_FALSE(*here->may_count_robot("here", kNoon + seconds(52)));
}

TEST(TheStatistics, AddUpByDayAndHours) {
  const std::string path = testing::TempDir() + "/statistics-" + std::to_string(::getpid()) + ".sqlite";
  {
    auto one = std::move(*Database::open(path));
    auto other = std::move(*Database::open(path));
    fill_and_check(*one, *other);
  }
  // Once both are closed SQLite has removed its own files beside it.
  for (const char* end : {"", ".lock"}) std::filesystem::remove(path + end);
}

TEST(TheStatistics, AddUpInASharedDatabase) {
  const Postgres server;
  if (!server.is_installed()) GTEST_SKIP() << "no PostgreSQL here";
  ASSERT_TRUE(server.is_running());
  auto one = std::move(*Database::open(server.address()));
  auto other = std::move(*Database::open(server.address()));
  fill_and_check(*one, *other);
}

TEST(TheStatistics, KeepNoAddressAndNoOldSalt) {
  auto database = std::move(*Database::open(":memory:"));
  auto statistics = std::move(*Statistics::open(*database));
  ASSERT_TRUE(statistics->add_web_visitors(kNoon, "open", {"192.0.2.1"}));
  ASSERT_TRUE(statistics->add_web_visitors(kNoon + seconds(kDay), "open", {"192.0.2.1"}));
  const auto hashes = *database->run("SELECT DISTINCT hash FROM web_visitors");
  ASSERT_EQ(hashes.rows.size(), 2U) << "the same address is another on another day";
  EXPECT_EQ(hashes.rows[0].text(0).find("192.0.2.1"), std::string::npos);
  EXPECT_EQ(database->run("SELECT count(*) FROM day_salts")->rows[0].number(0), 1);
}

}  // namespace
}  // namespace docent::telepresence
