#include "docent/grid/occupancy_grid.h"

#include <gtest/gtest.h>

#include <limits>

#include "docent/base/files.h"
#include "docent/base/random.h"
#include "docent/grid/map_classes.h"

namespace docent {
namespace {

class Maps : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) {
    ASSERT_TRUE(write_file_atomically(folder_ / name, text).has_value());
  }
  std::string fault_of(const std::string& yaml) {
    write("m.yaml", yaml);
    const auto map = load_map(folder_ / "m.yaml");
    if (map) return "";
    const auto& message = map.error().message;
    return message.substr(message.rfind('/') + 1);
  }
  std::filesystem::path folder_ = std::filesystem::path{::testing::TempDir()} / "docent_maps_test";
};

TEST_F(Maps, TheImagesFirstRowIsTheTop) {
  write("m.pgm", "P2\n# a comment\n3 2\n255\n0 254 205\n254 254 254\n");
  write("m.yaml", "image: m.pgm\nresolution: 0.5\norigin: [-1, 2, 0]\nnegate: 0\n");
  const auto map = load_map(folder_ / "m.yaml");
  ASSERT_TRUE(map.has_value()) << map.error().message;
  EXPECT_TRUE(map->is_occupied({0, 1}));
  EXPECT_TRUE(map->is_free({1, 1}));
  EXPECT_EQ(map->at({2, 1}), OccupancyGrid::kUnknown);
  EXPECT_TRUE(map->is_free({0, 0}));
  EXPECT_EQ(map->at({3, 0}), OccupancyGrid::kUnknown) << "outside is unknown";
  EXPECT_EQ(map->frame.centre({0, 1}), (Point2{-0.75, 2.75}));
  EXPECT_EQ(map->frame.cell_at({-0.75, 2.75}), (CellIndex{0, 1}));
}

TEST_F(Maps, WhatIsSavedIsLoaded) {
  OccupancyGrid map;
  map.frame = {7, 5, 0.05, {1.5, -2.25}};
  for (std::size_t i = 0; i < map.frame.size(); ++i) {
    map.cells.push_back(i % 3 == 0   ? OccupancyGrid::kUnknown
                        : i % 3 == 1 ? OccupancyGrid::kFree
                                     : OccupancyGrid::kOccupied);
  }
  ASSERT_TRUE(save_map(map, folder_ / "saved").has_value());
  const auto back = load_map(folder_ / "saved.yaml");
  ASSERT_TRUE(back.has_value()) << back.error().message;
  EXPECT_EQ(back->cells, map.cells);
  EXPECT_EQ(map_hash(*back), map_hash(map));
}

