#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "docent/apps/simulate/simulation_run.h"
#include "docent/messages/schema.h"
#include "docent/modules/host/registry.h"
#include "docent/recording/mcap/reader.h"

namespace docent {
namespace {

using Json = nlohmann::json;

/// What a 3D panel can draw, and what Docent means it to draw there.
const std::map<std::string, std::string> kDrawn{
    {"/map", "nav_msgs/msg/OccupancyGrid"},
    {"/docent/live_map", "nav_msgs/msg/OccupancyGrid"},
    {"/docent/museum_markers", "visualization_msgs/msg/MarkerArray"},
    {"/docent/people_markers", "visualization_msgs/msg/MarkerArray"},
    {"/docent/path", "nav_msgs/msg/Path"},
    {"/docent/belief_poses", "geometry_msgs/msg/PoseArray"},
    {"/amcl_pose", "geometry_msgs/msg/PoseWithCovarianceStamped"},
    {"/scan_front", "sensor_msgs/msg/LaserScan"},
    {"/scan_rear", "sensor_msgs/msg/LaserScan"},
    {"/scan_left", "sensor_msgs/msg/LaserScan"},
    {"/scan_right", "sensor_msgs/msg/LaserScan"},
    {"/docent/virtual_scan", "sensor_msgs/msg/LaserScan"},
};

Json layout() {
  std::ifstream file{std::string{DOCENT_SOURCES} + "/share/lichtblick/docent.json"};
  return Json::parse(file);
}

/// The types of all topics by their names in a recording.
std::map<std::string, MessageSchemas> topics() {
  std::map<std::string, MessageSchemas> all;
  for_each_robot_topic(
      [&]<class T>(const Topic<T>& topic) { all[std::string{"/"} + topic.name] = message_schemas<T>(); });
  return all;
}

/// The type of a field such as "linear.x"; empty: there is none.
std::string type_of(const MessageSchemas& schemas, const std::string& path) {
  std::string type = schemas.back().type;
  std::stringstream names{path};
  for (std::string name; std::getline(names, name, '.');) {
    const auto schema = std::find_if(schemas.begin(), schemas.end(), [&](const auto& s) { return s.type == type; });
    if (schema == schemas.end()) return {};
    const auto field =
        std::find_if(schema->fields.begin(), schema->fields.end(), [&](const auto& f) { return f.name == name; });
    if (field == schema->fields.end() || field->shape != FieldSchema::Shape::single) return {};
    type = field->type;
  }
  return type;
}

/// "/docent/health{module=="map"}.state": topic, filter's field, filter's value, field.
struct Path {
  std::string topic, filter, value, field;
};
Path parse(const std::string& text) {
  static const std::regex kPath{R"re((/[\w/]+)(?:\{(\w+)=="(\w+)"\})?\.([\w.]+))re"};
  std::smatch found;
  if (!std::regex_match(text, found, kPath)) return {};
  return {found[1], found[2], found[3], found[4]};
}

TEST(LichtblickLayout, DrawsTopicsThatExistWithTheirTypes) {
  const auto all = topics();
  const Json view = layout().at("configById").at("3D!docent");
  std::set<std::string> drawn;
  for (const auto& [topic, settings] : view.at("topics").items()) {
    SCOPED_TRACE(topic);
    ASSERT_TRUE(all.contains(topic));
    ASSERT_TRUE(kDrawn.contains(topic)) << "does a 3D panel draw it?";
    EXPECT_EQ(all.at(topic).back().type, kDrawn.at(topic));
    EXPECT_TRUE(settings.at("visible").is_boolean());
    drawn.insert(topic);
  }
  EXPECT_EQ(drawn.size(), kDrawn.size());
  EXPECT_EQ(view.at("followTf"), "map");
  const Json& publish = view.at("publish");
  EXPECT_EQ(publish.at("type"), "pose_estimate");
  const std::string told = publish.at("poseEstimateTopic");
  ASSERT_TRUE(all.contains(told));
  EXPECT_EQ(all.at(told).back().type, "geometry_msgs/msg/PoseWithCovarianceStamped") << "that is what it publishes";
  EXPECT_LT(publish.at("poseEstimateXDeviation").get<double>(), kWidestPose);
}

TEST(LichtblickLayout, PlotsNumbersThatExist) {
  const auto all = topics();
  const Json paths = layout().at("configById").at("Plot!drive").at("paths");
  EXPECT_GE(paths.size(), 2U);
  for (const Json& line : paths) {
    const Path path = parse(line.at("value"));
    SCOPED_TRACE(line.at("value").get<std::string>());
    ASSERT_TRUE(all.contains(path.topic));
    EXPECT_EQ(type_of(all.at(path.topic), path.field), "float64");
  }
}

TEST(LichtblickLayout, HasARowForTheHealthOfEachModule) {
  const auto all = topics();
  std::set<std::string> shown;
  const Json rows = layout().at("configById").at("StateTransitions!health").at("paths");
  for (const Json& row : rows) {
    const Path path = parse(row.at("value"));
    SCOPED_TRACE(row.at("value").get<std::string>());
    ASSERT_TRUE(all.contains(path.topic));
    EXPECT_EQ(all.at(path.topic).back().type, "docent_msgs/msg/Health");
    EXPECT_EQ(type_of(all.at(path.topic), path.field), "string");
    EXPECT_EQ(type_of(all.at(path.topic), path.filter), "string");
    shown.insert(path.value);
  }
  std::set<std::string> modules;
  for (const modules::ModuleEntry& entry : modules::all_modules()) modules.insert(entry.name);
  EXPECT_EQ(shown, modules);
}

TEST(LichtblickLayout, ShowsEveryPanelOnce) {
  const Json all = layout();
  std::multiset<std::string> placed;
  const std::function<void(const Json&)> place = [&](const Json& node) {
    if (node.is_string()) return void(placed.insert(node.get<std::string>()));
    place(node.at("first"));
    place(node.at("second"));
  };
  place(all.at("layout"));
  std::multiset<std::string> panels;
  for (const auto& [id, panel] : all.at("configById").items()) panels.insert(id);
  EXPECT_EQ(placed, panels);
}

TEST(LichtblickLayout, FindsItsTopicsInARecording) {
  const auto file = std::filesystem::temp_directory_path() / ("docent_layout_" + std::to_string(getpid()) + ".mcap");
  {
    apps::simulate_command::SimulationRunOptions options;
    options.museum = std::string{DOCENT_SOURCES} + "/museums/bonn";
    options.start = Pose2{9.0, 3.6, Angle::degrees(90.0)};
    options.requests_per_hour = 240.0;
    options.recording = file.string();
    auto run = apps::simulate_command::SimulationRun::create(options);
    ASSERT_TRUE(run) << run.error().message;
    ASSERT_TRUE((*run)->run_until(time_from_seconds(60.0)));
    ASSERT_TRUE((*run)->finish());
  }
  auto reader = recording::McapReader::open(file);
  ASSERT_TRUE(reader) << reader.error().message;
  std::map<std::string, std::string> recorded;  // topic, type
  ASSERT_TRUE(reader->read([&](const recording::McapMessage& message) {
    recorded[message.channel.topic] = message.channel.type;
    return true;
  }));
  std::filesystem::remove(file);
  // This body has two scanners.
  const std::set<std::string> others{"/scan_left", "/scan_right"};
  for (const auto& [topic, type] : kDrawn) {
    if (others.contains(topic)) continue;
    EXPECT_TRUE(recorded.contains(topic)) << topic;
    EXPECT_EQ(recorded[topic], type);
  }
  for (const char* topic : {"/tf", "/tf_static", "/cmd_vel", "/docent/health", "/docent/avoid_state"})
    EXPECT_TRUE(recorded.contains(topic)) << topic;
}

}  // namespace
}  // namespace docent
