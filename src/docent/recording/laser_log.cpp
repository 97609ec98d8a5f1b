#include "docent/recording/laser_log.h"

#include <algorithm>
#include <fstream>
#include <string>

#include "docent/recording/carmen_log.h"
#include "docent/recording/mcap/format.h"
#include "docent/recording/mcap/reader.h"
#include "docent/recording/recorded_ranges.h"
#include "docent/recording/ros_laser_log.h"

namespace docent::recording {
namespace {

namespace fs = std::filesystem;

/// Any of the files that a ROS 2 recording consists of.
Result<void> read_ros_file(const fs::path& path, const std::function<bool(const Rosbag2Message&)>& handler) {
  if (path.extension() == ".db3") return read_rosbag2_database(path, handler);
  auto reader = McapReader::open(path);
  if (!reader) return tl::unexpected<Error>(reader.error());
  return reader->read([&](const McapMessage& message) {
    return handler({message.channel.topic, message.channel.type, message.log_time, message.data});
  });
}

Result<LaserLog> read_ros_log(const fs::path& path, const std::vector<fs::path>& files, bool with_sonars) {
  RosLaserLogBuilder builder{with_sonars};
  for (const fs::path& file : files) {
    Result<void> added;
    const auto read = read_ros_file(file, [&](const Rosbag2Message& message) {
      added = builder.add(message);
      return added.has_value();
    });
    if (!read) return tl::unexpected<Error>(read.error());
    if (!added) return fail(file.string() + ": " + added.error().message);
  }
  auto log = builder.finish();
  if (!log) return fail(path.string() + ": " + log.error().message);
  return log;
}

/// CARMEN's.
Result<LaserLog> read_text_log(const fs::path& path) {
  auto log = read_carmen_log(path);
  if (!log) return log;
  RecordedRanges ranges;
  for (const LoggedScan& scan : log->scans)
    ranges.add(scan.rear ? "the rear laser" : "the front laser", scan.ranges, log->max_range);
  if (const auto judged = ranges.judge(log->notes); !judged) return fail(path.string() + ": " + judged.error().message);
  return log;
}

/// The parts of a rosbag2 folder; their names rise with time.
std::vector<fs::path> parts_of(const fs::path& folder) {
  std::vector<fs::path> parts;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator{folder, error})
    if (entry.path().extension() == ".mcap" || entry.path().extension() == ".db3") parts.push_back(entry.path());
  // bag_2 comes before bag_10.
  std::sort(parts.begin(), parts.end(), [](const fs::path& a, const fs::path& b) {
    const std::string x = a.filename(), y = b.filename();
    return x.size() != y.size() ? x.size() < y.size() : x < y;
  });
  return parts;
}

bool begins_with(const fs::path& path, const char* bytes, std::size_t size) {
  std::string head(size, '\0');
  std::ifstream file{path, std::ios::binary};
  file.read(head.data(), static_cast<std::streamsize>(size));
  return file.gcount() == static_cast<std::streamsize>(size) && head.compare(0, size, bytes, size) == 0;
}

}  // namespace

Result<LaserLog> read_laser_log(const fs::path& path, bool with_sonars) {
  std::error_code error;
  if (fs::is_directory(path, error)) {
    const auto parts = parts_of(path);
    if (parts.empty()) return fail(path.string() + ": holds no .mcap or .db3 file");
    return read_ros_log(path, parts, with_sonars);
  }
  const bool is_mcap = begins_with(path, reinterpret_cast<const char*>(mcap::kMagic.data()), mcap::kMagic.size()) ||
                       (!fs::exists(path, error) && fs::exists(unfinished_path(path), error));
  constexpr std::string_view kSqlite{"SQLite format 3"};
  if (is_mcap || path.extension() == ".db3" || path.extension() == ".mcap")
    return read_ros_log(path, {path}, with_sonars);
  if (begins_with(path, kSqlite.data(), kSqlite.size()))
    return fail(path.string() + ": a database; the name of a rosbag2 database ends in .db3");
  return read_text_log(path);
}

}  // namespace docent::recording
