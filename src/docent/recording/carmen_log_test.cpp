#include "docent/recording/carmen_log.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <numbers>

#include "docent/base/files.h"

namespace docent::recording {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A line with `beams` equal readings; pose and odometry equal.
std::string scan_line(int beams, const std::string& reading, const std::string& time,
                      const std::string& kind = "FLASER", const std::string& poses = "0 0 0 0 0 0") {
  std::string line = kind + " " + std::to_string(beams);
  for (int i = 0; i < beams; ++i) line += " " + reading;
  return line + " " + poses + " " + time + " host " + time + "\n";
}

TEST(CarmenLog, BearingsFollowTheNumberOfBeams) {
  const auto log = parse_carmen_log(
      scan_line(180, "1", "1") + scan_line(181, "1", "2") + scan_line(360, "1", "3") + scan_line(361, "1", "4"), "log");
  ASSERT_TRUE(log) << log.error().message;
  const double last[] = {89.0, 90.0, 89.5, 90.0};
  const double step[] = {1.0, 1.0, 0.5, 0.5};
  for (std::size_t i = 0; i < 4; ++i) {
    const LoggedScan& scan = log->scans[i];
    EXPECT_NEAR(scan.first_bearing.degrees(), -90.0, 1e-9);
    EXPECT_NEAR(scan.bearing_step, step[i] * kDegree, 1e-12);
    EXPECT_NEAR(scan.bearing(scan.ranges.size() - 1).degrees(), last[i], 1e-9);
  }
}

/// A drive along x at 0.5 m/s, scans at 5 Hz, odometry in between; `stamp` is what the file says of the true time,
/// `raw` what odometry says of the true x.
std::string drive_of(const std::function<double(double)>& stamp, const std::function<double(double)>& raw) {
  std::string text;
  for (int i = 0; i < 100; ++i) {
    const double time = 0.1 * i;
    const std::string x = std::to_string(raw(0.5 * time));
    const std::string at = std::to_string(100.0 + stamp(time));
    if (i % 2 == 0) {
      text += scan_line(180, "1", at, "FLASER", x + " 0 0 " + x + " 0 0");
    } else {
      text += "ODOM " + x + " 0 0 0.5 0 0 " + at + " host " + at + "\n";
    }
  }
  return text;
}

TEST(CarmenLog, WheelsThatBeginAnewAreOneJump) {
  const auto log = parse_carmen_log(
      drive_of([](double time) { return time; }, [](double x) { return x < 2.5 ? 7.0 + x : x - 2.5; }), "log");
  ASSERT_TRUE(log) << log.error().message;
  ASSERT_EQ(log->notes.size(), 1U);
  EXPECT_NE(log->notes.front().find("the odometry jumped once, 5 s"), std::string::npos) << log->notes.front();
  for (const LoggedScan& scan : log->scans)
    EXPECT_NEAR(scan.odom_from_base.x, 7.0 + 0.5 * (to_seconds(scan.time) - 100.0), 0.06);
  for (const LoggedOdometry& reading : log->odometry)
    EXPECT_NEAR(reading.odom_from_base.x, 7.0 + 0.5 * (to_seconds(reading.time) - 100.0), 0.06);
  EXPECT_NEAR(log->scans.back().logged_pose.x, 2.4, 0.01) << "as it stands in the file";
}

TEST(CarmenLog, LateAndDoubledStampsAreNoJumps) {
  const auto as_it_is = [](double x) { return x; };
  for (const double back : {0.05, 0.3, 2.0, 500.0}) {
    // One is late, and one is a double.
    auto text = drive_of([&](double time) { return time > 4.05 && time < 4.15 ? time - back : time; }, as_it_is);
    const std::size_t line = text.find("FLASER", text.size() / 2);
    const std::string twice = text.substr(line, text.find('\n', line) + 1 - line);
    text.insert(line, twice);
    const auto log = parse_carmen_log(text, "log");
    ASSERT_TRUE(log) << log.error().message;
    for (const std::string& note : log->notes) EXPECT_EQ(note.find("jumped"), std::string::npos) << note;
    for (const LoggedScan& scan : log->scans)
      EXPECT_NEAR(scan.odom_from_base.x, scan.logged_pose.x, 1e-9) << "no motion is left out";
  }
}

TEST(CarmenLog, AClockThatWasSetBackGoesOn) {
  const auto log = parse_carmen_log(
      drive_of([](double time) { return time < 5.0 ? time : time - 60.0; }, [](double x) { return x; }), "log");
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_GT(to_seconds(log->scans.back().time), 109.0);
  for (const LoggedScan& scan : log->scans) EXPECT_NEAR(scan.odom_from_base.x, scan.logged_pose.x, 1e-9);
  const auto is_said = [](const std::string& note) { return note.find("set back") != std::string::npos; };
  EXPECT_TRUE(std::any_of(log->notes.begin(), log->notes.end(), is_said));
}

TEST(CarmenLog, ANarrowScannerSaysItsResolution) {
  const auto log =
      parse_carmen_log("PARAM laser_front_laser_resolution 0.25 host 0\n" + scan_line(401, "1", "1"), "log");
  ASSERT_TRUE(log);
  EXPECT_NEAR(log->scans[0].first_bearing.degrees(), -50.0, 1e-9);
  EXPECT_NEAR(log->scans[0].bearing(400).degrees(), 50.0, 1e-9);
}

TEST(CarmenLog, CodesAreNoDistances) {
  std::string text;
  for (int i = 0; i < 10; ++i) text += "FLASER 5 81.83 81.91 12.5 0 nan 0 0 0 0 0 0 " + std::to_string(i) + " host 0\n";
  const auto log = parse_carmen_log(text, "log");
  ASSERT_TRUE(log);
  const auto& ranges = log->scans[3].ranges;
  EXPECT_TRUE(std::isinf(ranges[0]));
  EXPECT_TRUE(std::isinf(ranges[1]));
  EXPECT_FLOAT_EQ(ranges[2], 12.5F);
  EXPECT_TRUE(std::isnan(ranges[3]));
  EXPECT_TRUE(std::isnan(ranges[4]));
}

TEST(CarmenLog, APeakAtTheGreatestReadingIsNoReturnAndALoneOneIsAWall) {
  std::string peak;
  std::string lone;
  for (int i = 0; i < 30; ++i) {
    peak += "FLASER 3 8.191 8.183 3 0 0 0 0 0 0 " + std::to_string(i) + " host 0\n";
    lone += "FLASER 100 " + std::string{i == 7 ? "9" : "2"};
    for (int k = 0; k < 99; ++k) lone += " 3." + std::to_string(k);
    lone += " 0 0 0 0 0 0 " + std::to_string(i) + " host 0\n";
  }
  const auto with_peak = parse_carmen_log(peak, "log");
  const auto without = parse_carmen_log(lone, "log");
  ASSERT_TRUE(with_peak && without);
  EXPECT_TRUE(std::isinf(with_peak->scans[0].ranges[1]));
  EXPECT_NEAR(with_peak->max_range, 8.15, 0.01);
  EXPECT_FLOAT_EQ(without->scans[7].ranges[0], 9.0F);
}

TEST(CarmenLog, PlaceOfTheLaserComesFromThePoses) {
  std::string text;
  for (int i = 0; i < 20; ++i) {
    const Pose2 odom{0.3 * i, -0.1 * i, Angle::radians(0.3 * i)};
    const Pose2 laser = odom * Pose2{0.25, 0.0, Angle{}};
    const Pose2 rear = odom * Pose2{-0.2, 0.0, Angle::degrees(180)};
    const auto pose = [](const Pose2& p) {
      return std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.theta.radians());
    };
    text += scan_line(180, "2", std::to_string(i), "FLASER", pose(laser) + " " + pose(odom));
    text += scan_line(180, "2", std::to_string(i), "RLASER", pose(rear) + " " + pose(odom));
  }
  const auto log = parse_carmen_log(text, "log");
  ASSERT_TRUE(log);
  ASSERT_EQ(log->scans.size(), 40U);
  EXPECT_NEAR(log->scans[6].base_from_laser.x, 0.25, 1e-5);
  EXPECT_NEAR(log->scans[6].base_from_laser.theta.radians(), 0.0, 1e-5);
  EXPECT_TRUE(log->scans[7].rear);
  EXPECT_NEAR(log->scans[7].base_from_laser.x, -0.2, 1e-5);
  EXPECT_NEAR(std::abs(log->scans[7].base_from_laser.theta.degrees()), 180.0, 1e-3);
  EXPECT_NEAR(log->scans[7].odom_from_base.x, 0.9, 1e-6);
}

