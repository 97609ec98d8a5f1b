#include "docent/modules/perception/localize_module.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "docent/grid/occupancy_grid.h"
#include "docent/localization/judgement/hindrance.h"
#include "docent/localization/markov/markov_localizer.h"
#include "docent/localization/monte_carlo/monte_carlo_localizer.h"
#include "docent/localization/pose_watch/pose_watch.h"
#include "docent/localization/pose_watch/sensor_silence.h"
#include "docent/localization/sonar/evidence/sonar_evidence.h"
#include "docent/messages/conversions.h"
#include "docent/modules/perception/belief_messages.h"
#include "docent/modules/perception/sonar_localize.h"
#include "docent/modules/shared/initial_pose.h"
#include "docent/modules/shared/person_beams.h"
#include "docent/modules/shared/pose_tracker.h"
#include "docent/modules/shared/scanners.h"
#include "docent/modules/shared/sensor_time.h"

namespace docent::modules {
namespace {

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
  // Hazards are floor as well: somebody may have drawn one round the robot. Where it may drive is for others to say.
  const localization::FloorMap map{context.museum.map};
  if (params.method == "particles")
    return with_sonars(
        std::make_unique<localization::MonteCarloLocalizer>(map, params.markov, params.particles, cache, context.seed),
        context, params);
  return with_sonars(std::make_unique<localization::MarkovLocalizer>(map, params.markov, cache, context.seed), context,
                     params);
}

std::vector<std::string> names_of_scans(const robot::RobotBody& body) {
  std::vector<std::string> names;
  for (const robot::Scanner& scanner : body.scanners) names.push_back(body.topic_of(scanner));
  return names;
}

class LocalizeModule final : public Module {
 public:
  LocalizeModule(const ModuleContext& context, const LocalizeParams& params)
      : LocalizeModule{context, params, make_believer(context, params)} {}

  [[nodiscard]] ModuleHealth health() const override {
    const Time now = bus_.now();
    if (odometry_silence_.first_silent(now)) return {"degraded", "no odom"};
    if (body_.scanners.empty()) return {"degraded", "body.scanners is empty: nothing tells where I am"};
    if (const auto scan = scan_silence_.first_silent(now)) return {"degraded", "no " + *scan};
    const std::string notes = scanners_->notes();
    if (!watch_.is_localized()) {
      std::string reason = localization::hindrance_of(watch_.verdict().doubt(), params_.markov.verdict);
      if (reason.empty())
        reason = "it may be elsewhere by " + std::to_string(std::lround(100.0 * watch_.verdict().p_lost())) + " %";
      for (const std::string& more : {scanners_->hindrances(), notes}) reason += more.empty() ? "" : "; " + more;
      return {"degraded", "I do not know where I am: " + reason};
    }
    if (ModuleHealth sonars = sonars_ ? health_of_sonars(now) : ModuleHealth{}; !sonars.reason.empty()) return sonars;
    return {"ready", notes};
  }

 private:
  LocalizeModule(const ModuleContext& context, const LocalizeParams& params, Believer believer)
      : bus_{context.bus},
        params_{params},
        body_{context.config.body()},
        map_hash_{map_hash(context.museum.map)},
        watch_{std::move(believer.localizer),
               mounts_of(body_.scanners),
               localization::CheckpointKeeper{context.state / "localize.yaml", map_hash_},
               {params.people, params.markov.sensor.max_range, params.person_range, reach_of(body_)},
               bus_.now()},
        sonars_{std::move(believer.sonars)},
        odometry_silence_{{"odom"}, kSilent},
        scan_silence_{names_of_scans(body_), kSilent},
        sonar_silence_{{"sonar"}, kSilent},
        belief_{bus_.publisher(topics::kBelief)},
        pose_{bus_.publisher(topics::kPose)},
        transforms_{bus_.publisher(topics::kTransforms)},
        person_beams_{bus_.publisher(topics::kPersonBeams)} {
    publish_belief(watch_.start(bus_.now()));
    bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry, [this](const auto& odometry) {
      odometry_silence_.hear(0, bus_.now());
      watch_.move(sensor_time_.of(odometry), from_message(odometry.pose.pose));
      look_if_due();
    });
    scanners_ = subscribe_scanners(bus_, body_, [this](std::size_t i, const auto& scan, const auto& place) {
      watch_.mount(i, place.base_from_sensor);
      on_scan(i, scan, place);
    });
    if (sonars_) bus_.subscribe<sensor_msgs::Range>(topics::kSonar, [this](const auto& range) { on_sonar(range); });
    bus_.subscribe<docent_msgs::AvoidState>(topics::kAvoidState,
                                            [this, heard = std::optional<std::uint32_t>{}](const auto& state) mutable {
                                              // A count that falls, or is heard first, is no news: one of us has begun
                                              // anew.
                                              if (heard && state.carried_off > *heard) watch_.uproot();
                                              heard = state.carried_off;
                                            });
    bus_.subscribe<docent_msgs::PoseFix>(topics::kPoseFix, [this](const auto& fix) {
      const bool is_whole = fix.header.frame_id == "map" && fix.p_wrong >= 0.0 && fix.p_wrong <= 1.0 &&
                            fix.covariance[0] > 0.0 && fix.covariance[4] > 0.0 && fix.covariance[8] > 0.0;
      if (!is_whole) return;  // of another program, and no fix
      watch_.take_fix(
          {{fix.x, fix.y, Angle::radians(fix.theta)}, fix.covariance, {}, from_message(fix.header.stamp), fix.p_wrong});
    });
    subscribe_initial_pose(bus_, context.museum.map, [this](const localization::BeliefMode& mode, Time stamp) {
      return start_where_told(mode, stamp);
    });
  }

