#include "docent/localization/expected_ranges/range_table.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <thread>
#include <vector>

#include "docent/base/files.h"
#include "docent/base/random.h"
#include "docent/localization/markov/testing.h"

namespace docent::localization {
namespace {

bool equal(const RangeTable& a, const RangeTable& b, const StateSpace& space) {
  for (std::size_t place = 0; place < space.places(); ++place)
    for (std::size_t d = 0; d < 2 * a.directions(); ++d)
      if (a.row(place)[d] != b.row(place)[d]) return false;
  return a.frequency() == b.frequency();
}

class CachedTable : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path{::testing::TempDir()} /
              ("range_table_" + std::string{::testing::UnitTest::GetInstance()->current_test_info()->name()});
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  [[nodiscard]] RangeTable get(const std::string& key, int& told) const {
    const RangeTable::Building how{1, [&told](double share) {
                                     EXPECT_GT(share, 0.0);
                                     EXPECT_LE(share, 1.0);
                                     ++told;
                                   }};
    return RangeTable::load_or_build(folder_ / "table", key, room_.space, room_.caster,
                                     sensor_models::ProximityModel{{}}, how);
  }
  testing::Room room_;
  std::filesystem::path folder_;
};

TEST_F(CachedTable, RowsAndTilesHoldTheRaysOfEachPlace) {
  const sensor_models::ProximityModel model{{}};
  for (const std::size_t place : {std::size_t{0}, std::size_t{63}, std::size_t{64}, room_.space.places() - 1}) {
    for (int h = 0; h < room_.space.headings(); ++h) {
      const Point2 direction = unit(Angle::radians(h * room_.space.heading_step()));
      const double range = room_.caster.cast(room_.space.centre(place), direction, 10.0, 0.3).value() + 0.025;
      const auto d = static_cast<std::size_t>(h);
      EXPECT_EQ(room_.table.row(place)[d], model.bin(range));
      EXPECT_EQ(room_.table.row(place)[d + room_.table.directions()], model.bin(range));
      EXPECT_EQ(room_.table.tile(place / 64)[d * 64 + place % 64], model.bin(range));
    }
  }
  ASSERT_NE(room_.space.places() % 64, 0U);
  EXPECT_EQ(room_.table.tile(room_.space.places() / 64)[63], sensor_models::kUnknownRange);
}

TEST_F(CachedTable, AConeExpectsTheNearestOfItsDirections) {
  sensor_models::ProximityModelParams sonar;
  sonar.max_range = 3.0;
  const sensor_models::ProximityModel rays{{}};
  const sensor_models::ProximityModel model{sonar};
  const RangeTable cones = RangeTable::cones(room_.table, rays, room_.space, model, 0.42);  // 24 degrees: 5 directions
  const int headings = room_.space.headings();
  int beyond = 0;
  for (std::size_t place = 0; place < room_.space.places(); ++place) {
    for (int d = 0; d < headings; ++d) {
      double nearest = 100.0;
      for (int k = -2; k <= 2; ++k) {
        const auto direction = static_cast<std::size_t>((d + k + headings) % headings);
        nearest = std::min(nearest, rays.centre(room_.table.row(place)[direction]));
      }
      ASSERT_EQ(cones.row(place)[static_cast<std::size_t>(d)], model.bin(nearest)) << place << ", " << d;
      beyond += nearest >= 3.0 ? 1 : 0;
    }
  }
  EXPECT_GT(beyond, 0);
  EXPECT_EQ(cones.tile(room_.space.places() / 64)[63], sensor_models::kUnknownRange);
}

TEST_F(CachedTable, ThreadsMakeTheSameTable) {
  const RangeTable table = RangeTable::build(room_.space, room_.caster, sensor_models::ProximityModel{{}}, {5, {}});
  EXPECT_TRUE(equal(table, room_.table, room_.space));
}

TEST_F(CachedTable, IsBuiltOnceAndThenRead) {
  int told = 0;
  EXPECT_TRUE(equal(get("a", told), room_.table, room_.space));
  EXPECT_GT(told, 0);
  told = 0;
  EXPECT_TRUE(equal(get("a", told), room_.table, room_.space));
  EXPECT_EQ(told, 0);
  EXPECT_TRUE(equal(get("another map", told), room_.table, room_.space));
  EXPECT_GT(told, 0);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator{folder_}, {}), 1);  // nothing is left beside it
}

