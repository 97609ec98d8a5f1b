#include "docent/recording/laser_log.h"

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "docent/base/files.h"
#include "docent/messages/conversions.h"
#include "docent/recording/recorder.h"

namespace docent::recording {
namespace {

constexpr double kPi = 3.14159265358979323846;

class LaserLogFolder : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("docent_laser_log_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

/// A message as a recording holds it.
struct Raw {
  std::string topic, type;
  Time time;
  std::vector<std::uint8_t> data;
};
template <class T>
Raw raw(const std::string& topic, Time time, const T& message) {
  return {topic, T::kType, time, encode_cdr(message)};
}

geometry_msgs::TransformStamped link(const std::string& parent, const std::string& child, double x, double y,
                                     const geometry_msgs::Quaternion& rotation) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  transform.transform.translation = {x, y, 0.3};
  transform.transform.rotation = rotation;
  return transform;
}

/// Ten seconds on a straight way at 0.5 m/s: odometry at 10 Hz, two lasers at 4 Hz, one of them upside down and behind.
std::vector<Raw> drive() {
  std::vector<Raw> messages;
  tf2_msgs::TFMessage places;
  places.transforms = {link("base_link", "mast", 0.1, 0.0, to_quaternion(Angle::degrees(90))),
                       link("mast", "front", 0.0, -0.2, to_quaternion(Angle::degrees(-90))),
                       link("base_link", "rear", -0.3, 0.0, {0.0, 1.0, 0.0, 0.0})};  // half a turn about y
  messages.push_back(raw("/tf_static", Time{0}, places));
  for (int i = 0; i <= 100; ++i) {
    const Time time = time_from_seconds(100.0 + 0.1 * i);
    nav_msgs::Odometry odometry;
    odometry.header.stamp = to_message(time);
    odometry.child_frame_id = "base_link";
    odometry.pose.pose = to_message(Pose2{0.05 * i, 0.0, Angle{}});
    messages.push_back(raw("/odom", time, odometry));
    if (i % 2 == 0) continue;
    for (const char* frame : {"front", "rear"}) {
      sensor_msgs::LaserScan scan;
      scan.header = {to_message(time - std::chrono::milliseconds{50}), frame};
      scan.angle_min = -1.0F;
      scan.angle_increment = 0.5F;
      scan.range_min = 0.1F;
      scan.range_max = 10.0F;
      scan.ranges = {1.0F, 10.0F, std::nanf(""), 0.0F, 9.9F};
      messages.push_back(raw(std::string{"/scan_"} + frame, time, scan));
    }
  }
  sensor_msgs::LaserScan invented;
  invented.ranges = {1.0F};
  messages.push_back(raw("/docent/virtual_scan", time_from_seconds(105), invented));
  return messages;
}

void write_mcap(const std::filesystem::path& path, const std::vector<Raw>& messages) {
  auto writer = McapWriter::create(path);
  std::map<std::string, McapWriter::Channel> channels;
  for (const Raw& message : messages) {
    if (!channels.contains(message.topic))
      channels[message.topic] = *writer->add_channel({message.topic, message.type, "ros2msg", "x", "cdr", {}});
    ASSERT_TRUE(writer->write(channels[message.topic], message.time, message.time, message.data));
  }
  ASSERT_TRUE(writer->close());
}

void write_database(const std::filesystem::path& path, const std::vector<Raw>& messages) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  ASSERT_EQ(
      sqlite3_exec(database,
                   "BEGIN; CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT);"
                   "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB);",
                   nullptr, nullptr, nullptr),
      SQLITE_OK);
  std::map<std::string, int> topics;
  for (const Raw& message : messages) {
    const auto [place, is_new] = topics.try_emplace(message.topic, static_cast<int>(topics.size()) + 1);
    if (is_new) {
      const std::string insert = "INSERT INTO topics VALUES(" + std::to_string(place->second) + ", '" + message.topic +
                                 "', '" + message.type + "')";
      ASSERT_EQ(sqlite3_exec(database, insert.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
    }
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(database, "INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)", -1, &statement,
                       nullptr);
    sqlite3_bind_int(statement, 1, place->second);
    sqlite3_bind_int64(statement, 2, message.time.nanoseconds);
    sqlite3_bind_blob(statement, 3, message.data.data(), static_cast<int>(message.data.size()), SQLITE_TRANSIENT);
    ASSERT_EQ(sqlite3_step(statement), SQLITE_DONE);
    sqlite3_finalize(statement);
  }
  ASSERT_EQ(sqlite3_exec(database, "COMMIT", nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(database);
}

void expect_drive(const Result<LaserLog>& log) {
  ASSERT_TRUE(log) << log.error().message;
  ASSERT_EQ(log->scans.size(), 100U);
  EXPECT_EQ(log->odometry.size(), 101U);
  EXPECT_TRUE(log->notes.empty()) << log->notes.front();
  EXPECT_NEAR(log->max_range, 10.0, 1e-6);
  for (const LoggedScan& scan : log->scans) {
    EXPECT_NEAR(scan.odom_from_base.x, 0.5 * (to_seconds(scan.time) - 100.0), 1e-6);
    EXPECT_FLOAT_EQ(scan.ranges[0], 1.0F);
    EXPECT_TRUE(std::isinf(scan.ranges[1]));
    EXPECT_TRUE(std::isnan(scan.ranges[2]));
    EXPECT_TRUE(std::isnan(scan.ranges[3]));
    EXPECT_NEAR(scan.base_from_laser.x, scan.rear ? -0.3 : 0.3, 1e-9);
    EXPECT_NEAR(scan.base_from_laser.y, 0.0, 1e-9);
    EXPECT_NEAR(std::abs(scan.base_from_laser.theta.radians()), scan.rear ? kPi : 0.0, 1e-9);
    // Upside down the first beam lies to the other side.
    EXPECT_NEAR(scan.bearing(0).radians(), scan.rear ? 1.0 : -1.0, 1e-6);
    EXPECT_NEAR(scan.bearing(4).radians(), scan.rear ? -1.0 : 1.0, 1e-6);
  }
}

TEST_F(LaserLogFolder, ReadsRos2RecordingsOfEitherKind) {
  write_mcap(folder_ / "drive.mcap", drive());
  write_database(folder_ / "drive.db3", drive());
  expect_drive(read_laser_log(folder_ / "drive.mcap"));
  expect_drive(read_laser_log(folder_ / "drive.db3"));
}

TEST_F(LaserLogFolder, ReadsTheFilesOfAFolderInTheirOrder) {
  const auto messages = drive();
  const auto bag = folder_ / "bag";
  std::filesystem::create_directories(bag);
  const auto half = messages.begin() + static_cast<std::ptrdiff_t>(messages.size() / 2);
  write_mcap(bag / "bag_9.mcap", {messages.begin(), half});
  write_mcap(bag / "bag_10.mcap", {half, messages.end()});
  expect_drive(read_laser_log(bag));
}

/// The same drive by other odometry: `change` may do what it likes to message `i` of it.
std::vector<Raw> drive_with(const std::function<void(int i, nav_msgs::Odometry& odometry)>& change) {
  std::vector<Raw> messages = drive();
  int i = 0;
  for (Raw& message : messages) {
    if (message.topic != "/odom") continue;
    auto odometry = *decode_cdr<nav_msgs::Odometry>(message.data);
    change(i++, odometry);
    message.data = encode_cdr(odometry);
  }
  return messages;
}

TEST_F(LaserLogFolder, WhereNoTopicTellsOdometryItsTransformDoes) {
  std::vector<Raw> messages = drive();
  for (Raw& message : messages) {
    if (message.topic != "/odom") continue;
    const auto odometry = *decode_cdr<nav_msgs::Odometry>(message.data);
    const auto& pose = odometry.pose.pose;
    tf2_msgs::TFMessage transforms;
    transforms.transforms = {
        {{odometry.header.stamp, "map"}, "odom", {{5.0, 5.0, 0.0}, to_quaternion(Angle{})}},
        {odometry.header, "base_link", {{pose.position.x, pose.position.y, 0.0}, pose.orientation}}};
    transforms.transforms.back().header.frame_id = "odom";
    message.topic = "/tf";
    message.type = tf2_msgs::TFMessage::kType;
    message.data = encode_cdr(transforms);
  }
  write_mcap(folder_ / "tf.mcap", messages);
  const auto log = read_laser_log(folder_ / "tf.mcap");
  ASSERT_TRUE(log) << log.error().message;
  ASSERT_EQ(log->notes.size(), 1U);
  EXPECT_NE(log->notes.front().find("of /tf is taken"), std::string::npos) << log->notes.front();
  for (const LoggedScan& scan : log->scans)
    EXPECT_NEAR(scan.odom_from_base.x, 0.5 * (to_seconds(scan.time) - 100.0), 0.03);
}

TEST_F(LaserLogFolder, AnOdometryThatBeginsAnewIsNoMotionAndIsSaid) {
  for (const Pose2& anew : {Pose2{}, Pose2{-7.0, 3.0, Angle::degrees(100)}}) {
    write_mcap(folder_ / "anew.mcap", drive_with([&](int i, nav_msgs::Odometry& odometry) {
                 if (i >= 60) odometry.pose.pose = to_message(anew * Pose2{0.05 * (i - 60), 0.0, {}});
               }));
    const auto log = read_laser_log(folder_ / "anew.mcap");
    ASSERT_TRUE(log) << log.error().message;
    ASSERT_EQ(log->notes.size(), 1U);
    EXPECT_NE(log->notes.front().find("the odometry jumped once, 6 s"), std::string::npos) << log->notes.front();
    for (const LoggedScan& scan : log->scans)
      EXPECT_NEAR(scan.odom_from_base.x, 0.5 * (to_seconds(scan.time) - 100.0), 0.03);
  }
}

TEST_F(LaserLogFolder, StampsAsDriversGiveThemAreNoJumps) {
  // Jitter, a stall of 0.3 s after which what was held comes at once, and a clock that is set back.
  write_mcap(folder_ / "rough.mcap", drive_with([](int i, nav_msgs::Odometry& odometry) {
               double late = 0.02 * (i * 7 % 5) / 5.0;
               if (i >= 30 && i < 33) late = 0.1 * (33 - i) + 0.001 * (i - 30);
               if (i >= 50) late -= 2.0;
               odometry.header.stamp = to_message(from_message(odometry.header.stamp) + seconds(late));
             }));
  const auto log = read_laser_log(folder_ / "rough.mcap");
  ASSERT_TRUE(log) << log.error().message;
  ASSERT_EQ(log->notes.size(), 1U);
  EXPECT_NE(log->notes.front().find("set back"), std::string::npos) << log->notes.front();
  for (const LoggedScan& scan : log->scans)
    EXPECT_NEAR(scan.odom_from_base.x, 0.5 * (to_seconds(scan.time) - 100.0), 0.17);
}

TEST_F(LaserLogFolder, SaysWhatItHadToAssume) {
  std::vector<Raw> messages = drive();
  std::erase_if(messages, [](const Raw& message) { return message.topic == "/tf_static" || message.topic == "/odom"; });
  write_mcap(folder_ / "bare.mcap", messages);
  const auto log = read_laser_log(folder_ / "bare.mcap");
  ASSERT_TRUE(log);
  EXPECT_EQ(log->notes.size(), 3U);  // odometry, two lasers
}

TEST_F(LaserLogFolder, ReadsCarmenLogs) {
  ASSERT_TRUE(write_file_atomically(folder_ / "a.log", "FLASER 3 1 2 3 0 0 0 0 0 0 1.5 host 1.5\n"));
  const auto log = read_laser_log(folder_ / "a.log");
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_EQ(log->scans.size(), 1U);
}

TEST_F(LaserLogFolder, FaultsNameTheFile) {
  ASSERT_TRUE(write_file_atomically(folder_ / "a.db3", "no database at all, though it is called one"));
  ASSERT_TRUE(write_file_atomically(folder_ / "a.mcap", "no recording"));
  ASSERT_TRUE(write_file_atomically(folder_ / "a.log", "FLASER 3 1 2\n"));
  std::filesystem::create_directories(folder_ / "empty");
  write_mcap(folder_ / "silent.mcap", {});
  std::vector<Raw> damaged = drive();
  damaged[5].data.resize(20);
  write_mcap(folder_ / "damaged.mcap", damaged);
  const auto one = read_laser_log(folder_ / "damaged.mcap");  // of 200 messages
  ASSERT_TRUE(one) << one.error().message;
  ASSERT_EQ(one->notes.size(), 1U);
  EXPECT_NE(one->notes.front().find("(damaged)"), std::string::npos) << one->notes.front();
  for (const char* name : {"a.db3", "a.mcap", "a.log", "empty", "silent.mcap", "absent"}) {
    const auto log = read_laser_log(folder_ / name);
    ASSERT_FALSE(log) << name;
    EXPECT_EQ(log.error().message.rfind((folder_ / name).string() + ":", 0), 0U) << log.error().message;
  }
}

TEST_F(LaserLogFolder, SonarsWhereAskedFor) {
  auto messages = drive();
  tf2_msgs::TFMessage places;
  places.transforms = {link("base_link", "sonar_left", 0.0, 0.25, to_quaternion(Angle::degrees(90)))};
  messages.push_back(raw("/tf_static", Time{0}, places));
  const auto ping = [&](double time, const char* frame, float range, std::uint8_t radiation) {
    sensor_msgs::Range message;
    message.header = {to_message(time_from_seconds(time)), frame};
    message.radiation_type = radiation;
    message.min_range = 0.05F;
    message.max_range = 5.0F;
    message.range = range;
    messages.push_back(raw("/sonar", time_from_seconds(time), message));
  };
  ping(103.0, "sonar_left", 5.0F, 0);  // no return
  ping(102.0, "sonar_left", 1.5F, 0);
  ping(102.5, "sonar_left", 0.01F, 0);  // too near to be true
  ping(104.0, "sonar_left", 2.0F, 1);   // infrared
  ping(104.0, "sonar_lost", 2.0F, 0);
  write_mcap(folder_ / "sonar.mcap", messages);
  EXPECT_TRUE(read_laser_log(folder_ / "sonar.mcap")->pings.empty());
  const auto log = read_laser_log(folder_ / "sonar.mcap", {.with_sonars = true});
  ASSERT_TRUE(log) << log.error().message;
  ASSERT_EQ(log->pings.size(), 2U);
  EXPECT_FLOAT_EQ(log->pings[0].range, 1.5F);
  EXPECT_NEAR(log->pings[0].odom_from_base.x, 1.0, 1e-6);
  EXPECT_TRUE(std::isinf(log->pings[1].range));
  EXPECT_EQ(log->sonar_max_range, 5.0);
  ASSERT_EQ(log->base_from_sonar.size(), 1U);
  EXPECT_NEAR(log->base_from_sonar[0].y, 0.25, 1e-9);
  ASSERT_EQ(log->notes.size(), 1U);
  EXPECT_NE(log->notes[0].find("sonar_lost"), std::string::npos);
}

TEST_F(LaserLogFolder, WithoutAScanItSaysWhatIsThereAndWhatToDo) {
  std::vector<Raw> messages;
  for (const Raw& message : drive())
    if (message.type == nav_msgs::Odometry::kType) messages.push_back(message);
  messages.push_back({"/velodyne_points", "sensor_msgs/msg/PointCloud2", time_from_seconds(110), {0, 1, 0, 0}});
  write_mcap(folder_ / "cloud.mcap", messages);
  const auto cloud = read_laser_log(folder_ / "cloud.mcap");
  ASSERT_FALSE(cloud);
  for (const char* part :
       {"holds no laser scan", "/velodyne_points (sensor_msgs/msg/PointCloud2)", "/odom", "pointcloud_to_laserscan"})
    EXPECT_NE(cloud.error().message.find(part), std::string::npos) << cloud.error().message;
  sensor_msgs::LaserScan empty;
  empty.range_max = 10.0F;
  for (int i = 0; i < 5; ++i) messages.push_back(raw("/scan", time_from_seconds(110 + i), empty));
  write_mcap(folder_ / "empty.mcap", messages);
  const auto none = read_laser_log(folder_ / "empty.mcap");
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("5 of /scan (a scan without readings)"), std::string::npos)
      << none.error().message;
  messages = drive();
  messages.push_back(raw("/scan_front", time_from_seconds(111), empty));
  write_mcap(folder_ / "some.mcap", messages);
  const auto some = read_laser_log(folder_ / "some.mcap");
  ASSERT_TRUE(some) << some.error().message;
  const auto says_so = [](const std::string& note) { return note.find("without readings") != std::string::npos; };
  EXPECT_EQ(std::count_if(some->notes.begin(), some->notes.end(), says_so), 1);
}

TEST_F(LaserLogFolder, OddNamesAndKindsAreReadOrNamed) {
  std::vector<Raw> messages = drive();
  write_mcap(folder_ / "bag_0.mcap", messages);
  ASSERT_TRUE(write_file_atomically(folder_ / "metadata.yaml",
                                    "rosbag2_bagfile_information:\n  relative_file_paths: [bag_0.mcap]\n"));
  expect_drive(read_laser_log(folder_ / "metadata.yaml"));
  std::filesystem::remove_all(folder_ / "metadata.yaml");
  for (Raw& message : messages) message.type.erase(message.type.find("/msg"), 4);
  write_mcap(folder_ / "bag_0.mcap", messages);
  expect_drive(read_laser_log(folder_ / "bag_0.mcap"));
  const auto fault_of = [&](const char* name, const std::string& content) {
    EXPECT_TRUE(write_file_atomically(folder_ / name, content));
    const auto log = read_laser_log(folder_ / name);
    return log ? std::string{"read"} : log.error().message;
  };
  EXPECT_NE(fault_of("a.zip", "PK\x03\x04 and so on").find("is an archive (zip): unpack it first"), std::string::npos);
  EXPECT_NE(fault_of("a.tar", std::string(257, 'a') + "ustar").find("is an archive (tar)"), std::string::npos);
  EXPECT_NE(fault_of("a.bag", "").find("a.bag: is empty"), std::string::npos);
}

TEST_F(LaserLogFolder, TimesOfTheFileBefore1970TellNothing) {
  std::vector<Raw> messages = drive();
  for (Raw& message : messages) message.time.nanoseconds = -message.time.nanoseconds;
  write_database(folder_ / "bag_0.db3", messages);
  const auto log = read_laser_log(folder_ / "bag_0.db3");
  ASSERT_FALSE(log) << "in the order of such times the robot drives backwards";
  EXPECT_NE(log.error().message.find("the time in the file lies before 1970"), std::string::npos)
      << log.error().message;
}

}  // namespace
}  // namespace docent::recording