  [[nodiscard]] ModuleHealth health_of_sonars(Time now) const {
    if (sonar_silence_.first_silent(now)) return {"degraded", "no sonar"};
    switch (sonars_->trust().state()) {
      case localization::SonarTrust::State::frozen:
        return {"degraded", "sonar is frozen"};
      case localization::SonarTrust::State::at_odds:
        return {"degraded", "sonar hears nothing of what the map holds"};
      case localization::SonarTrust::State::well:
        break;
    }
    return {};
  }

  void on_scan(std::size_t laser, const sensor_msgs::LaserScan& scan, const ScannerPlace& place) {
    scan_silence_.hear(laser, bus_.now());
    watch_.see(
        laser, sensor_time_.of(laser, scan, place),
        {scan.ranges, Angle::radians(static_cast<double>(scan.angle_min)), static_cast<double>(scan.angle_increment),
         static_cast<double>(scan.range_min), static_cast<double>(scan.range_max)},
        bus_.now());
    // Behind all scans that have come with this one: a look takes the newest, and queues none.
    bus_.post([this] {
      if (watch_.awaits_odometry()) bus_.after(localization::PoseWatch::kOdometryPatience, [this] { look_if_due(); });
      look_if_due();
    });
  }

  void look_if_due() {
    if (watch_.is_look_due(bus_.now())) look();
  }

  void on_sonar(const sensor_msgs::Range& range) {
    const auto index = body_.sonar_of(range.header.frame_id);
    if (!index) return;
    sonar_silence_.hear(0, bus_.now());
    const Time stamp = sensor_time_.of("sonars", range.header);
    const auto odom_from_base = watch_.odom_from_base_at(stamp);
    if (!odom_from_base) return;
    sonars_->hear({stamp, *index, body_.base_from_sonar(*index), *odom_from_base, static_cast<double>(range.range),
                   static_cast<double>(range.max_range)});
  }

  void look() {
    const auto look = watch_.look(bus_.now());
    if (!look) return;
    const localization::PoseWatch::Moment& moment = look->moment;
    if (look->is_belief_due) publish_belief(moment);
    publish_person_beams(*look);
    if (watch_.is_localized()) transforms_.publish(odom_in_map_message(watch_.map_from_raw(moment), moment.stamp));
    if (look->is_pose_due) pose_.publish(pose_message(watch_.best_mode(), moment.stamp));
  }

  /// Somebody says where the robot stood at `stamp`.
  MessageFault start_where_told(const localization::BeliefMode& mode, Time stamp) {
    const auto moment = watch_.start_where_told(mode, stamp);
    if (!moment) return {"pose", "came before any odometry"};
    publish_belief(*moment);
    return {};
  }

  void publish_belief(const localization::PoseWatch::Moment& moment) {
    docent_msgs::Belief message = belief_message(watch_.tell_belief(moment, bus_.now()), moment.stamp);
    message.map_hash = map_hash_;
    message.cell_size = static_cast<float>(params_.markov.states.cell_size);
    message.heading_step = static_cast<float>(params_.markov.states.heading_step * std::numbers::pi / 180.0);
    add_verdict(message, watch_.verdict());
    message.localized = watch_.is_localized();
    message.beams_used = static_cast<std::uint32_t>(watch_.last_update().beams_used);
    message.beams_filtered = static_cast<std::uint32_t>(watch_.last_update().beams_filtered);
    message.odom_pose = docent::to_message(watch_.raw_from_base(moment));
    belief_.publish(std::move(message));
  }

  void publish_person_beams(const localization::PoseWatch::Look& look) {
    const auto beams = watch_.beams(look);
    person_beams_.publish(
        person_beams_message({look.moment.stamp, watch_.is_localized(), watch_.map_from_base(look.moment),
                              look.moment.odom_from_base, look.sweep, beams.origins, beams.ends}));
  }

  transport::Bus& bus_;
  LocalizeParams params_;
  robot::RobotBody body_;
  std::string map_hash_;
  localization::PoseWatch watch_;
  std::shared_ptr<localization::SonarEvidence> sonars_;  ///< beside the lasers; null: they take no part
  std::shared_ptr<const ScannerReaders> scanners_;
  SensorTime sensor_time_{bus_};
  localization::SensorSilence odometry_silence_;
  localization::SensorSilence scan_silence_;
  localization::SensorSilence sonar_silence_;
  transport::Publisher<docent_msgs::Belief> belief_;
  transport::Publisher<geometry_msgs::PoseWithCovarianceStamped> pose_;
  transport::Publisher<tf2_msgs::TFMessage> transforms_;
  transport::Publisher<docent_msgs::PersonBeams> person_beams_;
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