TEST_F(CachedTable, ADamagedFileIsBuiltAnew) {
  int told = 0;
  static_cast<void>(get("a", told));
  {
    std::fstream file{folder_ / "table", std::ios::in | std::ios::out | std::ios::binary};
    file.seekp(1000);
    file.put('\x55');
  }
  told = 0;
  EXPECT_TRUE(equal(get("a", told), room_.table, room_.space));
  EXPECT_GT(told, 0);
  std::filesystem::resize_file(folder_ / "table", 500);
  EXPECT_TRUE(equal(get("a", told), room_.table, room_.space));
}

TEST_F(CachedTable, AWholeTableOfAnotherProgramIsBuiltAnew) {
  int told = 0;
  OccupancyGrid map = room_.map;
  map.cells[map.frame.index({50, 40})] = OccupancyGrid::kOccupied;
  const sensor_models::RayCaster other{map};  // for the same key
  static_cast<void>(RangeTable::load_or_build(folder_ / "table", "a", room_.space, other,
                                              sensor_models::ProximityModel{{}}, {1, {}}));
  EXPECT_TRUE(equal(get("a", told), room_.table, room_.space));
  EXPECT_GT(told, 0);
}

TEST_F(CachedTable, ManyMayBuildItAtOnce) {
  std::vector<int> told(6, 0);
  std::vector<std::optional<RangeTable>> tables(told.size());
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < told.size(); ++i) threads.emplace_back([&, i] { tables[i] = get("a", told[i]); });
  }
  for (const auto& table : tables) EXPECT_TRUE(equal(*table, room_.table, room_.space));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator{folder_}, {}), 1);
  int more = 0;
  EXPECT_TRUE(equal(get("a", more), room_.table, room_.space));
  EXPECT_EQ(more, 0) << "what they left is whole";
}

TEST_F(CachedTable, EveryCutAndEveryFlippedBitIsFound) {
  int told = 0;
  static_cast<void>(get("a", told));
  const std::string whole = read_file(folder_ / "table").value();
  Rng rng{1};
  for (int i = 0; i < 200; ++i) {
    std::string spoilt = whole;
    if (rng.chance(0.3)) {
      spoilt.resize(static_cast<std::size_t>(rng.integer(0, static_cast<std::int64_t>(whole.size()) - 1)));
    } else {  // the header's last bytes say nothing
      auto at = static_cast<std::size_t>(rng.integer(0, static_cast<std::int64_t>(whole.size()) - 1));
      if (at >= 40 && at < 64) at = 0;
      spoilt[at] = static_cast<char>(spoilt[at] ^ (1 << rng.integer(0, 7)));
    }
    ASSERT_TRUE(write_file_atomically(folder_ / "table", spoilt, Survives::process_death));
    told = 0;
    ASSERT_TRUE(equal(get("a", told), room_.table, room_.space)) << i;
    ASSERT_GT(told, 0) << i;
  }
}

TEST_F(CachedTable, WhatIsNoFileIsNotWaitedFor) {
  int told = 0;
  ASSERT_EQ(::mkfifo((folder_ / "table").c_str(), 0600), 0);
  EXPECT_TRUE(equal(get("a", told), room_.table, room_.space));
  std::filesystem::remove_all(folder_ / "table");
  std::filesystem::create_directories(folder_ / "table/full");
  EXPECT_TRUE(equal(get("a", told), room_.table, room_.space));
}

TEST_F(CachedTable, WhatCannotBeWrittenStaysInMemory) {
  int told = 0;
  std::filesystem::remove_all(folder_);
  EXPECT_TRUE(equal(get("a", told), room_.table, room_.space));
}

}  // namespace
}  // namespace docent::localization
