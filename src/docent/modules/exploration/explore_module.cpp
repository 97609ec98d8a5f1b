#include "docent/modules/exploration/explore_module.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "docent/base/files.h"
#include "docent/localization/belief/checkpoint.h"
#include "docent/mapping/graph_mapping/graph_mapping.h"
#include "docent/mapping/occupancy/stray_floor.h"
#include "docent/modules/exploration/exploration_drive.h"
#include "docent/modules/exploration/keyframes.h"
#include "docent/modules/exploration/people_seen.h"
#include "docent/modules/shared/grid_message.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::modules {
namespace {

constexpr Duration kTargetPeriod = std::chrono::milliseconds{200};
constexpr Duration kPlanPeriod = std::chrono::seconds{1};
constexpr Duration kMapPeriod = std::chrono::seconds{2};
constexpr Duration kCheckpointAge = std::chrono::seconds{60};  // as localize takes one
constexpr double kCheckpointWay = 5.0;                         // [m] that odometry may have gone on meanwhile
constexpr const char* kMapHash = "exploration";
constexpr std::size_t kMomentsAPlan = 100;  // drawn anew in a second
constexpr std::size_t kMomentsAPiece = 20;  // of the way, some four metres: see ScanMapper::end_piece

/// Section `explore`.
struct ExploreParams {
  KeyframeParams keyframes;
  planning::ExplorerParams explorer;
  ExplorationDriveParams drive;
  mapping::GraphMapperParams mapping;
  /// Free is what two sweeps at least have passed: a single beam may have lost its echo.
  mapping::ScanMapperParams map{.reach = 12.0, .empty_reach = 5.0, .free = 0.25, .fewest_hits = 2};
  double least_sigma = 0.04;     ///< [m], > 0: the pose is never known better, nor
  double most_sigma = 0.08;      ///< [m]: believed to be worse: hazards that are marked would close the building
  double sigma_heading = 0.02;   ///< [rad], > 0
  double stray_floor = 0.5;      ///< [m2], >= 0: less free floor than that in one piece was seen by stray beams
  bool waits_for_order = false;  ///< stands until a technician says who drives
  template <class V>
  void visit(V& v) {
    v("keyframes", keyframes);
    v("explorer", explorer);
    v("drive", drive);
    v("mapping", mapping);
    v("map", map);
    v("least_sigma", least_sigma);
    v("most_sigma", most_sigma);
    v("sigma_heading", sigma_heading);
    v("stray_floor", stray_floor);
    v("waits_for_order", waits_for_order);
  }
  [[nodiscard]] Result<void> validate() const {
    if (!(least_sigma > 0.0 && least_sigma <= most_sigma)) return fail("0 < least_sigma <= most_sigma must hold");
    if (!(stray_floor >= 0.0)) return fail("stray_floor must be >= 0");
    if (!(sigma_heading > 0.0)) return fail("sigma_heading must be > 0");
    if (auto valid = keyframes.validate(); !valid) return fail("keyframes." + valid.error().message);
    if (auto valid = explorer.validate(); !valid) return fail("explorer." + valid.error().message);
    if (auto valid = drive.validate(); !valid) return fail("drive." + valid.error().message);
    if (auto valid = map.validate(); !valid) return fail("map." + valid.error().message);
    return {};
  }
};

/// [m2]
double free_area(const OccupancyGrid& map) {
  const auto cells = std::count(map.cells.begin(), map.cells.end(), OccupancyGrid::kFree);
  return static_cast<double>(cells) * map.frame.resolution * map.frame.resolution;
}

class ExploreModule final : public Module {
 public:
  ExploreModule(const ModuleContext& context, const ExploreParams& params)
      : bus_{context.bus},
        params_{params},
        folder_{context.state / "explored"},
        checkpoint_path_{context.state / "explore.yaml"},
        localizers_checkpoint_path_{context.state / "localize.yaml"},
        home_{context.museum.home},
        keyframes_{params.keyframes, params.mapping.points, context.config.body().scanners},
        mapping_{params.mapping},
        map_{params.map, context.config.body().radius},
        drive_{params.drive, planning::Explorer{params.explorer, context.museum.hazard_polygons(), context.museum.area},
               context.museum.home.position()},
        belief_{bus_.publisher(topics::kBelief)},
        target_{bus_.publisher(topics::kTarget)},
        static_map_{bus_.publisher(topics::kStaticMap)},
        path_{bus_.publisher(topics::kPath)},
        person_beams_{bus_.publisher(topics::kPersonBeams)},
        exploration_{bus_.publisher(topics::kExploration)},
        order_{params.waits_for_order ? ExplorationOrder::wait : ExplorationOrder::by_itself} {
    restore();
    bus_.subscribe<docent_msgs::People>(topics::kPeopleInOdom, [this](const auto& people) { people_.note(people); });
    bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry,
                                       [this](const auto& odometry) { pose_.on_odometry(odometry); });
    subscribe_scanners(bus_, context.config.body(), [this](std::size_t i, const auto& scan) { see(i, scan); });
    bus_.subscribe<docent_msgs::Stop>(topics::kStop, [this](const auto& stop) { is_stopped_ = stop.is_stopped; });
    bus_.subscribe<docent_msgs::Steering>(topics::kSteering, [this](const auto&) { steered_ = bus_.now(); });
    bus_.subscribe<docent_msgs::ExplorationOrder>(
        topics::kExplorationOrder, [this](const auto& order) { obey(parse<ExplorationOrder>(order.order)); });
    bus_.every(kTargetPeriod, [this] { aim(); });
    bus_.every(kPlanPeriod, [this] { plan(); });
    bus_.every(kMapPeriod, [this] { publish_map(map_.map()); });
    publish_state();
  }

