#include "docent/modules/exploration/explore_module.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "docent/messages/fit_target.h"
#include "docent/modules/shared/belief_cells.h"
#include "docent/modules/shared/grid_message.h"
#include "docent/modules/shared/person_beams.h"
#include "docent/modules/shared/pose_tracker.h"
#include "docent/modules/shared/scanners.h"
#include "docent/modules/shared/sensor_time.h"
#include "docent/modules/shared/stop_keeper.h"
#include "docent/planning/survey/surveyor.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::modules {
namespace {

constexpr Duration kTargetPeriod = std::chrono::milliseconds{200};
constexpr Duration kPlanPeriod = std::chrono::seconds{1};
constexpr Duration kMapPeriod = std::chrono::seconds{2};
constexpr Duration kUntilItStands = std::chrono::seconds{1};

docent_msgs::PersonBeams sight_message(const planning::Surveyor::Sight& sight) {
  std::vector<Point2> ends;  // of beams on people
  for (std::size_t i = 0; i < sight.origins.size(); ++i)
    if (sight.origins[i] == sensor_models::BeamOrigin::not_map) ends.push_back(endpoint(sight.look.sweep.beams[i]));
  return person_beams_message(
      {sight.look.stamp, true, sight.map_from_base, sight.look.odom_from_base, sight.look.sweep, sight.origins, ends});
}

docent_msgs::Belief place_message(const planning::Surveyor::Place& place, Time now) {
  docent_msgs::Belief message = belief_cells_message(belief_of(place.pose), now);
  static_assert(std::string_view{kMapBeingMade} == planning::SurveyStore::kMapHash);
  message.map_hash = kMapBeingMade;
  message.cell_size = static_cast<float>(place.pose.sigma);
  message.heading_step = static_cast<float>(place.pose.sigma_heading);
  message.p_lost = 0.0;
  message.localized = true;
  message.odom_pose = to_message(place.odom_from_base);
  return message;
}

docent_msgs::Exploration report_message(const planning::Surveyor::Report& report, Time now) {
  docent_msgs::Exploration message;
  message.header = {to_message(now), "map"};
  message.state = to_text(report.phase);
  message.known_m2 = static_cast<float>(report.known_m2);
  message.frontier = static_cast<std::uint32_t>(report.frontier);
  message.way_m = static_cast<float>(report.way_m);
  message.loops = static_cast<std::uint32_t>(report.loops);
  for (const auto& place : report.unreached) {
    message.unreached_x.push_back(place.place.x);
    message.unreached_y.push_back(place.place.y);
  }
  message.map = report.map;
  message.warning = report.warning;
  message.order = to_text(report.order);
  message.mark_margin = report.mark_margin;
  return message;
}

/// What avoidance says that it stands or turns away for.
planning::ExplorationDrive::Hindrance hindrance_of(const std::string& reason) {
  using Hindrance = planning::ExplorationDrive::Hindrance;
  const auto word = parse<ReasonWord>(reason);
  if (word == ReasonWord::person_in_way || word == ReasonWord::people_near) return Hindrance::person;
  if (word == ReasonWord::border_in_way || word == ReasonWord::hazard_in_way) return Hindrance::ground;
  return word == ReasonWord::obstacle_in_way ? Hindrance::thing : Hindrance::unknown;
}

class ExploreModule final : public Module {
 public:
  ExploreModule(const ModuleContext& context, const planning::SurveyorParams& params, planning::SurveySite site)
      : bus_{context.bus},
        surveyor_{
            params,
            std::move(site),
            {mounts_of(context.config.body().scanners), context.config.body().radius, reach_of(context.config.body())},
            planning::SurveyStore{context.state},
            bus_.now()},
        belief_{bus_.publisher(topics::kBelief)},
        target_{bus_.publisher(topics::kTarget)},
        static_map_{bus_.publisher(topics::kStaticMap)},
        path_{bus_.publisher(topics::kPath)},
        person_beams_{bus_.publisher(topics::kPersonBeams)},
        exploration_{bus_.publisher(topics::kExploration)} {
    bus_.subscribe<docent_msgs::People>(topics::kPeopleInOdom, [this](const auto& people) { note(people); });
    bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry, [this](const auto& odometry) { move(odometry); });
    subscribe_scanners(bus_, context.config.body(), [this](std::size_t i, const auto& scan, const auto& place) {
      surveyor_.mount(i, place.base_from_sensor);
      see(i, scan, place);
    });
    bus_.subscribe<docent_msgs::Stop>(
        topics::kStop, [this, view = StopView{}](const auto& stop) mutable { surveyor_.note_stop(view.see(stop)); });
    bus_.subscribe<docent_msgs::Steering>(topics::kSteering,
                                          [this](const auto&) { surveyor_.note_steering(bus_.now()); });
    bus_.subscribe<docent_msgs::ExplorationOrder>(
        topics::kExplorationOrder, [this](const auto& order) { obey(parse<ExplorationOrder>(order.order)); });
    bus_.subscribe<docent_msgs::AvoidState>(topics::kAvoidState, [this](const auto& state) {
      const bool is_fault = state.state == "stopped" && !parse<ReasonWord>(state.reason);
      surveyor_.note_hindrance(hindrance_of(state.reason), is_fault ? state.reason : "");
    });
    bus_.every(kTargetPeriod, [this] { aim(); });
    bus_.every(kPlanPeriod, [this] { plan(); });
    bus_.every(kMapPeriod, [this] { publish_map(surveyor_.map()); });
    publish_state();
  }

