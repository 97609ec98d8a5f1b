#include "docent/modules/perception/localize_module.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <span>

#include "docent/grid/occupancy_grid.h"
#include "docent/localization/belief/checkpoint.h"
#include "docent/localization/markov/markov_localizer.h"
#include "docent/localization/monte_carlo/monte_carlo_localizer.h"
#include "docent/localization/sonar/evidence/sonar_evidence.h"
#include "docent/messages/conversions.h"
#include "docent/modules/perception/belief_messages.h"
#include "docent/modules/perception/sonar_localize.h"
#include "docent/modules/shared/initial_pose.h"
#include "docent/modules/shared/scanners.h"
#include "docent/motion_models/odometry_history.h"
#include "docent/motion_models/unbroken_odometry.h"

namespace docent::modules {
namespace {

constexpr Duration kLookPeriod = std::chrono::milliseconds{100};
constexpr Duration kTogether = std::chrono::milliseconds{250};   // scans of two lasers that make one sweep
constexpr Duration kRepublish = std::chrono::milliseconds{500};  // the belief of a robot that stands

/// Section `localize.sonar`: sonars alone, with `localize.method: sonar`, or beside the lasers.
struct SonarParams {
  SonarLocalizeParams alone;
  localization::SonarEvidenceParams beside;
  template <class V>
  void visit(V& v) {
    alone.visit(v);
    beside.visit(v);
  }
  [[nodiscard]] Result<void> validate() const {
    if (auto valid = alone.validate(); !valid) return valid;
    return beside.validate();
  }
};

/// Section `localize`: where the robot is.
struct LocalizeParams {
  /// grid; particles, which share all of the grid's parameters that concern them; sonar: a tracker without laser
  std::string method = "grid";
  localization::LocalizerParams markov;
  localization::MonteCarloParams particles;
  SonarParams sonar;
  localization::PersonFilterParams people;  ///< the inverse filter
  double person_range = 6.0;                ///< [m], > 0: how far away people are looked for
  template <class V>
  void visit(V& v) {
    v("method", method);
    markov.visit(v);
    v("particles", particles);
    v("sonar", sonar);
    v("people", people);
    v("person_range", person_range);
  }
  [[nodiscard]] Result<void> validate() const {
    if (!(person_range > 0.0)) return fail("person_range must be > 0");
    if (method != "grid" && method != "particles" && method != "sonar")
      return fail("method must be grid, particles or sonar, not '" + method + "'");
    for (const auto& valid : {particles.validate(), sonar.validate(), people.validate()})
      if (!valid) return valid;
    return markov.validate();
  }
};

/// A localizer and, where they take part in its belief, the sonars.
struct Believer {
  std::unique_ptr<localization::Localizer> localizer;
  std::shared_ptr<localization::SonarEvidence> sonars;
};

Believer with_sonars(auto localizer, const ModuleContext& context, const LocalizeParams& params) {
  std::shared_ptr<localization::SonarEvidence> sonars;
  const int count = context.config.body().sonars;
  if (params.sonar.beside.beams > 0 && count > 0) {
    sonars = std::make_shared<localization::SonarEvidence>(
        params.sonar.beside, count, localizer->space(), localizer->table(),
        sensor_models::ProximityModel{params.markov.sensor}, context.seed);
    localizer->add_sensor(sonars);
  }
  return {std::move(localizer), std::move(sonars)};
}

Believer make_believer(const ModuleContext& context, const LocalizeParams& params) {
  const localization::RangeTableCache cache{context.cache};
  const localization::FloorMap map{context.museum.map, context.museum.hazard_polygons()};
  if (params.method == "particles")
    return with_sonars(
        std::make_unique<localization::MonteCarloLocalizer>(map, params.markov, params.particles, cache, context.seed),
        context, params);
  return with_sonars(std::make_unique<localization::MarkovLocalizer>(map, params.markov, cache, context.seed), context,
                     params);
}

class LocalizeModule final : public Module {
 public:
  LocalizeModule(const ModuleContext& context, const LocalizeParams& params)
      : bus_{context.bus},
        params_{params},
        checkpoint_path_{context.state / "localize.yaml"},
        map_hash_{map_hash(context.museum.map)},
        body_{context.config.body()},
        believer_{make_believer(context, params)},
        localizer_{believer_.localizer.get()},
        lasers_(body_.scanners.size()),
        belief_{bus_.publisher(topics::kBelief)},
        pose_{bus_.publisher(topics::kPose)},
        transforms_{bus_.publisher(topics::kTransforms)},
        person_beams_{bus_.publisher(topics::kPersonBeams)} {
    restore();
    publish_belief(bus_.now(), localizer_->odom_from_robot());
    bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry, [this](const auto& odometry) {
      odometry_received_ = bus_.now();
      const Time stamp = from_message(odometry.header.stamp);
      // The belief moves by odometry without jumps; what is published is in the odometry's own frame.
      const auto reading = unbroken_.add(stamp, from_message(odometry.pose.pose));
      odometry_.add(stamp, reading.odom_from_base);
      has_jumped_ = has_jumped_ || reading.jumped;
      if (restored_) check_restored();
    });
    subscribe_scanners(bus_, body_, [this](std::size_t i, const auto& scan) { on_scan(i, scan); });
    if (believer_.sonars)
      bus_.subscribe<sensor_msgs::Range>(topics::kSonar, [this](const auto& range) { on_sonar(range); });
    subscribe_initial_pose(bus_, context.museum.map, [this](const localization::BeliefMode& mode, Time stamp) {
      return start_where_told(mode, stamp);
    });
    bus_.every(kLookPeriod, [this] { look(); });
  }