  [[nodiscard]] ModuleHealth health() const override {
    if (!fault_.empty()) return {"faulted", fault_};
    if (!pose_.odom_from_base()) return {"degraded", "no odometry"};
    if (!map_from_odom_) return {"starting", "no scan of all lasers yet"};
    return {};
  }

 private:
  [[nodiscard]] std::optional<Pose2> map_from_base() const {
    const auto odom_from_base = pose_.odom_from_base();
    if (!map_from_odom_ || !odom_from_base) return std::nullopt;
    return *map_from_odom_ * *odom_from_base;
  }

  void see(std::size_t laser, const sensor_msgs::LaserScan& scan) {
    keyframes_.keep(laser, scan);
    if (laser != 0 || is_done_) return;
    if (map_from_odom_) {
      if (const auto look = keyframes_.look(pose_)) person_beams_.publish(person_beams(*look, *map_from_odom_, grid_));
    }
    auto frame = keyframes_.take(pose_, people_.walkers());
    if (!frame) return;
    const Pose2 odom_from_base = frame->scan.odom_from_base;
    if (!start_from_odom_) start_from_odom_ = start_of(odom_from_base);
    frame->scan.odom_from_base = *start_from_odom_ * odom_from_base;
    if (last_odom_) way_m_ += distance(last_odom_->position(), odom_from_base.position());
    last_odom_ = odom_from_base;
    mapping_.add(std::move(frame->scan));
    const Pose2 map_from_base = mapping_.map_from_base().back();
    map_from_odom_ = map_from_base * inverse(odom_from_base);
    map_.add(std::move(frame->sweeps), map_from_base);
    publish_belief();
  }

  /// A normal distribution in few cells: all of it counts where hazards are kept off.
  void publish_belief() {
    const auto here = map_from_base();
    if (!here) return;
    const Time now = bus_.now();
    const mapping::GraphMapping::Spread spread = mapping_.spread();
    const double sigma = std::clamp(spread.position, params_.least_sigma, params_.most_sigma);
    docent_msgs::Belief belief;
    belief.header = {to_message(now), "map"};
    belief.map_hash = "exploration";
    belief.cell_size = static_cast<float>(sigma);
    belief.heading_step = static_cast<float>(params_.sigma_heading);
    constexpr int kSide = 2;  // cells, of one deviation each, to both sides
    double sum = 0.0;
    for (int i = -kSide; i <= kSide; ++i) {
      for (int j = -kSide; j <= kSide; ++j) {
        for (int k = -1; k <= 1; ++k) {
          const double mass = std::exp(-0.5 * static_cast<double>(i * i + j * j + k * k));
          sum += mass;
          belief.cells.push_back({static_cast<float>(here->x + i * sigma), static_cast<float>(here->y + j * sigma),
                                  static_cast<float>(here->theta.radians() + k * params_.sigma_heading),
                                  static_cast<float>(mass)});
        }
      }
    }
    for (auto& cell : belief.cells) cell.mass = static_cast<float>(cell.mass / sum);
    docent_msgs::Hypothesis best;
    best.x = here->x;
    best.y = here->y;
    best.theta = here->theta.radians();
    best.covariance = {sigma * sigma, 0, 0, 0, sigma * sigma, 0, 0, 0, params_.sigma_heading * params_.sigma_heading};
    best.mass = 1.0;
    belief.hypotheses.push_back(best);
    belief.p_lost = 0.0;
    belief.localized = true;
    belief.odom_pose = to_message(*pose_.odom_from_base());
    belief_.publish(std::move(belief));
  }

  /// Where it is in the frame of its map: where it was before this module began anew, or at its start.
  [[nodiscard]] Pose2 start_of(const Pose2& odom_from_base) const {
    if (!restored_ || distance(restored_->odom_from_robot.position(), odom_from_base.position()) > kCheckpointWay)
      return home_ * inverse(odom_from_base);
    return restored_->modes.front().map_from_robot * inverse(restored_->odom_from_robot);
  }

