#include "docent/simulator/pedestrians/recording.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "docent/base/files.h"

namespace docent::simulator::recording_test {
namespace {

constexpr const char* kObsmat =
    "   7.8000000e+02   1.0000000e+00   8.0e+00   0.0e+00   3.5e+00   1.6e+00   0.0e+00   1.7e-01\n"
    "   7.8600000e+02   1.0000000e+00   8.6e+00   0.0e+00   3.6e+00   1.6e+00   0.0e+00   3.2e-01   \r\n"
    "   7.8600000e+02   2.0000000e+00   1.0e+00   0.0e+00   2.0e+00   0.0e+00   0.0e+00   0.0e+00\n"
    "   7.9200000e+02   1.0000000e+00   9.2e+00   0.0e+00   3.7e+00   1.6e+00   0.0e+00   3.7e-01\n"
    "   7.9200000e+02   2.0000000e+00   1.2e+00   0.0e+00   2.0e+00   0.0e+00   0.0e+00   0.0e+00\n";

std::string fault_of(const std::string& text) {
  const auto recording = parse_recording(text, "people.txt");
  return recording ? "no fault" : recording.error().message;
}

TEST(Recording, ReadsFrameSixAsFourTenthsOfASecondInObsmat) {
  const auto recording = parse_recording(kObsmat, "obsmat.txt");
  ASSERT_TRUE(recording) << recording.error().message;
  ASSERT_EQ(recording->tracks.size(), 2U);
  EXPECT_EQ(recording->tracks[0].points, (std::vector<Point2>{{8.0, 3.5}, {8.6, 3.6}, {9.2, 3.7}}));
  EXPECT_DOUBLE_EQ(recording->tracks[0].start, 0.0);
  EXPECT_NEAR(recording->tracks[1].start, 0.4, 1e-9);
  EXPECT_NEAR(recording->duration, 1.2, 1e-9);
  EXPECT_NEAR(recording->mean_people(), (0.8 + 0.4) / 1.2, 1e-9);
}

TEST(Recording, ReadsFourColumnsWithAnotherStep) {
  const auto recording = parse_recording("0.0\t1.0\t1.0\t2.0\n10.0\t1.0\t1.4\t2.0\n20.0\t1.0\t1.8\t2.0\n", "s.txt");
  ASSERT_TRUE(recording) << recording.error().message;
  EXPECT_EQ(recording->tracks.at(0).points.size(), 3U);
  EXPECT_NEAR(recording->tracks[0].end(), 0.8, 1e-9);
}

TEST(Recording, ReadsPixelsOfEdinburghAndSkipsItsProperties) {
  const auto recording = parse_recording(
      "% tracks\nProperties.R1=[53 4471 ];\n TRACK.R1=[[100 10 90];[110 10 99];[999 9 99];[120 10 108]];\n", "e.txt");
  ASSERT_TRUE(recording) << recording.error().message;
  const Track& track = recording->tracks.at(0);
  EXPECT_NEAR(distance(track.points.front(), {2.47, -0.247}), 0.0, 1e-9);
  EXPECT_NEAR(track.points[1].x - track.points[0].x, 0.247 * 0.4, 1e-9);  // 10 pixels a second
  EXPECT_NEAR(track.points.back().y, -0.247, 1e-9);
}

TEST(Recording, ATrackWithoutSightingsIsNobody) {
  EXPECT_EQ(fault_of("TRACK.acks\n"), "people.txt: nobody was seen twice");
  const auto recording = parse_recording("TRACK.R1=[[1 2 9];[1 2 18]];\nTRACK.acks\n", "e.txt");
  ASSERT_TRUE(recording) << recording.error().message;
  EXPECT_EQ(recording->tracks.size(), 1U);
}

TEST(Recording, BridgesShortGapsAndCutsAtLongOnes) {
  const auto recording =
      parse_recording("0 1 0 0\n10 1 1 0\n30 1 3 0\n40 1 4 0\n200 1 9 0\n210 1 9.5 0\n900 1 0 0\n", "gaps.txt");
  ASSERT_TRUE(recording) << recording.error().message;
  ASSERT_EQ(recording->tracks.size(), 2U);  // the last sighting is alone
  ASSERT_EQ(recording->tracks[0].points.size(), 5U);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(recording->tracks[0].at(0.4 * i).x, i, 1e-9);
  EXPECT_NEAR(recording->tracks[1].start, 8.0, 1e-9);
}

TEST(Recording, NonsenseIsAFaultWithFileAndLine) {
  EXPECT_EQ(fault_of("0 1 2 3\n\n# fine\n10 1 two 3\n"), "people.txt:4: 'two' where a number should be");
  EXPECT_EQ(fault_of("0 1 2 3\n10 1 nan 3\n"), "people.txt:2: 'nan' where a number should be");
  EXPECT_EQ(fault_of("0 1 2\n"), "people.txt:1: expected 4 columns (frame, person, x, y) or the 8 of obsmat, not 3");
  EXPECT_EQ(fault_of("0 1 2 3\n10 1 0 0 0 0 0 0\n"), "people.txt:2: the lines before have 4 columns, this one 8");
  EXPECT_EQ(fault_of("0 1 2 3\n0 1 2 4\n"), "people.txt:2: person 1 is in two places at frame 0");
  EXPECT_EQ(fault_of("0 1.5 2 3\n"), "people.txt:1: a person is a whole number");
  EXPECT_EQ(fault_of("0.5 1 2 3\n"), "people.txt:1: a frame is a whole number of 0 to 10000000");
  EXPECT_EQ(fault_of("0 1 20000 3\n"), "people.txt:1: a person is more than 1000 m away");
  EXPECT_EQ(fault_of("0 1 10 3\n10 1 90 3\n"), "people.txt: people walk at 200 m/s: these are no metres");
  EXPECT_EQ(fault_of(""), "people.txt: nobody was seen twice");
  EXPECT_EQ(fault_of("0 1 2 3\n0 2 2 3\n"), "people.txt: nobody was seen twice");
  EXPECT_EQ(fault_of("x\nTRACK.R1=[[1 2 3];[1 2]];\n"), "people.txt:2: expected [x y frame] again and again");
}

TEST(Recording, AFolderHoldsObsmatOrOneText) {
  std::string name = (std::filesystem::temp_directory_path() / "docent-people-XXXXXX").string();
  ASSERT_NE(mkdtemp(name.data()), nullptr);
  const std::filesystem::path folder = std::filesystem::path{name} / "Hall 1";
  std::filesystem::create_directories(folder);
  EXPECT_FALSE(load_recording(folder));
  ASSERT_TRUE(write_file_atomically(folder / "info.txt", "for people"));
  ASSERT_TRUE(write_file_atomically(folder / "more.txt", "for people"));
  EXPECT_NE(load_recording(folder).error().message.find("holds neither obsmat.txt"), std::string::npos);
  ASSERT_TRUE(write_file_atomically(folder / "obsmat.txt", kObsmat));
  const auto recording = load_recording(folder);
  ASSERT_TRUE(recording) << recording.error().message;
  EXPECT_EQ(recording->name, "hall-1");
  EXPECT_EQ(load_recording(folder / "obsmat.txt")->name, "obsmat");
  std::filesystem::remove_all(name);
}

}  // namespace
}  // namespace docent::simulator::recording_test