TEST(CarmenLog, CorrectedPosesAreNotTakenForThePlaceOfTheLaser) {
  std::string text = "PARAM robot_frontlaser_offset 0.31 host 0\n";
  for (int i = 0; i < 20; ++i)
    text +=
        scan_line(180, "2", std::to_string(i), "FLASER",
                  std::to_string(0.5 * i) + " 0 0 " + std::to_string(0.4 * i) + " " + std::to_string(0.1 * i) + " 0.1");
  const auto log = parse_carmen_log(text, "log");
  ASSERT_TRUE(log);
  EXPECT_NEAR(log->scans[5].base_from_laser.x, 0.31, 1e-9);
  ASSERT_FALSE(log->notes.empty());
  EXPECT_NE(log->notes[0].find("corrected"), std::string::npos);
}

TEST(CarmenLog, TimesThatStandStillAreReplaced) {
  const std::string odometry = "ODOM 0 0 0 0 0 0 0 host 0\n";
  const auto zero = parse_carmen_log(
      scan_line(5, "1", "0") + odometry + odometry + scan_line(5, "1", "0") + scan_line(5, "1", "0"), "log");
  ASSERT_TRUE(zero);
  EXPECT_TRUE(zero->times_are_invented);
  EXPECT_NEAR(to_seconds(zero->scans[2].time - zero->scans[1].time), 0.2, 1e-9);
  EXPECT_LT(zero->scans[0].time, zero->odometry[0].time);
  EXPECT_LT(zero->odometry[0].time, zero->odometry[1].time);
  EXPECT_LT(zero->odometry[1].time, zero->scans[1].time);

  const auto logger =
      parse_carmen_log("FLASER 1 2 0 0 0 0 0 0 7 host 1.5\nFLASER 1 2 0 0 0 0 0 0 7 host 1.75\n", "log");
  ASSERT_TRUE(logger);
  EXPECT_FALSE(logger->times_are_invented);
  EXPECT_NEAR(to_seconds(logger->scans[1].time), 1.75, 1e-9);

  const auto falling =
      parse_carmen_log(scan_line(1, "1", "5") + scan_line(1, "1", "4") + scan_line(1, "1", "6"), "log");
  ASSERT_TRUE(falling);
  EXPECT_EQ(falling->scans[1].time, falling->scans[0].time);
  EXPECT_NEAR(to_seconds(falling->scans[2].time), 6.0, 1e-9);
}

