#include "docent/modules/drive/hazards_module.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "docent/collision_avoidance/clocks/driver_stamps.h"
#include "docent/collision_avoidance/clocks/local_time.h"
#include "docent/collision_avoidance/virtual_measurements/carried_ranges.h"
#include "docent/collision_avoidance/virtual_measurements/mount_doubt.h"
#include "docent/collision_avoidance/virtual_measurements/virtual_measurements.h"
#include "docent/geometry/polygon.h"
#include "docent/messages/conversions.h"
#include "docent/modules/shared/belief_cells.h"

namespace docent::modules {

namespace {

class HazardsModule final : public Module {
 public:
  HazardsModule(const ModuleContext& context, const collision_avoidance::VirtualMeasurementParams& params)
      : bus_{context.bus},
        hazards_{context.museum.area, context.museum.hazard_polygons(), params,
                 collision_avoidance::VirtualMeasurements::Ends::hazards},
        border_{context.museum.area, context.museum.hazard_polygons(), params,
                collision_avoidance::VirtualMeasurements::Ends::border},
        stands_{context.museum.hazards},
        doubt_{params.doubt_sigmas, context.config.body().radius + kBeside},
        best_pose_only_{params.best_pose_only},
        scan_{bus_.publisher(topics::kVirtualScan)} {
    bus_.subscribe<docent_msgs::Belief>(topics::kBelief,
                                        [this](const docent_msgs::Belief& belief) { measure(belief); });
    bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry, [this](const nav_msgs::Odometry& odometry) {
      odometry_ = Odometry{taken(odometry), from_message(odometry.pose.pose)};
      if (last_ && bus_.now() - published_ >= kMovingPeriod && is_carried()) publish();
    });
    bus_.subscribe<docent_msgs::Calibration>(topics::kCalibration,
                                             [this](const auto& calibration) { doubt(calibration); });
    bus_.subscribe<docent_msgs::Exploration>(topics::kExploration,
                                             [this](const auto& survey) { doubt_.marks = survey.mark_margin; });
    // Says that it lives while the belief rests.
    bus_.every(seconds(0.25), [this] {
      if (last_ && bus_.now() - published_ > seconds(0.2) && bus_.now() - received_ < seconds(kBeliefLife)) publish();
    });
  }

  [[nodiscard]] ModuleHealth health() const override {
    if (!last_) return {"starting", "no belief yet"};
    if (bus_.now() - received_ > seconds(kBeliefLife)) return {"degraded", "no fresh belief"};
    if (!stands_.zone.empty())
      return {"degraded",
              "I stand inside the zone '" + stands_.zone + "': an operator may steer me out, or correct the museum"};
    if (stands_.possible_mass < 0.5) return {"degraded", "the belief lies where the robot cannot be"};
    return {};
  }

 private:
  static constexpr double kBeside = 0.1;      // [m]: doubt alone never tells a robot that it touches something
  static constexpr double kBeliefLife = 3.0;  // [s]
  static constexpr Duration kMovingPeriod = std::chrono::milliseconds{80};
  /// So long a belief is carried on by odometry; then its own stamp stands, and avoidance slows down by its age.
  static constexpr double kCarriedFor = 0.6;  // [s]
  static constexpr double kCarriedWay = 1.2;  // [m] more is a jump of odometry and no way
  static constexpr double kMoved = 0.01;      // [m]
  /// [s]: a clock that is farther behind is another one. Less than any message takes is left to those who hear the
  /// scans, too: what they take for ours, as they do what comes quicker than that, must be so here.
  static constexpr double kHonestWay = 0.3;
  static constexpr double kTurned = 0.02;  // [rad]

  struct Odometry {
    Time stamp{};
    Pose2 raw_from_base;
  };
  /// What was measured from the newest belief.
  struct Measured {
    Odometry at;
    std::array<collision_avoidance::VirtualMeasurements::Ranges, 2> ranges;  ///< hazards, border
  };

  [[nodiscard]] Time taken(const nav_msgs::Odometry& odometry) {
    const Time now = bus_.now();
    return local_time_.receive("odometry", now,
                               collision_avoidance::stamp_or(from_message(odometry.header.stamp), now));
  }
  /// The way since the belief, where odometry tells of one.
  [[nodiscard]] std::optional<Pose2> step() const {
    if (!odometry_ || !(last_->at.stamp < odometry_->stamp)) return std::nullopt;
    if (odometry_->stamp - last_->at.stamp > seconds(kCarriedFor)) return std::nullopt;
    const Pose2 step = inverse(last_->at.raw_from_base) * odometry_->raw_from_base;
    return norm(step.position()) < kCarriedWay ? std::optional{step} : std::nullopt;
  }
  /// It has moved since it last told, and what was measured can be carried on.
  [[nodiscard]] bool is_carried() const {
    if (!step()) return false;
    const Pose2 since = inverse(told_from_.raw_from_base) * odometry_->raw_from_base;
    return norm(since.position()) > kMoved || std::abs(since.theta.radians()) > kTurned;
  }

  /// The worst of the scanners: nobody knows to which of them the belief owes its pose.
  void doubt(const docent_msgs::Calibration& calibration) {
    doubt_.mounts = {};
    for (const docent_msgs::CalibratedMount& mount : calibration.mounts) {
      if (mount.is_known) continue;
      doubt_.mounts.heading = std::max(doubt_.mounts.heading, doubt_.sigmas * mount.doubt_heading);
      doubt_.mounts.position = std::max(doubt_.mounts.position, doubt_.sigmas * mount.doubt_position);
    }
  }