  [[nodiscard]] ModuleHealth health() const override {
    const Time now = bus_.now();
    if (now - odometry_received_ > kSilent) return {"degraded", "no odom"};
    if (lasers_.empty()) return {"degraded", "body.scanners is empty: nothing tells where I am"};
    for (std::size_t i = 0; i < lasers_.size(); ++i)
      if (now - lasers_[i].received > kSilent) return {"degraded", "no scan_" + body_.scanners[i].name};
    if (!localized()) return {"degraded", "I do not know where I am"};
    if (believer_.sonars) return health_of_sonars(now);
    return {};
  }

 private:
  struct Laser {
    sensor_msgs::LaserScan scan;
    Time received{};
    bool is_new = false;
  };

  [[nodiscard]] bool localized() const { return localizer_->verdict().localized(); }

  void on_scan(std::size_t laser, const sensor_msgs::LaserScan& scan) {
    lasers_[laser].scan = scan;  // the last one only: who is late drops scans
    lasers_[laser].received = bus_.now();
    lasers_[laser].is_new = true;
  }

  [[nodiscard]] ModuleHealth health_of_sonars(Time now) const {
    if (now - sonar_received_ > kSilent) return {"degraded", "no sonar"};
    switch (believer_.sonars->trust().state()) {
      case localization::SonarTrust::State::frozen:
        return {"degraded", "sonar is frozen"};
      case localization::SonarTrust::State::at_odds:
        return {"degraded", "sonar hears nothing of what the map holds"};
      case localization::SonarTrust::State::well:
        break;
    }
    return {};
  }

  void on_sonar(const sensor_msgs::Range& range) {
    const auto index = body_.sonar_of(range.header.frame_id);
    if (!index) return;
    sonar_received_ = bus_.now();
    const Time stamp = from_message(range.header.stamp);
    const auto odom_from_base = odometry_.at(stamp);
    if (!odom_from_base) return;
    believer_.sonars->hear({stamp, *index, body_.base_from_sonar(*index), *odom_from_base,
                            static_cast<double>(range.range), static_cast<double>(range.max_range)});
  }

  /// One sweep of what came since the last look, or nothing.
  void look() {
    if (std::none_of(lasers_.begin(), lasers_.end(), [](const Laser& laser) { return laser.is_new; })) return;
    Time stamp{};
    for (const Laser& laser : lasers_)
      if (laser.is_new) stamp = std::max(stamp, from_message(laser.scan.header.stamp));
    const auto odom_from_base = odometry_.at(stamp);
    if (!odom_from_base) return;  // wait for odometry, or the scan is too old to be placed
    sensor_models::RangeSweep sweep;
    for (std::size_t i = 0; i < lasers_.size(); ++i) {
      Laser& laser = lasers_[i];
      const Time taken = from_message(laser.scan.header.stamp);
      const auto then = odometry_.at(taken);
      laser.is_new = false;
      if (laser.scan.ranges.empty() || stamp - taken > kTogether || !then) continue;
      const Pose2 base_from_then = inverse(*odom_from_base) * *then;
      sensor_models::append(sweep,
                            {laser.scan.ranges, Angle::radians(static_cast<double>(laser.scan.angle_min)),
                             static_cast<double>(laser.scan.angle_increment), static_cast<double>(laser.scan.range_min),
                             static_cast<double>(laser.scan.range_max)},
                            base_from_then * body_.scanners[i].base_from_sensor());
    }
    if (sweep.beams.empty()) return;
    digest(sweep, *odom_from_base, stamp);
  }