TEST(CarmenLog, ReadsTheNewerLaserLines) {
  const auto log = parse_carmen_log(
      "ROBOTLASER1 0 -1.570796 3.141593 0.785398 20 0.01 0 5 1 2 20 4 5 2 7 7 1.1 2 0.5 1 2 0.5 0.3 0.1 0.5 0.4 1000 "
      "12.5 host 0.1\n",
      "log");
  ASSERT_TRUE(log) << log.error().message;
  const LoggedScan& scan = log->scans[0];
  ASSERT_EQ(scan.ranges.size(), 5U);
  EXPECT_TRUE(std::isinf(scan.ranges[2]));
  EXPECT_FLOAT_EQ(scan.ranges[4], 5.0F);
  EXPECT_NEAR(scan.bearing(4).degrees(), 90.0, 1e-3);
  EXPECT_NEAR(scan.odom_from_base.y, 2.0, 1e-12);
  EXPECT_NEAR(to_seconds(scan.time), 12.5, 1e-9);
}

TEST(CarmenLog, FaultsNameFileAndLine) {
  const std::string good = scan_line(3, "1", "1");
  const std::pair<std::string, std::string> cases[] = {
      {good + "FLASER 3 1 2\n", "log:2: "},
      {good + "\n# x\nFLASER 3 1 2 three 0 0 0 0 0 0 1 host 1\n", "log:4: 'three'"},
      {"FLASER -1 0 0 0 0 0 0 1 host 1\n", "log:1: "},
      {"FLASER 1000000000 0 0 0 0 0 0 1 host 1\n", "log:1: "},
      {"FLASER 1 2.0 1e11 0 0 0 0 0 1 host 1\n", "log:1: the laser's pose lies nowhere on Earth"},
      {"ROBOTLASER1 0 -1.5 3 0.9 30 0.1 0 20 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 0 0 0 0 0 0 0 0 0 0 0 0 1 host "
       "1\n",
       "log:1: the beams go more than once round"},
      {"FLASER 0 0 0 0 0 0 0 1 host 1\n", "log:1: "},
      {"FLASER 1 1 0 nan 0 0 0 0 1 host 1\n", "log:1: "},
      {good + "ODOM 0 0\n", "log:2: "},
      {good + "PARAM\n", "log:2: "},
      {"hello\n", "log: holds no"},
      {"", "log: holds no"},
      {"ROBOTLASER1 0 99 3 0.1 20 0 0 1 1 0 0 0 0 0 0 0 0 0 0 0 0 1 host 1\n", "log:1: "},
  };
  for (const auto& [text, start] : cases) {
    const auto log = parse_carmen_log(text, "log");
    ASSERT_FALSE(log) << text;
    EXPECT_EQ(log.error().message.rfind(start, 0), 0U) << log.error().message;
    EXPECT_EQ(log.error().message.find('\n'), std::string::npos);
  }
  EXPECT_FALSE(read_carmen_log("/nowhere/at.all"));
}

