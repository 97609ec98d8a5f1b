#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>

#include "docent/base/files.h"
#include "docent/grid/map_reading.h"
#include "docent/grid/occupancy_grid.h"

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

TEST_F(Maps, FaultsNameFileAndLine) {
  write("ok.pgm", "P5\n2 2\n255\nabcd");
  write("short.pgm", "P5\n2 2\n255\nab");
  write("no.png", "this is nothing like an image");
  EXPECT_EQ(fault_of("image: ok.pgm\nresolution: 0.1\n"), "m.yaml:1: missing key 'origin'");
  EXPECT_EQ(fault_of("image: ok.pgm\nresolution: -1\norigin: [0, 0, 0]\n"),
            "m.yaml:2: resolution must be in (0, 10) m");
  EXPECT_EQ(fault_of("image: ok.pgm\nresolution: 1\norigin: [0, 0]\n"), "m.yaml:3: origin must be [x, y, yaw]");
  EXPECT_EQ(fault_of("image: short.pgm\nresolution: 1\norigin: [0, 0, 0]\n"),
            "short.pgm:4: PGM ends early: 4 bytes of pixels expected, 2 found");
  EXPECT_EQ(
      fault_of("image: no.png\nresolution: 1\norigin: [0, 0, 0]\n"),
      "no.png:1: a PNG image begins with the byte 137 and PNG, and this file does not: it is damaged, or something "
      "else");
  write("broken.PGM", "Pn\n2 2\n255\nabcd");
  EXPECT_EQ(fault_of("image: broken.PGM\nresolution: 1\norigin: [0, 0, 0]\n"),
            "broken.PGM:1: a PGM image begins with P5 or P2, and this file does not: it is damaged, or something else");
  write("map.raw", "this is nothing like an image");
  EXPECT_EQ(fault_of("image: map.raw\nresolution: 1\norigin: [0, 0, 0]\n"),
            "map.raw:1: neither a PGM (P2, P5) nor a PNG image");
  EXPECT_NE(fault_of("image: none.pgm\nresolution: 1\norigin: [0, 0, 0]\n").find("none.pgm: cannot be read"),
            std::string::npos);
}

/// A map of two by two: wall and unknown above, free and free below, in one odd form.
TEST_F(Maps, ReadsWhatMapServerReads) {
  write("m.pgm", "P2\n2 2\n255\n0 205 254 254\n");
  const std::string plain = "image: m.pgm\nresolution: 0.5\norigin: [0, 0, 0]\n";
  const std::vector<std::int8_t> right{0, 0, 100, -1};
  for (const std::string odd :
       {"", "negate: false\n", "mode: Trinary\n", "mode: TRINARY\nnegate: False\n", "map_name: ground floor\n"}) {
    write("m.yaml", plain + odd);
    const auto read = read_map(folder_ / "m.yaml");
    ASSERT_TRUE(read) << odd << read.error().message;
    EXPECT_EQ(read->map.cells, right) << odd;
    EXPECT_EQ(read->notes.size(), odd.starts_with("map_name") ? 1U : 0U) << odd;
  }
  write("m.yaml", plain + "negate: true\n");
  EXPECT_EQ(load_map(folder_ / "m.yaml")->cells, (std::vector<std::int8_t>{100, 100, 0, 100}));
  write("m.yaml", plain + "negate: 2\n");
  EXPECT_FALSE(load_map(folder_ / "m.yaml"));
}

TEST_F(Maps, AnOddResolutionAndASecondDocumentAreSaid) {
  write("m.pgm", "P2\n2 2\n255\n0 205 254 254\n");
  const auto notes_of = [&](const std::string& resolution, const std::string& end) {
    write("m.yaml", "---\nimage: m.pgm\nresolution: " + resolution + "\norigin: [0, 0, 0]\n" + end);
    const auto read = read_map(folder_ / "m.yaml");
    EXPECT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->map.frame.resolution, std::stod(resolution)) << "the first document holds";
    return read->notes;
  };
  for (const char* usual : {"0.01", "0.05", "0.25", "0.5"}) EXPECT_TRUE(notes_of(usual, "").empty()) << usual;
  for (const auto& [odd, word] : {std::pair{"5", "coarser"}, {"0.55", "coarser"}, {"0.0005", "finer"}}) {
    const auto notes = notes_of(odd, "");
    ASSERT_EQ(notes.size(), 1U) << odd;
    EXPECT_NE(notes[0].find(std::string{odd} + " m a cell is far " + word), std::string::npos) << notes[0];
  }
  const auto second = notes_of("0.05", "---\nresolution: 0.1\n# --- no more\n");
  ASSERT_EQ(second.size(), 1U);
  EXPECT_EQ(second[0], "another YAML document begins in line 6: it is left out");
  EXPECT_TRUE(notes_of("0.05", "---\n---\n").empty());
  EXPECT_EQ(notes_of("0.05", "---\n...\n---\n- 3\n").size(), 1U);
}

