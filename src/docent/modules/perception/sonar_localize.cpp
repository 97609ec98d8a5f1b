#include "docent/modules/perception/sonar_localize.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "docent/localization/belief/checkpoint.h"
#include "docent/localization/pose_watch/odometry_trail.h"
#include "docent/localization/sonar/tracker/gaussian_belief.h"
#include "docent/messages/conversions.h"
#include "docent/modules/perception/belief_messages.h"
#include "docent/modules/shared/initial_pose.h"
#include "docent/modules/shared/sensor_time.h"

namespace docent::modules {
namespace {

constexpr Duration kTellPeriod = std::chrono::milliseconds{125};
constexpr double kMostDoubt = 0.5;  // of being lost, to say "here"
constexpr double kWidest = 0.5;     // [m] standard deviation, to say "here"

class SonarLocalizeModule final : public Module {
 public:
  SonarLocalizeModule(const ModuleContext& context, const SonarLocalizeParams& params)
      : bus_{context.bus},
        map_{context.museum.map},
        body_{context.config.body()},
        map_hash_{map_hash(map_)},
        checkpoint_path_{context.state / "localize.yaml"},
        tracker_{map_, params.tracker, body_.sonars},
        belief_{bus_.publisher(topics::kBelief)},
        pose_{bus_.publisher(topics::kPose)},
        transforms_{bus_.publisher(topics::kTransforms)},
        person_beams_{bus_.publisher(topics::kPersonBeams)} {
    const Pose2& home = context.museum.home;
    const Angle heading = params.start_heading ? Angle::degrees(*params.start_heading) : home.theta;
    tracker_.start_at({params.start_x.value_or(home.x), params.start_y.value_or(home.y), heading},
                      params.start_position_error, params.start_heading_error * kDegree);
    restore(params);
    publish_belief(bus_.now(), Pose2{});
    bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry, [this](const auto& odometry) { on_odometry(odometry); });
    bus_.subscribe<sensor_msgs::Range>(topics::kSonar, [this](const auto& range) { on_sonar(range); });
    subscribe_initial_pose(
        bus_, map_, [this](const localization::BeliefMode& mode, Time stamp) { return start_where_told(mode, stamp); });
    bus_.every(kTellPeriod, [this] { tell(); });
  }

  [[nodiscard]] ModuleHealth health() const override {
    const Time now = bus_.now();
    if (now - received_.odometry > kSilent) return {"degraded", "no odom"};
    if (now - received_.sonar > kSilent) return {"degraded", "no sonar"};
    if (!localized()) return {"degraded", "I do not know where I am"};
    return {};
  }

 private:
  [[nodiscard]] bool localized() const {
    const localization::PoseMatrix covariance = tracker_.covariance();
    return tracker_.p_lost() < kMostDoubt && std::max(covariance[0], covariance[4]) < kWidest * kWidest;
  }

  void on_odometry(const nav_msgs::Odometry& odometry) {
    received_.odometry = bus_.now();
    const Time stamp = sensor_time_.of(odometry);
    odometry_.add(stamp, from_message(odometry.pose.pose));
    const Pose2 odom_from_robot = odometry_.latest();
    if (restored_) {
      // What odometry did while nobody listened, unless it began anew.
      if (distance(restored_->position(), odom_from_robot.position()) < localization::kCheckpointWay)
        tracker_.move(*restored_);
      restored_.reset();
    }
    tracker_.move(odom_from_robot);
  }

  void on_sonar(const sensor_msgs::Range& range) {
    const auto index = body_.sonar_of(range.header.frame_id);
    if (!index) return;
    received_.sonar = bus_.now();
    const auto odom_from_robot = odometry_.at(sensor_time_.of("sonars", range.header));
    if (!odom_from_robot) return;
    tracker_.hear(
        {*index, body_.base_from_sonar(*index), static_cast<double>(range.range), static_cast<double>(range.max_range)},
        *odom_from_robot);
  }

  /// As in the other localizers. What the robot has driven since `stamp` is added to the pose that it had then.
  MessageFault start_where_told(const localization::BeliefMode& mode, Time stamp) {
    if (odometry_.empty()) return {"pose", "came before any odometry"};
    restored_.reset();
    const Pose2 then_from_now = inverse(odometry_.at(stamp).value_or(odometry_.latest())) * odometry_.latest();
    tracker_.start_at(mode.map_from_robot * then_from_now, std::sqrt(std::max(mode.covariance[0], mode.covariance[4])),
                      std::sqrt(mode.covariance[8]));
    return {};
  }

