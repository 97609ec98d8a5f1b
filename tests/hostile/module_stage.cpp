#include "module_stage.h"

#include <algorithm>
#include <numbers>

#include "docent/base/check.h"
#include "docent/messages/conversions.h"
#include "docent/messages/hostile_message.h"
#include "docent/pictures/jpeg/jpeg.h"

namespace docent {
namespace {

Pose2 here() { return {2.5, 2.0, Angle{}}; }

museum::Museum room() {
  museum::Museum museum;
  museum.name["en"] = "A room";
  museum.languages = {"en"};
  museum.map.frame = {50, 40, 0.1, {0.0, 0.0}};
  museum.map.cells.assign(museum.map.frame.size(), OccupancyGrid::kFree);
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 50; ++column)
      if (row < 2 || column < 2 || row > 37 || column > 47 || (column > 35 && row < 12))
        museum.map.cells[museum.map.frame.index({column, row})] = OccupancyGrid::kOccupied;
  museum.area = {{0.2, 0.2}, {4.8, 0.2}, {4.8, 3.8}, {0.2, 3.8}};
  museum.hazards.push_back({"plate", museum::HazardKind::plate, {{0.5, 3.0}, {1.0, 3.0}, {1.0, 3.5}, {0.5, 3.5}}});
  museum.home = here();
  museum::Exhibit exhibit;
  exhibit.id = "clock";
  exhibit.title["en"] = "The clock";
  exhibit.short_text["en"] = "A clock.";
  exhibit.long_text["en"] = "A clock that goes.";
  exhibit.pose = {1.5, 1.5, Angle{}};
  exhibit.look_at = {3.0, 1.5};
  museum.exhibits.push_back(exhibit);
  museum.modes["open"] = {};
  return museum;
}

/// What a sound robot would send, where a message without content would say nothing.
template <class T>
void fill(T& /*message*/, Rng& /*rng*/) {}
void fill(sensor_msgs::LaserScan& scan, Rng& /*rng*/) {
  scan.header.frame_id = "laser_front";
  scan.angle_min = -static_cast<float>(0.5 * std::numbers::pi);
  scan.angle_increment = static_cast<float>(std::numbers::pi / 180.0);
  scan.range_min = 0.02F;
  scan.range_max = 10.0F;
  for (int i = 0; i <= 180; ++i) scan.ranges.push_back(1.5F + 0.5F * static_cast<float>(i % 60) / 60.0F);
}
/// As virtual measurements do.
template <class T>
void go_round_twice(T& /*message*/) {}
void go_round_twice(sensor_msgs::LaserScan& scan) {
  scan.header.frame_id = "base_link";
  scan.angle_increment = static_cast<float>(std::numbers::pi / 90.0);
  scan.ranges.resize(360, 2.0F);
}
void fill(geometry_msgs::PoseWithCovarianceStamped& pose, Rng& /*rng*/) {
  pose.header.frame_id = "map";
  pose.pose.pose = to_message(here());
  pose.pose.covariance[0] = pose.pose.covariance[7] = 0.25;
  pose.pose.covariance[35] = 0.07;
}
void fill(geometry_msgs::PoseStamped& pose, Rng& /*rng*/) {
  pose.header.frame_id = "map";
  pose.pose = to_message(here());
}
void fill(sensor_msgs::Range& range, Rng& rng) {
  const auto index = static_cast<int>(rng.integer(0, 23));
  range.header.frame_id =
      rng.chance(0.5) ? robot::RobotBody::sonar_frame(index) : robot::RobotBody::infrared_frame(index);
  range.field_of_view = 0.3F;
  range.max_range = 3.0F;
  range.range = 1.5F;
}
void fill(nav_msgs::Odometry& odometry, Rng& /*rng*/) { odometry.pose.pose = to_message(Pose2{}); }
void fill(sensor_msgs::BatteryState& battery, Rng& /*rng*/) { battery.percentage = 0.8F; }
void fill(docent_msgs::Tactile& tactile, Rng& /*rng*/) { tactile.segments.assign(24, 0); }
void fill(docent_msgs::ObstacleLines& seen, Rng& /*rng*/) {
  seen.source = "camera";
  seen.lines.push_back({1.0F, 0.5F, 1.0F, -0.5F});
}
void fill(docent_msgs::Belief& belief, Rng& /*rng*/) {
  const Pose2 at = here();
  belief.cell_size = 0.2F;
  belief.heading_step = 0.05F;
  belief.cells.push_back({static_cast<float>(at.x), static_cast<float>(at.y), 0.0F, 1.0F});
  belief.rest = {0.0F, 0.0F, 1.0F, 5, 4, std::vector<float>(20, 0.0F)};
  belief.hypotheses.push_back({at.x, at.y, 0.0, {0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.01}, 1.0});
  belief.p_lost = 0.01;
  belief.localized = true;
}
void fill(docent_msgs::PersonBeams& beams, Rng& /*rng*/) {
  beams.x = {1.0F, 1.1F};
  beams.y = {0.0F, 0.1F};
  beams.localized = true;
  for (int i = 0; i < 180; ++i) {
    beams.bearings.push_back(static_cast<float>(i) * 0.0349F - 3.14F);
    beams.ranges.push_back(i % 20 < 3 ? 1.0F : 2.0F);
    beams.origins.push_back(i % 20 < 3 ? 3 : 1);
  }
}
void fill(docent_msgs::People& people, Rng& /*rng*/) {
  people.people.push_back({1, 1.0F, 1.0F, 0.5F, 0.0F});
  people.groups = {0};
}
void fill(docent_msgs::DriveGoal& goal, Rng& rng) {
  goal.id = "goal-" + std::to_string(rng.integer(0, 3));
  goal.x = 1.5;
  goal.y = 1.5;
  goal.relocalize = rng.chance(0.2);
}
void fill(docent_msgs::GoalState& state, Rng& rng) {
  const char* const states[] = {"idle", "waiting", "driving", "arrived", "blocked", "unreachable"};
  state.id = "goal-1";
  state.state = states[rng.integer(0, 5)];
}
void fill(docent_msgs::Target& target, Rng& /*rng*/) {
  target.goal_id = "goal-1";
  target.mode = "drive";
  target.via_x = {0.5, 1.0};
  target.via_y = {0.0, 0.1};
}
void fill(docent_msgs::Drive& drive, Rng& /*rng*/) { drive.linear = 0.3; }
void fill(docent_msgs::AvoidState& state, Rng& /*rng*/) {
  state.state = "driving";
  state.window.push_back({0.3F, 0.0F, 1.0F});
}
void fill(docent_msgs::Request& request, Rng& rng) {
  request.id = "01900000-0000-7000-8000-00000000000" + std::to_string(rng.integer(0, 9));
  request.source = "web";
  request.kind = "exhibit";
  request.target = "clock";
  request.language = "en";
}
void fill(docent_msgs::Task& task, Rng& rng) {
  task.id = "task-" + std::to_string(rng.integer(0, 3));
  task.kind = "visit";
  task.exhibit_id = "clock";
  task.x = 1.5;
  task.y = 1.5;
  task.language = "en";
}
void fill(docent_msgs::Say& say, Rng& rng) {
  say.id = "say-" + std::to_string(rng.integer(0, 9));
  say.text = "This is a clock.";
  say.language = "en";
}
void fill(nav_msgs::OccupancyGrid& map, Rng& /*rng*/) {
  map.info.resolution = 0.1F;
  map.info.width = 50;
  map.info.height = 40;
  map.data.assign(2000, 0);
}
void fill(sensor_msgs::CompressedImage& picture, Rng& /*rng*/) {
  picture.format = "jpeg";
  picture.data = pictures::encode_jpeg({16, 12}, 80);
}
void fill(docent_msgs::LiveMapUpdate& update, Rng& /*rng*/) {
  update.number = 1;
  update.x = 5;
  update.y = 5;
  update.width = 3;
  update.height = 2;
  update.data.assign(6, 100);
}

}  // namespace