TEST(CarmenLog, AWrongLineInFiftyIsLeftOutAndNamed) {
  std::string good;
  for (int i = 0; i < 50; ++i) good += scan_line(5, "1.5", std::to_string(100.5 + i));
  for (const auto& [line, why] : std::vector<std::pair<std::string, std::string>>{
           {"FLASER 5 1 1 1 1 1 0.5 nan 0 0.5 0 0 160.5 host 160.5\n", "line 51: the laser's pose is out of range"},
           {"FLASER 5 1 1 1 1 1 0.5 0 0 0.5 inf 0 160.5 host 160.5\n", "line 51: the odometry is out of range"},
           {"ODOM nan 0 0 0 0 0 160.5 host 160.5\n", "line 51: the odometry is out of range"},
           {"FLASER 5 1 1 1 1 0.5 0 0 0.5 0 0 160.5 host 160.5\n", "line 51: 'host' where the time should be"},
           {"FLASER 5 1 1 1 1 1 1 0.5 0 0 0.5 0 0.25 160.5 host 160.5\n", "is the number of readings wrong?"},
           {"FLASER 5 1 1 1 1 1 1 0.5 0 0 0.5 0 0.25 160.5\n", "is the number of readings wrong?"},
           {"FLASER 5 1 1 1 1 1 1 1 0.5 0 0 0.5 0 0.25 160.5\n", "is the number of readings wrong?"},
           {"FLASER 4 1 1 1 1 1 1 1 0.5 0 0 0.5 0 0.25 160.5 host 160.5\n", "is the number of readings wrong?"}}) {
    const auto log = parse_carmen_log(good + line, "log");
    ASSERT_TRUE(log) << log.error().message;
    EXPECT_EQ(log->scans.size(), 50U) << line;
    EXPECT_TRUE(log->odometry.empty());
    ASSERT_EQ(log->notes.size(), 1U) << line;
    EXPECT_NE(log->notes[0].find("1 line was left out; line 51: "), std::string::npos) << log->notes[0];
    EXPECT_NE(log->notes[0].find(why), std::string::npos) << log->notes[0];
    std::string many = good;
    for (int i = 0; i < 6; ++i) many += line;
    const auto refused = parse_carmen_log(many, "log");
    ASSERT_FALSE(refused) << "one line in ten is too many";
    EXPECT_EQ(refused.error().message.rfind("log:51: ", 0), 0U) << refused.error().message;
  }
}

TEST(CarmenLog, OfAGzipFileThatIsCutWhatCameBeforeIsRead) {
  const auto path = std::filesystem::path{::testing::TempDir()} / "docent_carmen_cut.log.gz";
  std::string text;
  for (int i = 0; i < 2000; ++i) text += scan_line(20, std::to_string(1.0 + 0.001 * (i * 37 % 991)), std::to_string(i));
  const gzFile file = gzopen(path.c_str(), "wb");
  ASSERT_EQ(gzwrite(file, text.data(), static_cast<unsigned>(text.size())), static_cast<int>(text.size()));
  gzclose(file);
  const auto whole = read_carmen_log(path);
  ASSERT_TRUE(whole) << whole.error().message;
  EXPECT_EQ(whole->scans.size(), 2000U);
  const std::string bytes = *read_file(path);
  ASSERT_TRUE(write_file_atomically(path, bytes.substr(0, 6 * bytes.size() / 10)));
  const auto cut = read_carmen_log(path);
  ASSERT_TRUE(cut) << cut.error().message;
  EXPECT_GT(cut->scans.size(), 1000U);
  EXPECT_LT(cut->scans.size(), 1400U);
  EXPECT_NEAR(to_seconds(cut->scans.back().time), static_cast<double>(cut->scans.size()) - 1.0, 1e-6);
  EXPECT_NE(cut->notes.front().find("the gzip stream ends early: what came before is used"), std::string::npos)
      << cut->notes.front();
  // Damaged on the way: the stream shows it, or its lines do.
  std::string damaged = bytes;
  for (std::size_t i = bytes.size() / 2; i < bytes.size() / 2 + 40; ++i) damaged[i] = static_cast<char>(~damaged[i]);
  ASSERT_TRUE(write_file_atomically(path, damaged));
  const auto read = read_carmen_log(path);
  if (read) {
    EXPECT_FALSE(read->notes.empty());
  }
  ASSERT_TRUE(write_file_atomically(path, bytes.substr(0, 30)));
  const auto nothing = read_carmen_log(path);
  ASSERT_FALSE(nothing);
  EXPECT_NE(nothing.error().message.find("ends early"), std::string::npos) << nothing.error().message;
  std::filesystem::remove(path);
}

