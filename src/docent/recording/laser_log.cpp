#include "docent/recording/laser_log.h"

#include <string>

#include "docent/base/text.h"
#include "docent/recording/carmen_log.h"
#include "docent/recording/gzip_text.h"
#include "docent/recording/recorded_ranges.h"
#include "docent/recording/ros_laser_log.h"
#include "docent/recording/rosbag/bag_reader.h"
#include "docent/recording/rosbag/ros1_messages.h"

namespace docent::recording {
namespace {

namespace fs = std::filesystem;

Result<LaserLog> read_ros_log(const fs::path& path, const LaserLogOptions& options) {
  RosLaserLogBuilder builder{options};
  std::vector<std::string> notes;
  const auto add = [&](const Rosbag2Message& message) {
    const std::string type = ros2_name_of(message.type);  // some converters of bags of ROS 1 leave its names
    builder.add({message.topic, type, message.time, message.data});
    return true;
  };
  if (const auto read = read_bag(path, add, notes); !read) return tl::unexpected<Error>(read.error());
  auto log = builder.finish();
  if (!log) {
    std::string text = path.string() + ": " + log.error().message;
    for (const std::string& note : notes) text += "; " + note;
    return fail(text);
  }
  log->notes.insert(log->notes.begin(), notes.begin(), notes.end());
  return log;
}

/// CARMEN's.
Result<LaserLog> read_text_log(const fs::path& path) {
  auto log = read_carmen_log(path);
  if (!log) {
    const auto text = read_gzip_text(path);
    const std::string other = text ? other_kind_of(text->content) : "";
    return other.empty() ? std::move(log) : fail(path.string() + ": is " + other);
  }
  RecordedRanges ranges;
  for (const LoggedScan& scan : log->scans)
    ranges.add(scan.rear ? "the rear laser" : "the front laser", scan.ranges, log->max_range);
  if (const auto judged = ranges.judge(log->notes); !judged) return fail(path.string() + ": " + judged.error().message);
  return log;
}

}  // namespace

Result<LaserLog> read_laser_log(const fs::path& path, const LaserLogOptions& options) {
  // Some name the file that says what is in a folder for the folder.
  if (path.filename() == "metadata.yaml") return read_ros_log(path.parent_path() / "", options);
  if (is_bag(path)) return read_ros_log(path, options);
  if (begins_with(path, "SQLite format 3"))
    return fail(path.string() + ": a database; the name of a rosbag2 database ends in .db3");
  if (options.times == LogTimes::index)
    return fail(path.string() + ": times by index are for recordings of ROS; this is none");
  if (!options.topics.scans.empty() || !options.topics.odometry.empty() || !options.topics.robot.empty())
    return fail(path.string() + ": topics and robots are chosen of recordings of ROS; this is none");
  return read_text_log(path);
}

}  // namespace docent::recording