  /// In the odometry's own frame, as others see it.
  [[nodiscard]] Pose2 raw_from_robot() const { return odometry_.in_raw(odometry_.latest(), odometry_.latest_time()); }

  void tell() {
    if (odometry_.empty()) return;
    const Time stamp = odometry_.latest_time();
    publish_belief(stamp, raw_from_robot());
    publish_person_beams(stamp);
    if (!localized()) return;
    publish_transform(stamp);
    publish_pose(stamp);
    save(stamp);
  }

  void publish_belief(Time stamp, const Pose2& odom_from_robot) {
    const localization::BeliefSummary summary =
        localization::gaussian_belief(tracker_.map_from_robot(), tracker_.covariance(), tracker_.p_lost(), map_);
    docent_msgs::Belief message = belief_message(summary, stamp);
    message.map_hash = map_hash_;
    message.cell_size = static_cast<float>(map_.frame.resolution);
    message.heading_step = static_cast<float>(kDegree);
    message.p_lost = tracker_.p_lost();
    message.localized = localized();
    message.odom_pose = docent::to_message(odom_from_robot);
    belief_.publish(std::move(message));
  }

  /// Sonars do not tell people from cabinets: an empty message says that nobody was looked for in vain.
  void publish_person_beams(Time stamp) {
    docent_msgs::PersonBeams message;
    message.header = {docent::to_message(stamp), "base_link"};
    message.localized = localized();
    const Pose2& pose = tracker_.map_from_robot();
    message.map_from_base = {pose.x, pose.y, pose.theta.radians()};
    person_beams_.publish(std::move(message));
  }

  void publish_transform(Time stamp) {
    transforms_.publish(odom_in_map_message(tracker_.map_from_robot() * inverse(raw_from_robot()), stamp));
  }

  void publish_pose(Time stamp) {
    pose_.publish(pose_message({tracker_.map_from_robot(), tracker_.covariance(), 1.0}, stamp));
  }

  void save(Time stamp) {
    if (bus_.now() - saved_ < localization::kCheckpointEvery) return;
    saved_ = bus_.now();
    // A checkpoint that cannot be written costs a restarted robot its place, which it then must be told.
    (void)localization::save_localizer_checkpoint(
        {map_hash_, stamp, raw_from_robot(), {{tracker_.map_from_robot(), tracker_.covariance(), 1.0}}},
        checkpoint_path_);
  }

  void restore(const SonarLocalizeParams& params) {
    auto checkpoint = localization::load_localizer_checkpoint(checkpoint_path_);
    if (!checkpoint || checkpoint->map_hash != map_hash_ || checkpoint->modes.empty()) return;
    const Duration age = bus_.now() - checkpoint->time;
    if (age < -kTellPeriod || age > localization::kCheckpointAge) return;
    tracker_.start_at(checkpoint->modes.front().map_from_robot, params.start_position_error,
                      params.start_heading_error * kDegree);
    restored_ = checkpoint->odom_from_robot;
  }

  transport::Bus& bus_;
  const OccupancyGrid& map_;
  robot::RobotBody body_;
  std::string map_hash_;
  std::filesystem::path checkpoint_path_;
  localization::SonarTracker tracker_;
  transport::Publisher<docent_msgs::Belief> belief_;
  transport::Publisher<geometry_msgs::PoseWithCovarianceStamped> pose_;
  transport::Publisher<tf2_msgs::TFMessage> transforms_;
  transport::Publisher<docent_msgs::PersonBeams> person_beams_;
  SensorTime sensor_time_{bus_};
  localization::OdometryTrail odometry_;
  std::optional<Pose2> restored_;  ///< odometry of the checkpoint, until odometry speaks
  struct Received {
    Time odometry{}, sonar{};
  };
  Received received_;
  Time saved_{};
};

}  // namespace

Result<void> SonarLocalizeParams::validate() const {
  if (!(start_position_error > 0.0)) return fail("sonar.start_position_error must be > 0");
  if (!(start_heading_error > 0.0)) return fail("sonar.start_heading_error must be > 0");
  return tracker.validate();
}

std::unique_ptr<Module> make_sonar_localize(const ModuleContext& context, const SonarLocalizeParams& params) {
  return std::make_unique<SonarLocalizeModule>(context, params);
}

}  // namespace docent::modules
