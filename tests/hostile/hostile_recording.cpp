#include "hostile_recording.h"

#include <sqlite3.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numbers>

#include "docent/base/check.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/messages/conversions.h"
#include "docent/messages/hostile_message.h"
#include "docent/recording/mcap/writer.h"

namespace docent {
namespace {

constexpr double kWidth = 10.0, kDepth = 8.0;  // [m] of the room
constexpr double kResolution = 0.1;            // [m] of its map
constexpr int kSonars = 4;

bool is_wall(Point2 p) {
  const bool outside = p.x < 0.3 || p.y < 0.3 || p.x > kWidth - 0.3 || p.y > kDepth - 0.3;
  const bool pillar = p.x > 6.0 && p.x < 7.0 && p.y > 2.0 && p.y < 4.5;
  return outside || pillar || (p.x < 2.0 && p.y > 6.0);
}

float range_at(const Pose2& map_from_sensor, double bearing) {
  const Point2 direction = unit(map_from_sensor.theta + Angle::radians(bearing));
  double range = 0.0;
  while (range < 12.0 && !is_wall(map_from_sensor.position() + range * direction)) range += 0.02;
  return static_cast<float>(range);
}

/// What a seed does to a recording.
struct Attack {
  bool scans = false, sonars = false, odometry = false, places = false;
  double messages = 0.0;     ///< share of them that are spoiled
  double fields = 0.0;       ///< share of their fields
  Duration leap{};           ///< of the clock, from `leaps` on
  int leaps = 0;             ///< step of the drive
  int beams = 0;             ///< > 0: a scan has so many
  float increment = 0.0F;    ///< of their bearings
  double log_time_at = 0.0;  ///< [s] where the file's own times begin
};

Attack attack_of(std::uint64_t seed) {
  Attack attack;
  if (seed == 0) return attack;
  Rng rng = Rng{seed}.stream("attack");
  attack.scans = rng.chance(0.6);
  attack.sonars = rng.chance(0.4);
  attack.odometry = rng.chance(0.5);
  attack.places = rng.chance(0.4);
  const double shares[] = {0.02, 0.3, 1.0};
  attack.messages = shares[rng.integer(0, 2)];
  attack.fields = shares[rng.integer(0, 2)] * 0.3;
  if (rng.chance(0.3)) {
    const double leaps_s[] = {-100.0, 3600.0, 1e9, 2.1e9, -1e9};
    attack.leap = seconds(leaps_s[rng.integer(0, 4)]);
    attack.leaps = static_cast<int>(rng.integer(0, 40));
  }
  if (rng.chance(0.4)) {
    const int beams[] = {1, 2, 5000, 20000};
    const float increments[] = {0.0F, 1e-40F, 1e-30F, 1e-6F, 3.0F, -1e30F, 1e30F};
    attack.beams = beams[rng.integer(0, 3)];
    attack.increment = increments[rng.integer(0, 6)];
  }
  if (rng.chance(0.08)) attack.log_time_at = 9.0e9;
  return attack;
}

geometry_msgs::TransformStamped place(const std::string& child, const Pose2& base_from_child) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = "base_link";
  transform.child_frame_id = child;
  transform.transform = {{base_from_child.x, base_from_child.y, 0.3}, to_quaternion(base_from_child.theta)};
  return transform;
}

Pose2 base_from_sonar(int sonar) { return {0.0, 0.0, Angle::degrees(90.0 * sonar)}; }

}  // namespace