ModuleStage::ModuleStage(const std::string& module, std::filesystem::path state) : museum_{room()} {
  for (const char* setting : {"web.port=0", "record.enabled=false", "mission.goal_poses=true"})
    (void)config_.set(setting);
  world_ = hub_.connect("world");
  for_each_robot_topic([this]<class T>(const Topic<T>& topic) {
    auto publisher = world_->publisher(topic);
    spoilt_.push_back([this, topic, publisher](Rng& rng, double share) {
      [[maybe_unused]] const Time now = hub_.now();
      T message;
      fill(message, rng);
      if (topic.name == topics::kVirtualScan.name) go_round_twice(message);
      if constexpr (requires { message.header.stamp; }) message.header.stamp = to_message(now);
      spoil(message, rng, share);
      publisher.publish(std::move(message));
    });
    decoded_.push_back([publisher](std::span<const std::uint8_t> bytes) {
      auto message = decode_cdr<T>(bytes);
      if (message) publisher.publish(std::move(*message));
    });
  });
  world_->subscribe<docent_msgs::Health>(topics::kHealth, [this](const auto& message) { health_ = message; });
  // What the module says must be fit for others.
  hub_.tap([this](const transport::TopicInfo& info, Time, const std::shared_ptr<const void>& message) {
    if (is_ours_) return;
    for_each_robot_topic([&]<class T>(const Topic<T>& topic) {
      if (std::string_view{topic.name} != info.name) return;
      const MessageFault fault =
          fault_on(topic, *static_cast<const T*>(message.get()), info.type->fault(message.get()));
      const std::string text = fault ? std::string{topic.name} + ": " + fault.text() : "";
      if (fault && std::find(unfit_.begin(), unfit_.end(), text) == unfit_.end()) unfit_.push_back(text);
    });
  });
  const modules::ModuleEntry* entry = modules::find_module(module);
  DOCENT_CHECK(entry != nullptr);
  modules::ModuleHost::Options options;
  options.state = std::move(state);
  options.seed = 1;
  options.virtual_time = true;
  auto host = modules::ModuleHost::create(*entry, hub_.connect(module), museum_, config_, options);
  DOCENT_CHECK(host.has_value());
  host_ = std::move(*host);
}

ModuleStage::~ModuleStage() = default;

std::size_t ModuleStage::topics() {
  std::size_t count = 0;
  for_each_robot_topic([&](const auto&) { ++count; });
  return count;
}

void ModuleStage::publish(std::size_t topic, Rng& rng, double share) {
  is_ours_ = true;
  spoilt_[topic](rng, share);
  is_ours_ = false;
}

void ModuleStage::publish(std::size_t topic, std::span<const std::uint8_t> cdr) {
  is_ours_ = true;
  decoded_[topic](cdr);
  is_ours_ = false;
}

void ModuleStage::run(double seconds_to_run) { hub_.run_until(hub_.now() + seconds(seconds_to_run)); }

std::uint64_t ModuleStage::refused() const {
  std::uint64_t count = 0;
  for (const auto& [topic, refusals] : host_->bus().refusals()) count += refusals.count;
  return count;
}

}  // namespace docent