  /// Marks that people have made in the frame of the map hold as long as the frame does.
  void restore() {
    auto checkpoint = localization::load_localizer_checkpoint(checkpoint_path_);
    if (!checkpoint || checkpoint->map_hash != kMapHash || checkpoint->modes.empty()) return;
    if (bus_.now() - checkpoint->time <= kCheckpointAge && bus_.now() >= checkpoint->time) restored_ = *checkpoint;
  }

  /// For itself; and for localize, when it is to go on in the map that was made.
  void save_pose() const {
    const auto here = map_from_base();
    if (!here) return;
    localization::BeliefMode mode;
    mode.map_from_robot = *here;
    const double variance = params_.most_sigma * params_.most_sigma;
    mode.covariance = {variance, 0, 0, 0, variance, 0, 0, 0, params_.sigma_heading * params_.sigma_heading};
    mode.mass = 1.0;
    localization::LocalizerCheckpoint checkpoint{kMapHash, bus_.now(), *pose_.odom_from_base(), {mode}};
    // A checkpoint that cannot be written costs a search, nothing else.
    (void)localization::save_localizer_checkpoint(checkpoint, checkpoint_path_);
    if (finished_map_.empty()) return;
    checkpoint.map_hash = finished_map_;
    (void)localization::save_localizer_checkpoint(checkpoint, localizers_checkpoint_path_);
  }

  void obey(std::optional<ExplorationOrder> order) {
    if (!order || is_done_) return;
    order_ = *order;
    if (order_ == ExplorationOrder::finish && map_from_odom_) end();
    aim();
    publish_state();
  }

  /// No more is seen; when it stands, the map is made.
  void end() {
    is_done_ = true;
    aim();
    publish_state();
    bus_.after(seconds(1.0), [this] { finish(); });
  }

  void plan() {
    const auto here = map_from_base();
    save_pose();
    if (!here || is_done_) return;
    if (mapping_.revision() != revision_) {
      revision_ = mapping_.revision();
      map_.move(mapping_.map_from_base());
    }
    map_.work(kMomentsAPlan);
    constexpr Duration kAfterSteering = std::chrono::seconds{3};
    if (order_ == ExplorationOrder::finish) return end();
    const bool waits = is_stopped_ || (steered_ && bus_.now() - *steered_ < kAfterSteering);
    grid_ = map_.map();
    const OccupancyGrid& map = grid_;
    known_m2_ = free_area(map);
    if (order_ == ExplorationOrder::by_itself) {
      drive_.set_doubt(mapping_.doubt_of_marks());
      drive_.plan(map, here->position(), waits, bus_.now());
      if (drive_.state() == ExplorationDrive::State::arrived) end();
      publish_path();
    }
    publish_state();
  }

  void aim() {
    publish_belief();
    const Time now = bus_.now();
    docent_msgs::Target target;
    target.header = {to_message(now), "odom"};
    target.goal_id = "explore";
    target.mode = to_text(DriveMode::stop);
    target.position_tolerance = 0.1;
    const auto here = map_from_base();
    if (here && !is_done_ && order_ == ExplorationOrder::by_itself) {
      const auto ahead = drive_.ahead(here->position());
      if (!ahead.via.empty()) {
        const Pose2 odom_from_map = inverse(*map_from_odom_);
        target.mode = to_text(DriveMode::drive);
        target.is_final = ahead.is_final;
        for (const Point2 via : ahead.via) {
          const Point2 in_odom = odom_from_map * via;
          target.via_x.push_back(in_odom.x);
          target.via_y.push_back(in_odom.y);
        }
      }
    }
    target_.publish(std::move(target));
  }

  /// The map of all that was seen, once more from the best poses.
  void finish() {
    const mapping::GraphMap result = mapping_.finish();
    warning_ = result.judgement.is_trusted ? "" : result.judgement.reason;
    mapping::ScanMapperParams params = params_.map;
    params.fewest_hits = std::max(params.fewest_hits, 3);
    const auto placed = map_.placed(result.map_from_base);
    const auto frame = mapping::ScanMapper::frame_of(placed, params);
    if (!frame) {
      fault_ = frame.error().message;
      return;
    }
    mapping::ScanMapper mapper{*frame, params};
    const std::size_t piece = kMomentsAPiece * placed.size() / std::max<std::size_t>(1, map_.moments());
    for (std::size_t i = 0; i < placed.size(); ++i) {
      mapper.add(placed[i]);
      if ((i + 1) % piece == 0) mapper.end_piece();
    }
    mapper.end_piece();
    for (const Pose2& pose : result.map_from_base) mapper.stand(pose.position(), params_.explorer.robot_radius);
    OccupancyGrid map = mapper.map();
    mapping::forget_stray_floor(map, params_.stray_floor);
    if (auto saved = save(map, result.map_from_base); !saved) {
      fault_ = saved.error().message;
      return;
    }
    known_m2_ = free_area(map);
    unreached_ = drive_.explorer().unreached(map);
    file_ = (folder_ / "map.yaml").string();
    if (const auto written = load_map(file_)) finished_map_ = map_hash(*written);
    save_pose();
    publish_map(map);
    publish_state();
  }