  /// The id of the hazard that holds a place, map; empty: none does.
  [[nodiscard]] std::string zone_at(Point2 place) const {
    for (const museum::Hazard& zone : stands_.zones)
      if (contains(zone.polygon, place)) return zone.id;
    return {};
  }

  void measure(const docent_msgs::Belief& belief) {
    poses_.clear();
    for (const auto& cell : belief.cells) poses_.push_back({{cell.x, cell.y}, cell.theta, cell.mass});
    squares_.clear();
    const auto& rest = belief.rest;
    for (std::size_t i = 0; i < rest.mass.size() && rest.columns > 0; ++i) {
      const auto column = static_cast<double>(i % rest.columns);
      const auto row = static_cast<double>(i / rest.columns);
      const double side = rest.cell_size;
      squares_.push_back(
          {{rest.origin_x + (column + 0.5) * side, rest.origin_y + (row + 0.5) * side}, side, rest.mass[i]});
    }
    if (best_pose_only_ && !belief.hypotheses.empty()) {
      const auto& best = belief.hypotheses.front();
      poses_.assign(1, {{best.x, best.y}, best.theta, 1.0});
      squares_.clear();
    }
    stands_.zone.clear();
    if (belief.localized && !belief.hypotheses.empty())
      stands_.zone = zone_at({belief.hypotheses.front().x, belief.hypotheses.front().y});
    if (!stands_.zone.empty()) {
      // In its middle every edge is the nearest for some pose: the way out is that of the likeliest.
      const auto& best = belief.hypotheses.front();
      poses_.assign(1, {{best.x, best.y}, best.theta, 1.0});
      squares_.clear();
    }
    auto of_hazards = hazards_.measure(poses_, squares_);
    if (belief.map_hash == kMapBeingMade && !belief.hypotheses.empty()) {
      // The area begins where the robot did, and lies as far off as the map that is being made: no belief about a place
      // in that map tells how far. It stands off what could be touched; hazards count from the whole belief.
      const auto& here = belief.hypotheses.front();
      poses_.assign(1, {{here.x, here.y}, here.theta, 1.0});
      squares_.clear();
    }
    auto of_border = border_.measure(poses_, squares_);
    collision_avoidance::lower_by_doubt(of_hazards.ranges,
                                        {doubt_.mounts.heading, doubt_.mounts.position + doubt_.marks, doubt_.keep});
    collision_avoidance::lower_by_doubt(of_border.ranges, {doubt_.mounts.heading, 0.0});
    stands_.possible_mass = of_hazards.possible_mass;

    last_ = Measured{{from_message(belief.header.stamp), from_message(belief.odom_pose)},
                     {of_hazards.ranges, of_border.ranges}};
    received_ = bus_.now();
    publish();
  }

  /// As of now, by odometry; where that cannot be, as of the belief, by whose stamp nobody takes it for newer.
  void publish() {
    using collision_avoidance::VirtualMeasurements;
    const auto way = step();
    told_from_ = way ? *odometry_ : last_->at;
    sensor_msgs::LaserScan scan;
    scan.header = {to_message(told_from_.stamp), "base_link"};
    scan.angle_increment = static_cast<float>(2.0 * std::numbers::pi / VirtualMeasurements::kDirections);
    scan.angle_min = static_cast<float>(-std::numbers::pi);
    scan.angle_max = scan.angle_min + scan.angle_increment * (2 * VirtualMeasurements::kDirections - 1);
    scan.range_max = static_cast<float>(VirtualMeasurements::kMaxRange);
    // Two turns: the body keeps off the hazards of the first, the centre off the border in the second.
    for (const auto& measured : last_->ranges) {
      const auto ranges = way ? collision_avoidance::carried(measured, *way) : measured;
      for (const double range : ranges) scan.ranges.push_back(static_cast<float>(range));
    }
    published_ = bus_.now();
    scan_.publish(std::move(scan));
  }

  transport::Bus& bus_;
  collision_avoidance::LocalTime local_time_{{.honest_way = kHonestWay}};
  collision_avoidance::VirtualMeasurements hazards_;
  collision_avoidance::VirtualMeasurements border_;
  /// Whether the robot is where it may be.
  struct {
    std::vector<museum::Hazard> zones;
    std::string zone{};          ///< in which it knows that it stands; empty: none
    double possible_mass = 1.0;  ///< of the belief
  } stands_;
  /// What the belief does not tell.
  struct {
    double sigmas;
    double keep;                                  ///< [m], see MountDoubt
    collision_avoidance::MountDoubt mounts = {};  ///< of the scanners
    double marks = 0.0;                           ///< [m] that the hazards themselves may lie off
  } doubt_;
  bool best_pose_only_;  ///< crippled, see VirtualMeasurementParams
  transport::Publisher<sensor_msgs::LaserScan> scan_;
  std::vector<collision_avoidance::WeightedPose> poses_;
  std::vector<collision_avoidance::WeightedSquare> squares_;
  std::optional<Measured> last_;
  std::optional<Odometry> odometry_;
  Odometry told_from_;
  Time received_{};
  Time published_{};
};

}  // namespace

Result<std::unique_ptr<Module>> make_hazards(const ModuleContext& context) {
  auto params = context.config.section<collision_avoidance::VirtualMeasurementParams>("hazards");
  if (!params) return tl::unexpected<Error>(params.error());
  return std::make_unique<HazardsModule>(context, *params);
}

Result<robot::ParameterRows> parameters_of_hazards(const robot::RobotConfig& config) {
  return robot::list_parameters<collision_avoidance::VirtualMeasurementParams>(config, "hazards");
}

}  // namespace docent::modules