TEST_F(Maps, AMapIsNotSavedWithoutAName) {
  OccupancyGrid map;
  map.frame = {1, 1, 0.05, {}};
  map.cells = {OccupancyGrid::kFree};
  const std::string here = folder_.string();
  for (const std::string& nameless : {std::string{}, here + "/", here + "/.", here + "/..", std::string{"/"}}) {
    const auto saved = save_map(map, nameless);
    ASSERT_FALSE(saved.has_value()) << nameless;
    EXPECT_EQ(saved.error().message, "'" + nameless + "': the map's name is missing: expected FOLDER/NAME");
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
  EXPECT_TRUE(save_map(map, here + "/sub.map").has_value()) << "a dot in it is part of the name";
}

/// Four pixels in a row: black, the shade of every map_saver for unknown, one a little lighter, white.
std::vector<std::int8_t> row_of(const std::filesystem::path& folder, const std::string& yaml) {
  EXPECT_TRUE(write_file_atomically(folder / "m.pgm", "P2\n4 1\n255\n0 205 230 254\n"));
  EXPECT_TRUE(write_file_atomically(folder / "m.yaml", "image: m.pgm\nresolution: 0.5\norigin: [0, 0, 0]\n" + yaml));
  const auto map = load_map(folder / "m.yaml");
  EXPECT_TRUE(map.has_value()) << map.error().message;
  return map ? map->cells : std::vector<std::int8_t>{};
}

TEST_F(Maps, WhatTheSaverOfNav2CallsUnknownIsUnknown) {
  // (255 - 205) / 255 = 0.196 is less than its own threshold.
  const std::string nav2 = "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.25\n";
  EXPECT_EQ(row_of(folder_, nav2), (std::vector<std::int8_t>{100, -1, 0, 0}));
  EXPECT_EQ(row_of(folder_, "mode: trinary\n" + nav2), (std::vector<std::int8_t>{100, -1, 0, 0}));
  EXPECT_EQ(row_of(folder_, "occupied_thresh: 0.65\nfree_thresh: 0.05\n"), (std::vector<std::int8_t>{100, -1, -1, 0}));
  EXPECT_EQ(row_of(folder_, "negate: 1\noccupied_thresh: 0.65\nfree_thresh: 0.25\n"),
            (std::vector<std::int8_t>{0, 100, 100, 100}));
}

TEST_F(Maps, ScaleAndRawAreReadAsMapServerReadsThem) {
  EXPECT_EQ(row_of(folder_, "mode: scale\noccupied_thresh: 0.9\nfree_thresh: 0.05\n"),
            (std::vector<std::int8_t>{100, 17, 6, 0}));
  EXPECT_EQ(row_of(folder_, "mode: raw\n"), (std::vector<std::int8_t>{0, -1, -1, -1}));
}

TEST_F(Maps, SuspiciousClassesAreNamed) {
  OccupancyGrid map;
  map.frame = {20, 10, 0.1, {}};
  map.cells.assign(200, OccupancyGrid::kUnknown);
  EXPECT_NE(classes_of(map).warning().find("nothing is free"), std::string::npos);
  for (int column = 5; column < 15; ++column) map.cells[map.frame.index({column, 5})] = OccupancyGrid::kFree;
  EXPECT_NE(classes_of(map).warning().find("nothing is occupied"), std::string::npos);
  map.cells[map.frame.index({4, 5})] = OccupancyGrid::kOccupied;
  EXPECT_EQ(classes_of(map).warning(), "");
  EXPECT_EQ(classes_of(map).text(), "5 % free, 94.5 % unknown, 0.5 % occupied");
  for (auto& cell : map.cells)
    if (cell == OccupancyGrid::kUnknown) cell = OccupancyGrid::kFree;  // the slab
  EXPECT_NE(classes_of(map).warning().find("up to the picture's edge"), std::string::npos);
}

TEST_F(Maps, FaultsNameFileAndLine) {
  write("ok.pgm", "P5\n2 2\n255\nabcd");
  write("short.pgm", "P5\n2 2\n255\nab");
  write("no.png", "this is nothing like an image");
  EXPECT_EQ(fault_of("image: ok.pgm\nresolution: 0.1\n"), "m.yaml:1: missing key 'origin'");
  EXPECT_EQ(fault_of("image: ok.pgm\nresolution: -1\norigin: [0, 0, 0]\n"),
            "m.yaml:2: resolution must be in (0, 10) m");
  EXPECT_EQ(fault_of("image: ok.pgm\nresolution: 1\norigin: [0, 0]\n"), "m.yaml:3: origin must be [x, y, yaw]");
  EXPECT_EQ(fault_of("image: ok.pgm\nresolution: 1\norigin: [0, 0, 1]\n"),
            "m.yaml:3: a turned origin (yaw not 0) is not supported");
  EXPECT_EQ(fault_of("image: short.pgm\nresolution: 1\norigin: [0, 0, 0]\n"),
            "short.pgm:4: PGM ends early: 4 bytes of pixels expected, 2 found");
  EXPECT_EQ(fault_of("image: no.png\nresolution: 1\norigin: [0, 0, 0]\n"), "no.png:1: not a PNG image: Not a PNG file");
  EXPECT_NE(fault_of("image: none.pgm\nresolution: 1\norigin: [0, 0, 0]\n").find("none.pgm: cannot be read"),
            std::string::npos);
}

TEST(Grid, CoarseCellsAreOccupiedIfAnyIs) {
  OccupancyGrid map;
  map.frame = {4, 2, 0.05, {0, 0}};
  map.cells = {0, 0, -1, -1, 0, 100, -1, -1};
  const auto coarse = coarsened(map, 2);
  EXPECT_EQ(coarse.cells, (std::vector<std::int8_t>{100, -1}));
}

TEST(DistanceTransform, EqualsTheSlowTwin) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Rng rng{seed};
    const GridFrame frame{static_cast<int>(rng.integer(1, 30)), static_cast<int>(rng.integer(1, 30)), 0.1, {0, 0}};
    std::vector<bool> occupied(frame.size());
    for (std::size_t i = 0; i < occupied.size(); ++i) occupied[i] = rng.chance(0.05);
    const auto fast = distance_transform(frame, occupied);
    for (int row = 0; row < frame.rows; ++row) {
      for (int column = 0; column < frame.columns; ++column) {
        double least = std::numeric_limits<double>::infinity();
        for (int r = 0; r < frame.rows; ++r) {
          for (int c = 0; c < frame.columns; ++c) {
            if (occupied[frame.index({c, r})]) least = std::min(least, 0.1 * std::hypot(c - column, r - row));
          }
        }
        const auto found = static_cast<double>(fast[frame.index({column, row})]);
        if (std::isinf(least)) {
          EXPECT_TRUE(std::isinf(found)) << "seed " << seed;
        } else {
          EXPECT_NEAR(found, least, 1e-5) << "seed " << seed;
        }
      }
    }
  }
}

}  // namespace
}  // namespace docent