  [[nodiscard]] ModuleHealth health() const override {
    if (!surveyor_.fault().empty()) return {"faulted", surveyor_.fault()};
    if (!surveyor_.has_odometry()) return {"degraded", "no odometry"};
    if (!surveyor_.has_begun()) return {"starting", "no scan of all lasers yet"};
    if (std::string plea = surveyor_.plea(); !plea.empty()) return {"degraded", std::move(plea)};
    return {};
  }

 private:
  void note(const docent_msgs::People& people) {
    std::vector<planning::TrackedPerson> tracked;
    for (const docent_msgs::Person& person : people.people)
      tracked.push_back({person.id, {static_cast<double>(person.x), static_cast<double>(person.y)}});
    surveyor_.note_people(tracked);
  }

  void move(const nav_msgs::Odometry& odometry) {
    surveyor_.move(sensor_time_.of(odometry),
                   {from_message(odometry.pose.pose), {odometry.twist.twist.linear.x, odometry.twist.twist.angular.z}});
  }

  void see(std::size_t laser, const sensor_msgs::LaserScan& scan, const ScannerPlace& place) {
    surveyor_.keep(laser, sensor_time_.of(laser, scan, place),
                   {scan.ranges, Angle::radians(scan.angle_min), scan.angle_increment, scan.range_min, scan.range_max});
    if (laser != 0) return;
    if (const auto sight = surveyor_.sight()) person_beams_.publish(sight_message(*sight));
    if (surveyor_.add_moment()) publish_belief();
  }

  void obey(std::optional<ExplorationOrder> order) {
    if (!order || !surveyor_.obey(*order)) return;
    if (surveyor_.is_done()) end();
    aim();
    publish_state();
  }

  void plan() {
    const planning::Surveyor::Step step = surveyor_.plan(bus_.now());
    if (step == planning::Surveyor::Step::none) return;
    if (surveyor_.is_done()) end();
    if (step == planning::Surveyor::Step::ended) return;
    if (step == planning::Surveyor::Step::planned) publish_path();
    publish_state();
  }

  /// No more is seen; when it stands, the map is made.
  void end() {
    aim();
    publish_state();
    bus_.after(kUntilItStands, [this] { finish(); });
  }

  void finish() {
    auto map = surveyor_.finish(bus_.now());
    if (!map) return;
    publish_map(std::move(*map));
    publish_state();
  }

  void aim() {
    publish_belief();
    docent_msgs::Target target;
    target.header = {to_message(bus_.now()), "odom"};
    target.goal_id = "explore";
    target.mode = to_text(DriveMode::stop);
    target.position_tolerance = 0.1;
    const auto ahead = surveyor_.ahead();
    if (!ahead.via.empty()) {
      target.mode = to_text(DriveMode::drive);
      target.is_final = ahead.is_final;
      for (const Point2 via : ahead.via) {
        target.via_x.push_back(via.x);
        target.via_y.push_back(via.y);
      }
    }
    target_.publish(fit_target(std::move(target)));
  }

  void publish_belief() {
    if (const auto place = surveyor_.place()) belief_.publish(place_message(*place, bus_.now()));
  }

  void publish_map(OccupancyGrid map) {
    if (map.cells.empty()) return;
    const Time now = bus_.now();
    static_map_.publish({{to_message(now), "map"}, info_of(map.frame, now), std::move(map.cells)});
  }

  void publish_path() {
    nav_msgs::Path path;
    path.header = {to_message(bus_.now()), "map"};
    for (const Point2& point : surveyor_.way())
      path.poses.push_back({path.header, to_message(Pose2{point.x, point.y, {}})});
    path_.publish(std::move(path));
  }

  void publish_state() { exploration_.publish(report_message(surveyor_.report(), bus_.now())); }

  transport::Bus& bus_;
  SensorTime sensor_time_{bus_};
  planning::Surveyor surveyor_;
  transport::Publisher<docent_msgs::Belief> belief_;
  transport::Publisher<docent_msgs::Target> target_;
  transport::Publisher<nav_msgs::OccupancyGrid> static_map_;
  transport::Publisher<nav_msgs::Path> path_;
  transport::Publisher<docent_msgs::PersonBeams> person_beams_;
  transport::Publisher<docent_msgs::Exploration> exploration_;
};

}  // namespace

Result<std::unique_ptr<Module>> make_explore(const ModuleContext& context) {
  auto params = context.config.section<planning::SurveyorParams>("explore");
  if (!params) return tl::unexpected<Error>(params.error());
  params->explorer.robot_radius = std::max(params->explorer.robot_radius, context.config.body().radius);
  planning::SurveySite site{context.museum.home, context.museum.hazard_polygons(), context.museum.area};
  return std::make_unique<ExploreModule>(context, *params, std::move(site));
}

Result<robot::ParameterRows> parameters_of_explore(const robot::RobotConfig& config) {
  return robot::list_parameters<planning::SurveyorParams>(config, "explore");
}

}  // namespace docent::modules