TEST_F(Maps, AnyLineEndsOfAPgm) {
  write("m.yaml", "image: m.pgm\nresolution: 0.5\norigin: [0, 0, 0]\n");
  const std::string cells{"\x00\xcd\xfe\xfe", 4};
  const std::vector<std::int8_t> right{0, 0, 100, -1};
  for (const std::string head :
       {"P5\n2 2\n255\n", "P5\r\n2 2\r\n255\r\n", "P5\r# by a saver\r2 2\r255\r", "P5 2 2 255 "}) {
    for (const std::string tail : {"", "\n"}) {
      write("m.pgm", head + cells + tail);
      const auto read = read_map(folder_ / "m.yaml");
      ASSERT_TRUE(read) << head << read.error().message;
      EXPECT_EQ(read->map.cells, right) << head;
      EXPECT_TRUE(read->notes.empty());
    }
  }
  write("m.pgm", "P5\r2 1\r255\r" + std::string{"\n\xfe", 2});
  EXPECT_EQ(load_map(folder_ / "m.yaml")->cells, (std::vector<std::int8_t>{100, 0}))
      << "a dark first pixel is no line end";
  write("m.pgm", "P5\n2 2\n255\n" + cells + "more of it");
  ASSERT_EQ(read_map(folder_ / "m.yaml")->notes.size(), 1U);
  EXPECT_NE(read_map(folder_ / "m.yaml")->notes.front().find("10 bytes longer"), std::string::npos);
}

TEST_F(Maps, OtherImagesAreNamed) {
  for (const auto& [begin, name] : {std::pair{"BM12345678", "BMP"},
                                    {"\xff\xd8\xff\xe0 JFIF", "JPEG"},
                                    {"II*", "TIFF"},
                                    {"P6\n1 1\n255\nabc", "PPM"}}) {
    write("m.img", std::string{begin} + std::string(1, '\0'));
    EXPECT_NE(fault_of("image: m.img\nresolution: 1\norigin: [0, 0, 0]\n").find(name), std::string::npos) << name;
  }
}

TEST_F(Maps, AYawTurnsTheMap) {
  write("m.pgm", "P2\n3 2\n255\n0 254 205\n254 254 254\n");
  const auto with_yaw = [&](const std::string& yaw) {
    write("m.yaml", "image: m.pgm\nresolution: 0.5\norigin: [1, 2, " + yaw + "]\n");
    auto read = read_map(folder_ / "m.yaml");
    EXPECT_TRUE(read) << read.error().message;
    return read ? *read : LoadedMap{};
  };
  const LoadedMap plain = with_yaw("0");
  for (const char* rest : {"-0.000001", "0.0001", "6.283185307", "-nan", ".nan"})
    EXPECT_EQ(map_hash(with_yaw(rest).map), map_hash(plain.map)) << rest;
  EXPECT_EQ(with_yaw("-nan").notes.size(), 1U);
  const LoadedMap quarter = with_yaw("1.5707963268");  // to the left, about the lower left corner
  EXPECT_EQ(quarter.map.frame.columns, 2);
  EXPECT_EQ(quarter.map.frame.rows, 3);
  EXPECT_NEAR(quarter.map.frame.origin.x, 0.0, 1e-6);
  EXPECT_NEAR(quarter.map.frame.origin.y, 2.0, 1e-6);
  EXPECT_EQ(quarter.map.cells, (std::vector<std::int8_t>{100, 0, 0, 0, -1, 0}));
  EXPECT_EQ(quarter.notes.size(), 1U);
}

TEST_F(Maps, OfAHugeMapWhatIsKnownIsKept) {
  constexpr int kSide = 6000;
  std::string pgm = "P5\n6000 6000\n255\n" + std::string(std::size_t{kSide} * kSide, '\xcd');
  const std::size_t first = pgm.size() - std::size_t{kSide} * kSide;
  const auto set = [&](int column, int row_from_above, char shade) {
    pgm[first + static_cast<std::size_t>(row_from_above) * kSide + static_cast<std::size_t>(column)] = shade;
  };
  set(4000, 1000, '\0');
  set(4003, 1001, '\xfe');
  write("m.pgm", pgm);
  write("m.yaml", "image: m.pgm\nresolution: 0.05\norigin: [-10, 5, 0]\n");
  const auto read = read_map(folder_ / "m.yaml");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->notes.size(), 1U);
  EXPECT_LT(read->map.frame.size(), 5000U);
  const auto at = [&](double column, double row_from_above) {
    return read->map.at(read->map.frame.cell_at({-10 + 0.05 * column, 5 + 0.05 * (kSide - row_from_above)}));
  };
  EXPECT_EQ(at(4000.5, 1000.5), 100);
  EXPECT_EQ(at(4003.5, 1001.5), 0);
  EXPECT_EQ(at(4002.5, 1001.5), -1);
  EXPECT_EQ(at(100, 100), -1);
  std::vector<double> told;
  ASSERT_TRUE(read_map(folder_ / "m.yaml", [&](double done) { told.push_back(done); }));
  ASSERT_GT(told.size(), 20U) << "a person sees how far it is";
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_LT(told.front(), 0.01);
  EXPECT_GT(told.back(), 0.95);
  EXPECT_LE(told.back(), 1.0);
}