TEST(CarmenLog, ATornLastLineIsLeftOut) {
  const auto log = parse_carmen_log(scan_line(3, "1", "1") + "FLASER 3 1 1", "log");
  ASSERT_TRUE(log);
  EXPECT_EQ(log->scans.size(), 1U);
  EXPECT_EQ(log->notes.size(), 1U);
}

TEST(CarmenLog, ReadsRealLogs) {
  const char* variable = std::getenv("DOCENT_DATA");
  const std::filesystem::path logs = std::filesystem::path{variable != nullptr ? variable : "../shared/data"} / "logs";
  if (!std::filesystem::exists(logs)) GTEST_SKIP() << "skipped: no recorded data";
  struct Case {
    const char* file;
    std::size_t scans, beams;
    double mount_x, path_m;
    bool invented;
  };
  const Case cases[] = {
      {"wean-1.clf.gz", 713, 180, 0.25, 41, false},         {"wean-2.clf.gz", 2251, 180, 0.25, 87, false},
      {"sena-loop.clf.gz", 225, 361, 0.78, 76, false},      {"duke-loop5.clf.gz", 551, 181, 0.0, 56, false},
      {"orebro-corrected.log.gz", 237, 181, 0.0, -1, true}, {"belgioioso-corrected.log.gz", 395, 361, 0.0, -1, true},
      {"intel-raw.clf.gz", 2726, 180, 0.0, 506, false}};
  for (const Case& c : cases) {
    const auto log = read_carmen_log(logs / c.file);
    ASSERT_TRUE(log) << log.error().message;
    EXPECT_EQ(log->scans.size(), c.scans) << c.file;
    EXPECT_EQ(log->scans[0].ranges.size(), c.beams) << c.file;
    EXPECT_NEAR(log->scans[0].base_from_laser.x, c.mount_x, 0.005) << c.file;
    EXPECT_NEAR(log->scans[0].base_from_laser.y, 0.0, 0.005) << c.file;
    EXPECT_EQ(log->times_are_invented, c.invented) << c.file;
    double path = 0.0;
    for (std::size_t i = 1; i < log->scans.size(); ++i) {
      path += distance(log->scans[i - 1].odom_from_base.position(), log->scans[i].odom_from_base.position());
      EXPECT_LE(log->scans[i - 1].time, log->scans[i].time);
    }
    if (c.path_m > 0) {
      EXPECT_NEAR(path, c.path_m, 2.0) << c.file;
    }
    for (const LoggedScan& scan : log->scans)
      for (const float range : scan.ranges) EXPECT_FALSE(std::isfinite(range) && range > 80.0F);
  }
}

/// One scan a second; `time` sets the message's clock [s].
Result<LaserLog> log_by(const std::function<double(int)>& time) {
  const auto path = std::filesystem::path{::testing::TempDir()} / "docent_carmen_clock.log";
  std::string text;
  for (int i = 0; i < 60; ++i)
    text += "FLASER 3 1 2 3 0 0 0 0 0 0 " + std::to_string(time(i)) + " host " + std::to_string(i) + "\n";
  EXPECT_TRUE(write_file_atomically(path, text));
  auto log = read_carmen_log(path);
  std::filesystem::remove(path);
  return log;
}

TEST(CarmenLogClocks, AnOddTimeIsANoteAndNoRefusal) {
  const auto lone = log_by([](int i) { return i == 30 ? 1e11 : 1000.0 + i; });
  ASSERT_TRUE(lone) << lone.error().message;
  EXPECT_EQ(lone->scans.size(), 60U);
  EXPECT_NEAR(to_seconds(lone->scans[59].time - lone->scans[0].time), 59.0, 1e-6);
  EXPECT_FALSE(lone->times_are_invented);
  ASSERT_FALSE(lone->notes.empty());
  const auto set = log_by([](int i) { return i < 10 ? 5.0 + i : 1e9 + i; });
  ASSERT_TRUE(set) << set.error().message;
  for (int i = 0; i < 60; ++i) EXPECT_NEAR(to_seconds(set->scans[static_cast<std::size_t>(i)].time), 1e9 + i, 1e-3);
  const auto stands = log_by([](int i) { return i >= 20 && i < 40 ? 1020.0 : 1000.0 + i; });
  ASSERT_TRUE(stands);
  EXPECT_NEAR(to_seconds(stands->scans[30].time), 1030.0, 1e-3);
}

}  // namespace
}  // namespace docent::recording
