// Reads maps and recordings as the program does: one request a line on standard input, one answer a line. So that the
// trial of odd files is one process. With an argument it is a crippled reader, which the trial must find out:
// "gamma" shows pictures as a screen would, "first-topics" takes the first scans and the first odometry of a recording.

#include <png.h>

#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "docent/grid/occupancy_grid.h"
#include "docent/recording/laser_log.h"
#include "docent/recording/rosbag/bag_reader.h"

namespace docent {
namespace {

using Json = nlohmann::json;

/// The picture as 8 bits of grey that look alike on a screen, in its place.
void show_as_screens_do(const std::string& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&image, path.c_str()) == 0) return;
  image.format = PNG_FORMAT_GRAY;
  std::vector<png_byte> pixels(PNG_IMAGE_SIZE(image));
  const png_color behind{255, 255, 255};
  if (png_image_finish_read(&image, &behind, pixels.data(), 0, nullptr) != 0)
    png_image_write_to_file(&image, path.c_str(), 0, pixels.data(), 0, nullptr);
}

recording::WantedTopics first_topics(const std::string& path) {
  recording::WantedTopics first;
  std::vector<std::string> notes;
  const auto look = [&](const recording::Rosbag2Message& message) {
    if (message.type == "sensor_msgs/msg/LaserScan" && first.scans.empty()) first.scans = {message.topic};
    if (message.type == "nav_msgs/msg/Odometry" && first.odometry.empty()) first.odometry = message.topic;
    return first.scans.empty() || first.odometry.empty();
  };
  (void)recording::read_bag(path, look, notes);
  return first;
}

Json answer_of(const Result<LoadedMap>& read) {
  if (!read) return {{"error", read.error().message}};
  const GridFrame& frame = read->map.frame;
  std::string cells;
  for (const std::int8_t cell : read->map.cells) {
    constexpr const char* kDigits = "0123456789abcdef";
    const auto byte = static_cast<std::uint8_t>(cell);
    cells += kDigits[byte >> 4U];
    cells += kDigits[byte & 15U];
  }
  return {{"columns", frame.columns}, {"rows", frame.rows},   {"resolution", frame.resolution}, {"x", frame.origin.x},
          {"y", frame.origin.y},      {"notes", read->notes}, {"cells", std::move(cells)}};
}

Json list_of(const Pose2& pose) { return Json::array({pose.x, pose.y, pose.theta.radians()}); }

Json answer_of(const Result<recording::LaserLog>& read) {
  if (!read) return {{"error", read.error().message}};
  Json scans = Json::array();
  for (const recording::LoggedScan& scan : read->scans) {
    Json ranges = Json::array();  // -1: no return, -2: invalid
    for (const float range : scan.ranges)
      ranges.push_back(std::isinf(range) ? -1.0 : std::isnan(range) ? -2.0 : static_cast<double>(range));
    scans.push_back({{"time", scan.time.nanoseconds},
                     {"bearing", scan.first_bearing.radians()},
                     {"step", scan.bearing_step},
                     {"ranges", std::move(ranges)},
                     {"odometry", list_of(scan.odom_from_base)},
                     {"mount", list_of(scan.base_from_laser)}});
  }
  return {{"scans", std::move(scans)},
          {"readings", read->odometry.size()},
          {"reach", read->max_range},
          {"sources", read->sources},
          {"notes", read->notes}};
}

Json answer_to(const Json& request, const std::string& crippled) {
  const std::string path = request.at("path");
  if (request.at("what") == "map") {
    if (crippled == "gamma") show_as_screens_do(request.at("image"));
    return answer_of(read_map(path));
  }
  recording::LaserLogOptions options;
  if (crippled == "first-topics") options.topics = first_topics(path);
  if (request.contains("scans")) options.topics.scans = request.at("scans").get<std::vector<std::string>>();
  options.topics.odometry = request.value("odometry", options.topics.odometry);
  options.topics.robot = request.value("robot", options.topics.robot);
  if (request.value("times", "") == "index") options.times = recording::LogTimes::index;
  return answer_of(recording::read_laser_log(path, options));
}

}  // namespace
}  // namespace docent

int main(int count, char** arguments) {
  const std::string crippled = count > 1 ? arguments[1] : "";
  for (std::string line; std::getline(std::cin, line);) {
    const auto answer = docent::answer_to(nlohmann::json::parse(line), crippled);
    std::cout << answer.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << std::endl;
  }
}