TEST_F(Maps, HeadersThatEndInMoreThanOneWhiteSpaceShiftNothing) {
  write("m.yaml", "image: m.pgm\nresolution: 0.5\norigin: [0, 0, 0]\n");
  const std::string pixels{'\0', '\xfe', '\xcd', '\xfe'};
  for (const std::string end : {"\n", " ", "\r\n", " \n", "\t\r\n", "\n\n"}) {
    write("m.pgm", "P5 2 2\n255" + end + pixels);
    const auto read = read_map(folder_ / "m.yaml");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->map.cells, (std::vector<std::int8_t>{-1, 0, 100, 0})) << end.size();
    EXPECT_TRUE(read->notes.empty());
  }
  write("m.pgm", "P5 2 2\n255\n\n\xfe\xfe\xfe\n");  // a dark pixel, and a line end behind the pixels
  const auto either = read_map(folder_ / "m.yaml");
  EXPECT_EQ(either->map.cells, (std::vector<std::int8_t>{0, 0, 100, 0}));
  EXPECT_EQ(either->notes.size(), 1U);
}

TEST_F(Maps, ACommentBehindTheHeaderIsNoPixels) {
  write("m.yaml", "image: m.pgm\nresolution: 0.5\norigin: [0, 0, 0]\n");
  const std::string pixels{'\0', '\xfe', '\xcd', '\xfe'};
  const std::vector<std::int8_t> right{-1, 0, 100, 0};
  for (const std::string end : {"# of a saver\n", "\n# of a saver\n", " # of a saver\n", "\n# two\n#\n"}) {
    write("m.pgm", "P5 2 2\n255" + end + pixels);
    const auto read = read_map(folder_ / "m.yaml");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->map.cells, right) << end;
    EXPECT_EQ(read->notes.size(), end.front() == '#' ? 0U : 1U) << end;
  }
  for (const std::string tail : {"", "\n", "more"}) {  // a shade of 35 is no comment
    write("m.pgm", "P5 2 2\n255\n#" + std::string{"\xfe\xfe\xfe"} + tail);
    EXPECT_EQ(read_map(folder_ / "m.yaml")->map.cells, (std::vector<std::int8_t>{0, 0, 100, 0})) << tail;
  }
}

TEST_F(Maps, NumbersThatCannotBeAreNamedAsTheyStand) {
  write("m.pgm", "P5\n4294967297 80\n255\n");
  const std::string plain = "image: m.pgm\nresolution: 1\norigin: [0, 0, ";
  EXPECT_EQ(fault_of(plain + "0]\n"), "m.pgm:2: PGM of 1000000000 x 80 pixels");
  write("m.pgm", "P5 1 1 255\n\xfe");
  for (const std::string degrees : {"90", "-180", "1e300"})
    EXPECT_EQ(fault_of(plain + degrees + "]\n"),
              "m.yaml:3: the origin's yaw is in radians, and " + degrees + " is more than a turn");
}

TEST_F(Maps, AnImageThatIsAPipeIsNotWaitedFor) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe.pgm").c_str(), 0600), 0);
  EXPECT_EQ(fault_of("image: pipe.pgm\nresolution: 1\norigin: [0, 0, 0]\n"),
            "pipe.pgm: cannot be read: it is a pipe or a device, and no file");
}

TEST_F(Maps, MorePixelsThanTheHeaderSaysAndShadesAboveItsWhiteAreSaid) {
  write("m.yaml", "image: m.pgm\nresolution: 0.5\norigin: [0, 0, 0]\n");
  write("m.pgm", "P2 2 1 255\n0 254\n7 7\n");
  const auto longer = read_map(folder_ / "m.yaml");
  ASSERT_TRUE(longer) << longer.error().message;
  ASSERT_EQ(longer->notes.size(), 1U);
  EXPECT_NE(longer->notes[0].find("more pixels"), std::string::npos);
  write("m.pgm", "P5 2 1 100\n\x32\x65");
  EXPECT_NE(read_map(folder_ / "m.yaml").error().message.find("101 where white is 100"), std::string::npos);
}

TEST_F(Maps, AKeyThatStandsTwiceIsRefusedAndNegateIsReadInAllWordsOfYaml) {
  write("m.pgm", "P5 2 1 255\n\xfe\xfe");
  const std::string plain = "image: m.pgm\nresolution: 0.5\norigin: [0, 0, 0]\n";
  EXPECT_EQ(fault_of(plain + "resolution: 0.1\n"), "m.yaml:4: key 'resolution' stands here twice");
  for (const std::string word : {"yes", "On", "TRUE", "1"}) {
    write("m.yaml", plain + "negate: " + word + "\n");
    EXPECT_EQ(read_map(folder_ / "m.yaml")->map.at({0, 0}), OccupancyGrid::kOccupied) << word;
  }
  for (const std::string word : {"no", "Off", "False", "0"}) {
    write("m.yaml", plain + "negate: " + word + "\n");
    EXPECT_EQ(read_map(folder_ / "m.yaml")->map.at({0, 0}), OccupancyGrid::kFree) << word;
  }
  EXPECT_NE(fault_of(plain + "negate: maybe\n"), "");
}

}  // namespace
}  // namespace docent