  void digest(const sensor_models::RangeSweep& sweep, const Pose2& odom_from_base, Time stamp) {
    const localization::Localizer::Step step = localizer_->observe(sweep, odom_from_base, stamp);
    if (step.updated) last_step_ = step;
    const bool is_torn = has_jumped_ && !(stamp < unbroken_.jumped());
    if (step.updated || is_torn || bus_.now() - belief_published_ >= kRepublish) publish_belief(stamp, odom_from_base);
    if (is_torn) has_jumped_ = false;
    publish_person_beams(sweep, odom_from_base, stamp);
    publish_transform(stamp);
    if (step.updated && localized()) {
      publish_pose(stamp);
      save(stamp);
    }
  }

  /// The belief of the last update, carried forward by odometry to the stamp.
  void publish_belief(Time stamp, const Pose2& odom_from_base) {
    const localization::BeliefSummary& summary = localizer_->summary();
    const Pose2 before_from_now = inverse(localizer_->odom_from_robot()) * odom_from_base;
    docent_msgs::Belief message;
    message.header = {docent::to_message(stamp), "map"};
    message.map_hash = map_hash_;
    message.cell_size = static_cast<float>(params_.markov.states.cell_size);
    message.heading_step = static_cast<float>(params_.markov.states.heading_step * std::numbers::pi / 180.0);
    message.cells.reserve(summary.cells.size());
    for (const auto& cell : summary.cells) {
      const Pose2 pose = Pose2{static_cast<double>(cell.x), static_cast<double>(cell.y),
                               Angle::radians(static_cast<double>(cell.theta))} *
                         before_from_now;
      message.cells.push_back({static_cast<float>(pose.x), static_cast<float>(pose.y),
                               static_cast<float>(pose.theta.radians()), cell.mass});
    }
    message.rest = rest_message(summary);
    for (const localization::BeliefMode& mode : summary.modes) {
      const Pose2 pose = mode.map_from_robot * before_from_now;
      message.hypotheses.push_back({pose.x, pose.y, pose.theta.radians(), mode.covariance, mode.mass});
    }
    message.entropy = summary.entropy;
    message.p_lost = localizer_->verdict().p_lost();
    message.localized = localized();
    message.agreement = static_cast<float>(localizer_->verdict().agreement());
    message.contradiction = static_cast<float>(localizer_->verdict().contradiction());
    message.surprise = static_cast<float>(localizer_->verdict().surprise());
    message.hidden = static_cast<float>(localizer_->verdict().hidden());
    message.confirmation = static_cast<float>(localizer_->verdict().confirmation());
    message.blind_way = static_cast<float>(localizer_->verdict().blind_way());
    message.unmapped = static_cast<float>(localizer_->verdict().unmapped());
    message.share = static_cast<float>(localizer_->verdict().share());
    message.active_mass = summary.active_mass;
    message.active_cells = static_cast<std::uint32_t>(summary.active_states);
    message.beams_used = static_cast<std::uint32_t>(last_step_.beams_used);
    message.beams_filtered = static_cast<std::uint32_t>(last_step_.beams_filtered);
    message.odom_pose = docent::to_message(inverse(unbroken_.odom_from_raw(stamp)) * odom_from_base);
    belief_.publish(std::move(message));
    belief_published_ = bus_.now();
  }

  void publish_person_beams(const sensor_models::RangeSweep& sweep, const Pose2& odom_from_base, Time stamp) {
    docent_msgs::PersonBeams message;
    message.header = {docent::to_message(stamp), "base_link"};
    message.localized = localized();
    if (const auto best = localizer_->map_from_robot(odom_from_base))
      message.map_from_base = {best->x, best->y, best->theta.radians()};
    message.odom_from_base = {odom_from_base.x, odom_from_base.y, odom_from_base.theta.radians()};
    message.bearings.reserve(sweep.beams.size());
    message.ranges.reserve(sweep.beams.size());
    message.origins.reserve(sweep.beams.size());
    const auto origins = localizer_->origins(sweep, odom_from_base, params_.markov.sensor.max_range, params_.people);
    for (std::size_t i = 0; i < sweep.beams.size(); ++i) {
      const sensor_models::SweepBeam& beam = sweep.beams[i];
      message.bearings.push_back(static_cast<float>(beam.bearing));
      message.ranges.push_back(static_cast<float>(beam.no_return ? -beam.range : beam.range));
      message.origins.push_back(static_cast<std::uint8_t>(origins[i]));
      if (origins[i] != sensor_models::BeamOrigin::not_map || beam.range > params_.person_range) continue;
      const Point2 end = sensor_models::endpoint(beam);
      message.x.push_back(static_cast<float>(end.x));
      message.y.push_back(static_cast<float>(end.y));
    }
    person_beams_.publish(std::move(message));
  }

