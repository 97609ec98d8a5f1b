#include "docent/simulator/pedestrians/tracks_file.h"

#include <gtest/gtest.h>

namespace docent::simulator::tracks_file_test {
namespace {

std::string fault_of(const std::string& text) {
  const auto tracks = parse_tracks(text, "p.txt");
  return tracks ? "no fault" : tracks.error().message;
}

TEST(Track, IsOnTheLineBetweenTwoPoints) {
  const Track track{2.0, {{0.0, 0.0}, {0.4, 0.8}, {0.4, 0.0}}};
  EXPECT_EQ(track.at(0.0), (Point2{0.0, 0.0}));
  EXPECT_NEAR(distance(track.at(2.1), {0.1, 0.2}), 0.0, 1e-9);
  EXPECT_NEAR(distance(track.at(2.6), {0.4, 0.4}), 0.0, 1e-9);
  EXPECT_EQ(track.at(99.0), (Point2{0.4, 0.0}));
  EXPECT_NEAR(track.end(), 2.8, 1e-12);
}

TEST(TracksFile, IsReadBackAsItWas) {
  const std::vector<Recording> recordings{
      {"eth", 100.0, {{1.2, {{1.0, 2.0}, {1.5, 2.25}}}, {3.0, {{0, 0}, {0, 1}, {0, 2}}}}}, {"students01", 20.4, {}}};
  const auto read = parse_tracks(to_text(recordings), "p.txt");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->size(), 2U);
  EXPECT_EQ(to_text(*read), to_text(recordings));
  EXPECT_EQ(read->at(0).tracks.at(1).points, recordings[0].tracks[1].points);
  EXPECT_DOUBLE_EQ(read->at(1).duration, 20.4);
}

TEST(TracksFile, NonsenseIsAFaultWithFileAndLine) {
  const std::string header = "# people\nrecording eth 10\n";
  EXPECT_EQ(fault_of(header), "no fault");
  EXPECT_EQ(fault_of("track 0 1 2 3 4\n"),
            "p.txt:1: expected 'recording NAME DURATION', then lines 'track START x y x y …'");
  EXPECT_EQ(fault_of("recording ETH 10\n"), "p.txt:1: a recording's name is of small letters, digits, '-' and '_'");
  EXPECT_EQ(fault_of("recording eth 0\n"), "p.txt:1: expected 'recording NAME DURATION' with a duration > 0 [s]");
  EXPECT_EQ(fault_of(header + "track 0 1 2 3\n"), "p.txt:3: expected 'track START x y x y …', two points or more");
  EXPECT_EQ(fault_of(header + "track 0 1 2 inf 4\n"), "p.txt:3: 'inf' where a number should be");
  EXPECT_EQ(fault_of(header + "track 9.8 1 2 3 4\n"),
            "p.txt:3: the track does not lie within its recording's duration");
  EXPECT_EQ(fault_of(header + "track 0 1 2 99999 4\n"), "p.txt:3: too far away");
}

}  // namespace
}  // namespace docent::simulator::tracks_file_test
