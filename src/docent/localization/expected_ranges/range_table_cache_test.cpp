#include "docent/localization/expected_ranges/range_table_cache.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <set>

#include "docent/localization/markov/markov_localizer.h"
#include "docent/localization/markov/testing.h"

namespace docent::localization {
namespace {

using std::chrono::hours;
using std::chrono::minutes;

class FolderOfTables : public ::testing::Test {
 protected:
  void SetUp() override {
    cache_.folder =
        std::filesystem::path{::testing::TempDir()} /
        ("range_table_cache_" + std::string{::testing::UnitTest::GetInstance()->current_test_info()->name()});
    std::filesystem::remove_all(cache_.folder);
    std::filesystem::create_directories(cache_.folder);
  }
  void TearDown() override { std::filesystem::remove_all(cache_.folder); }
  std::filesystem::path put(const std::string& name, std::size_t bytes, std::chrono::seconds age) const {
    auto path = cache_.folder / name;
    std::ofstream{path} << std::string(bytes, 'x');
    std::filesystem::last_write_time(path, std::filesystem::file_time_type::clock::now() - age);
    return path;
  }
  [[nodiscard]] std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator{cache_.folder})
      all.insert(entry.path().filename().string());
    return all;
  }
  RangeTableCache cache_;
};

TEST_F(FolderOfTables, WhatWasNotUsedForTheLongestTimeMakesRoom) {
  cache_.most_bytes = 250;
  const auto in_use = put("range-table-1", 100, hours{9});
  put("range-table-2", 100, hours{1});
  put("range-table-3", 100, hours{3});
  put("range-table-4", 100, hours{2});
  put("somebody's", 1000, hours{90});
  cache_.make_room(in_use);
  EXPECT_EQ(names(), (std::set<std::string>{"range-table-1", "range-table-2", "somebody's"}));
  cache_.most_bytes = 50;
  cache_.make_room(in_use);
  EXPECT_EQ(names(), (std::set<std::string>{"range-table-1", "somebody's"})) << "what is in use stays";
}

TEST_F(FolderOfTables, WhatADeadProcessLeftHalfWrittenGoes) {
  put("range-table-1.partabcdef", 100, hours{2});
  put("range-table-2.partabcdef", 100, minutes{5});  // somebody may be at it
  cache_.make_room({});
  EXPECT_EQ(names(), (std::set<std::string>{"range-table-2.partabcdef"}));
}

TEST_F(FolderOfTables, EachMapAndEachParameterHasATableOfItsOwn) {
  OccupancyGrid map = testing::room_map();
  LocalizerParams params;
  params.states.cell_size = 0.3;
  const auto make = [&] {
    const sensor_models::RayCaster caster{map};
    static_cast<void>(range_table_of(map, params, cache_, StateSpace{map, caster, params.states}, caster));
    return names().size();
  };
  EXPECT_EQ(make(), 1U);
  EXPECT_EQ(make(), 1U);
  params.beams = 90;  // no table depends on it
  EXPECT_EQ(make(), 1U);
  params.sensor.max_range += 1e-9;
  EXPECT_EQ(make(), 2U);
  params.states.min_clearance += 0.01;
  EXPECT_EQ(make(), 3U);
  params.states.heading_step = 4.0;
  EXPECT_EQ(make(), 4U);
  params.states.cell_size = 0.25;
  EXPECT_EQ(make(), 5U);
  map.cells[map.frame.index({map.frame.columns / 2, map.frame.rows / 2})] = OccupancyGrid::kOccupied;
  EXPECT_EQ(make(), 6U);
  map.frame.resolution *= 1.01;
  EXPECT_EQ(make(), 7U);
}

TEST_F(FolderOfTables, AUsedTableIsYoungAgain) {
  const OccupancyGrid map = testing::room_map();
  const sensor_models::RayCaster caster{map};
  LocalizerParams params;
  params.states.cell_size = 0.3;
  const auto use = [&] {
    static_cast<void>(range_table_of(map, params, cache_, StateSpace{map, caster, params.states}, caster));
  };
  use();
  const auto file = std::filesystem::directory_iterator { cache_.folder } -> path();
  const auto long_ago = std::filesystem::file_time_type::clock::now() - hours{50};
  std::filesystem::last_write_time(file, long_ago);
  use();
  EXPECT_GT(std::filesystem::last_write_time(file), long_ago + hours{49});
}

}  // namespace
}  // namespace docent::localization