  void publish_transform(Time stamp) {
    if (!localized()) return;
    transforms_.publish(odom_in_map_message(*localizer_->map_from_robot({}) * unbroken_.odom_from_raw(stamp), stamp));
  }

  void publish_pose(Time stamp) { pose_.publish(pose_message(localizer_->summary().modes.front(), stamp)); }

  void save(Time stamp) {
    if (bus_.now() - saved_ < localization::kCheckpointEvery) return;
    saved_ = bus_.now();
    // A checkpoint that cannot be written costs a restarted robot a new search, nothing else.
    const Pose2 raw_from_robot = inverse(unbroken_.odom_from_raw(stamp)) * localizer_->odom_from_robot();
    (void)localization::save_localizer_checkpoint({map_hash_, stamp, raw_from_robot, localizer_->summary().modes},
                                                  checkpoint_path_);
  }

  void restore() {
    auto checkpoint = localization::load_localizer_checkpoint(checkpoint_path_);
    if (!checkpoint || checkpoint->map_hash != map_hash_) return;
    const Duration age = bus_.now() - checkpoint->time;
    if (age < Duration{0} - kTogether || age > localization::kCheckpointAge) return;
    localizer_->start_at(checkpoint->modes, checkpoint->odom_from_robot, checkpoint->time);
    restored_ = checkpoint->odom_from_robot;
  }

  /// Somebody says where the robot stood at `stamp`; where nobody knows odometry of then, it stands there now.
  MessageFault start_where_told(const localization::BeliefMode& mode, Time stamp) {
    if (odometry_.empty()) return {"pose", "came before any odometry"};
    restored_.reset();
    auto odom_from_base = odometry_.at(stamp);
    if (!odom_from_base) {
      stamp = odometry_.latest_time();
      odom_from_base = odometry_.latest();
    }
    localizer_->start_at(std::span{&mode, 1}, *odom_from_base, stamp);
    publish_belief(stamp, *odom_from_base);
    return {};
  }

  /// The first odometry after a restart: has the robot been moved, or its odometry been reset?
  void check_restored() {
    if (distance(restored_->position(), odometry_.latest().position()) > localization::kCheckpointWay)
      localizer_->start_unknown();
    restored_.reset();
  }

  transport::Bus& bus_;
  LocalizeParams params_;
  std::filesystem::path checkpoint_path_;
  std::string map_hash_;
  robot::RobotBody body_;
  Believer believer_;
  localization::Localizer* localizer_;
  std::vector<Laser> lasers_;  ///< [scanners]
  transport::Publisher<docent_msgs::Belief> belief_;
  transport::Publisher<geometry_msgs::PoseWithCovarianceStamped> pose_;
  transport::Publisher<tf2_msgs::TFMessage> transforms_;
  transport::Publisher<docent_msgs::PersonBeams> person_beams_;
  motion_models::UnbrokenOdometry unbroken_;
  motion_models::OdometryHistory odometry_;
  bool has_jumped_ = false;        ///< since the last belief: others carry that one by an odometry that is torn
  std::optional<Pose2> restored_;  ///< odometry of the checkpoint, until odometry speaks
  localization::Localizer::Step last_step_;
  Time odometry_received_{};
  Time sonar_received_{};
  Time belief_published_{};
  Time saved_{};
};

}  // namespace

Result<std::unique_ptr<Module>> make_localize(const ModuleContext& context) {
  auto params = context.config.section<LocalizeParams>("localize");
  if (!params) return tl::unexpected<Error>(params.error());
  context.config.amend(params->markov);
  context.config.amend(params->sonar.beside);
  if (params->method == "sonar") return make_sonar_localize(context, params->sonar.alone);
  auto module = std::make_unique<LocalizeModule>(context, *params);
  return module;
}

Result<std::string> simd_of_localize(const robot::RobotConfig& config) {
  auto params = config.section<LocalizeParams>("localize");
  if (!params) return tl::unexpected<Error>(params.error());
  return instruction_set_of(params->markov.simd).map([](InstructionSet set) { return std::string{name_of(set)}; });
}

Result<robot::ParameterRows> parameters_of_localize(const robot::RobotConfig& config) {
  return robot::list_parameters<LocalizeParams>(config, "localize");
}

}  // namespace docent::modules