  [[nodiscard]] Result<void> save(const OccupancyGrid& map, std::span<const Pose2> map_from_base) const {
    std::error_code code;
    std::filesystem::create_directories(folder_, code);
    if (code) return fail(folder_.string() + ": cannot be made: " + code.message());
    std::string text = "# x y theta: m, m, rad\n";
    for (const Pose2& pose : map_from_base) {
      text += std::to_string(pose.x) + " " + std::to_string(pose.y) + " " + std::to_string(pose.theta.radians()) + "\n";
    }
    if (auto saved = write_file_atomically(folder_ / "poses.txt", text); !saved) return saved;
    return save_map(map, folder_ / "map");
  }

  void publish_map(OccupancyGrid map) {
    if (map.cells.empty()) return;
    const Time now = bus_.now();
    static_map_.publish({{to_message(now), "map"}, info_of(map.frame, now), std::move(map.cells)});
  }

  void publish_path() {
    nav_msgs::Path path;
    path.header = {to_message(bus_.now()), "map"};
    for (const Point2& point : drive_.way())
      path.poses.push_back({path.header, to_message(Pose2{point.x, point.y, {}})});
    path_.publish(std::move(path));
  }

  [[nodiscard]] const char* state() const {
    if (!file_.empty()) return "done";
    if (is_done_) return "mapping";
    if (!map_from_odom_) return "starting";
    return drive_.state() == ExplorationDrive::State::returning ? "returning" : "exploring";
  }

  void publish_state() {
    docent_msgs::Exploration state;
    state.header = {to_message(bus_.now()), "map"};
    state.state = this->state();
    state.known_m2 = static_cast<float>(known_m2_);
    state.frontier = static_cast<std::uint32_t>(drive_.frontier());
    state.way_m = static_cast<float>(way_m_);
    state.loops = static_cast<std::uint32_t>(mapping_.loops());
    for (const auto& place : unreached_) {
      state.unreached_x.push_back(place.place.x);
      state.unreached_y.push_back(place.place.y);
    }
    state.map = file_;
    state.warning = warning_;
    state.order = to_text(order_);
    exploration_.publish(std::move(state));
  }

  transport::Bus& bus_;
  ExploreParams params_;
  std::filesystem::path folder_;
  std::filesystem::path checkpoint_path_, localizers_checkpoint_path_;
  Pose2 home_;
  Keyframes keyframes_;
  mapping::GraphMapping mapping_;
  mapping::GrowingMap map_;
  ExplorationDrive drive_;
  transport::Publisher<docent_msgs::Belief> belief_;
  transport::Publisher<docent_msgs::Target> target_;
  transport::Publisher<nav_msgs::OccupancyGrid> static_map_;
  transport::Publisher<nav_msgs::Path> path_;
  transport::Publisher<docent_msgs::PersonBeams> person_beams_;
  transport::Publisher<docent_msgs::Exploration> exploration_;
  ExplorationOrder order_;
  std::optional<localization::LocalizerCheckpoint> restored_;  ///< where it was before it began anew
  std::string finished_map_;                                   ///< its hash; empty: it is not made yet
  PeopleSeen people_;
  OccupancyGrid grid_;  ///< of a second ago at most
  PoseTracker pose_;
  std::optional<Pose2> start_from_odom_;
  std::optional<Pose2> map_from_odom_;
  std::optional<Pose2> last_odom_;
  std::size_t revision_ = 0;
  double way_m_ = 0.0;
  double known_m2_ = 0.0;
  bool is_stopped_ = false;
  std::optional<Time> steered_;
  bool is_done_ = false;
  std::string file_;
  std::string warning_;
  std::string fault_;  ///< why there is no map in the end
  std::vector<planning::Explorer::Unreached> unreached_;
};

}  // namespace

Result<std::unique_ptr<Module>> make_explore(const ModuleContext& context) {
  auto params = context.config.section<ExploreParams>("explore");
  if (!params) return tl::unexpected<Error>(params.error());
  params->explorer.robot_radius = std::max(params->explorer.robot_radius, context.config.body().radius);
  return std::make_unique<ExploreModule>(context, *params);
}

Result<robot::ParameterRows> parameters_of_explore(const robot::RobotConfig& config) {
  return robot::list_parameters<ExploreParams>(config, "explore");
}

}  // namespace docent::modules