std::vector<RawMessage> hostile_drive(std::uint64_t seed) {
  const Attack attack = attack_of(seed);
  Rng rng = Rng{seed}.stream("fields");
  std::vector<RawMessage> messages;
  const auto add = [&]<class T>(const char* topic, Time time, T message, bool attacked) {
    if (attacked && rng.chance(attack.messages)) spoil(message, rng, attack.fields);
    messages.push_back({topic, T::kType, time, encode_cdr(message)});
  };
  tf2_msgs::TFMessage places;
  places.transforms.push_back(place("laser", {0.1, 0.0, Angle{}}));
  for (int i = 0; i < kSonars; ++i)
    places.transforms.push_back(place("sonar_" + std::to_string(i), base_from_sonar(i)));
  add("/tf_static", time_from_seconds(attack.log_time_at), places, attack.places);

  for (int step = 0; step < 120; ++step) {
    const double along = 0.05 * step;
    const Pose2 map_from_base{2.0 + along, 1.2 + 0.3 * std::sin(along), Angle::radians(0.3 * std::cos(along))};
    const Time log_time = time_from_seconds(attack.log_time_at + 100.0 + 0.1 * step);
    const Time stamp = time_from_seconds(100.0 + 0.1 * step) + (step >= attack.leaps ? attack.leap : Duration{});
    nav_msgs::Odometry odometry;
    odometry.header = {to_message(stamp), "odom"};
    odometry.child_frame_id = "base_link";
    odometry.pose.pose = to_message(map_from_base);
    odometry.twist.twist.linear.x = 0.5;
    add("/odom", log_time, odometry, attack.odometry);
    if (step % 2 != 0) continue;
    sensor_msgs::LaserScan scan;
    scan.header = {to_message(stamp), "laser"};
    const int beams = attack.beams > 0 ? attack.beams : 181;
    scan.angle_min = static_cast<float>(-0.5 * std::numbers::pi);
    scan.angle_increment = attack.beams > 0 ? attack.increment : static_cast<float>(std::numbers::pi / 180.0);
    scan.range_min = 0.05F;
    scan.range_max = 10.0F;
    const Pose2 map_from_laser = map_from_base * Pose2{0.1, 0.0, Angle{}};
    for (int i = 0; i < std::min(beams, 181); ++i) {
      const double bearing = static_cast<double>(scan.angle_min) + i * std::numbers::pi / 180.0;
      scan.ranges.push_back(range_at(map_from_laser, bearing));
    }
    scan.ranges.resize(static_cast<std::size_t>(beams), 3.0F);
    add("/scan", log_time, scan, attack.scans);
    for (int i = 0; i < kSonars; ++i) {
      sensor_msgs::Range range;
      range.header = {to_message(stamp), "sonar_" + std::to_string(i)};
      range.field_of_view = 0.3F;
      range.min_range = 0.02F;
      range.max_range = 3.0F;
      range.range = range_at(map_from_base * base_from_sonar(i), 0.0);
      add("/sonar", log_time, range, attack.sonars);
    }
  }
  return messages;
}

void write_mcap(const std::filesystem::path& path, const std::vector<RawMessage>& messages) {
  auto writer = recording::McapWriter::create(path);
  DOCENT_CHECK(writer.has_value());
  std::map<std::string, recording::McapWriter::Channel> channels;
  for (const RawMessage& message : messages) {
    if (!channels.contains(message.topic))
      channels[message.topic] = *writer->add_channel({message.topic, message.type, "ros2msg", "x", "cdr", {}});
    DOCENT_CHECK(writer->write(channels[message.topic], message.time, message.time, message.data).has_value());
  }
  DOCENT_CHECK(writer->close().has_value());
}

void write_rosbag2(const std::filesystem::path& path, const std::vector<RawMessage>& messages) {
  std::filesystem::remove(path);
  sqlite3* database = nullptr;
  DOCENT_CHECK(sqlite3_open(path.c_str(), &database) == SQLITE_OK);
  const auto run = [&](const std::string& command) {
    DOCENT_CHECK(sqlite3_exec(database, command.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
  };
  run("PRAGMA synchronous=OFF");
  run("BEGIN; CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT);"
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB);");
  std::map<std::string, int> topics;
  for (const RawMessage& message : messages) {
    const auto [topic, is_new] = topics.try_emplace(message.topic, static_cast<int>(topics.size()) + 1);
    if (is_new)
      run("INSERT INTO topics VALUES(" + std::to_string(topic->second) + ", '" + message.topic + "', '" + message.type +
          "')");
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(database, "INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)", -1, &statement,
                       nullptr);
    sqlite3_bind_int(statement, 1, topic->second);
    sqlite3_bind_int64(statement, 2, message.time.nanoseconds);
    sqlite3_bind_blob(statement, 3, message.data.data(), static_cast<int>(message.data.size()), SQLITE_TRANSIENT);
    DOCENT_CHECK(sqlite3_step(statement) == SQLITE_DONE);
    sqlite3_finalize(statement);
  }
  run("COMMIT");
  sqlite3_close(database);
}

void write_room_map(const std::filesystem::path& folder) {
  OccupancyGrid map;
  map.frame = {static_cast<int>(kWidth / kResolution), static_cast<int>(kDepth / kResolution), kResolution, {0.0, 0.0}};
  map.cells.resize(map.frame.size());
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const int columns = map.frame.columns;
    const CellIndex cell{static_cast<int>(i) % columns, static_cast<int>(i) / columns};
    map.cells[i] = is_wall(map.frame.centre(cell)) ? OccupancyGrid::kOccupied : OccupancyGrid::kFree;
  }
  DOCENT_CHECK(save_map(map, folder / "room").has_value());
}

}  // namespace docent
