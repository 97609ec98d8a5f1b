#include "docent/apps/simulate/simulation_run.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <variant>

#include "docent/apps/shared/deployment.h"
#include "docent/apps/shared/simulated_hardware.h"
#include "docent/apps/shared/temporary_folder.h"
#include "docent/apps/simulate/belief_fault.h"
#include "docent/apps/simulate/simulation_picture.h"
#include "docent/base/files.h"
#include "docent/evaluation/deployment_evaluator.h"
#include "docent/evaluation/run_logs/claim_log.h"
#include "docent/evaluation/run_logs/drive_log.h"
#include "docent/evaluation/run_logs/event_log.h"
#include "docent/evaluation/run_logs/health_log.h"
#include "docent/evaluation/run_logs/office_log.h"
#include "docent/evaluation/run_logs/people_log.h"
#include "docent/evaluation/run_logs/request_log.h"
#include "docent/evaluation/run_logs/thing_log.h"
#include "docent/messages/conversions.h"
#include "docent/modules/host/module_host.h"
#include "docent/modules/perception/localize_module.h"
#include "docent/museum/blank_museum.h"
#include "docent/museum/day_plan.h"
#include "docent/recording/recorder.h"
#include "docent/simulator/simulated_museum.h"
#include "docent/task_control/mission/mission_store.h"
#include "docent/task_control/travel_times/travel_times.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::apps::simulate_command {
namespace {

/// [s] that this process has had of the processor.
double computed_seconds() {
  timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

class SimulationRun::Parts {
 public:
  Parts(museum::Museum museum, robot::RobotConfig config, const SimulationRunOptions& options)
      : museum_{std::move(museum)}, config_{std::move(config)}, options_{options} {
    if (options.profile) hub_.measure_by(transport::VirtualTimeHub::processor_clock);
    hub_.tap([this](const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message) {
      const double start = hub_.cost_clock();
      evaluator_.add(topic, time, message);
      picture_.add(topic, message);
      if (!options_.claims.empty()) claims_.add(topic, time, message);
      if (!options_.health_log.empty()) health_.add(topic, time, message);
      if (!options_.drive_log.empty()) drive_.add(topic, time, message);
      if (!options_.event_log.empty()) events_.add(topic, time, message);
      if (!options_.request_log.empty()) requests_.add(topic, time, message);
      if (!options_.people_log.empty()) people_.add(topic, time, message);
      if (!options_.thing_log.empty()) things_.add(topic, time, message);
      if (!options_.office_log.empty()) office_.add(topic, time, message);
      if (recorder_ && failure_.empty()) {
        if (auto written = recorder_->write(topic, time, message); !written) failure_ = written.error().message;
      }
      evaluation_s_ += hub_.cost_clock() - start;
    });
  }

  Result<void> start() {
    if (options_.state.empty()) {
      state_ = temporary_.path();
    } else {
      state_ = options_.state;
      std::error_code code;
      std::filesystem::create_directories(state_, code);
    }
    if (state_.empty() || !std::filesystem::is_directory(state_))
      return fail("no folder for the state: " + options_.state);
    if (!options_.recording.empty()) {
      auto recorder = recording::Recorder::create(options_.recording);
      if (!recorder) return tl::unexpected<Error>(recorder.error());
      recorder_.emplace(std::move(*recorder));
    }
    if (auto started = start_operator(); !started) return started;
    if (auto started = start_world(); !started) return started;
    if (!options_.has_robot) return {};
    for (const modules::ModuleEntry& entry : modules::all_modules()) {
      const std::string name = entry.name;
      if (name == "record" || (name == "web" && !options_.hosts_web)) continue;
      if (!modules::runs(entry, options_.explore ? museum::SetupWork::map : museum::SetupWork::guide)) continue;
      if (auto started = start_module(entry); !started) return started;
    }
    return {};
  }

  Result<void> run_until(Time end) {
    const auto start = std::chrono::steady_clock::now();
    const double computed = computed_seconds();
    hub_.run_until(end);
    cpu_s_ += computed_seconds() - computed;
    wall_s_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!failure_.empty()) return fail(failure_);
    return {};
  }

  [[nodiscard]] evaluation::RunCost cost() const {
    evaluation::RunCost result;
    result.wall_seconds = wall_s_;
    result.cpu_seconds = cpu_s_;
    for (const auto& [name, cost] : hub_.costs()) {
      if (cost.steps_ms.count() > 0) result.p99_ms[name] = cost.steps_ms.at(0.99);
    }
    return result;
  }

 private:
  friend class SimulationRun;

  /// What the mission has committed.
  Result<void> save_travel_times() const {
    auto store = task_control::MissionStore::open(state_ / "mission.sqlite", "none", false);
    if (!store) return tl::unexpected<Error>(store.error());
    const auto memory = store->load();
    if (!memory) return tl::unexpected<Error>(memory.error());
    return write_file_atomically(options_.travel_times, to_csv(task_control::travel_table(memory->lessons)));
  }

  /// Speed limit and mode, as the museum's staff would set them.
  Result<void> start_operator() {
    operator_bus_ = hub_.connect("operator");
    operator_bus_->subscribe<docent_msgs::Exploration>(topics::kExploration,
                                                       [this](const auto& state) { exploration_ = state; });
    docent_msgs::Limits limits;
    limits.mode = options_.mode;
    limits.max_speed = config_.body().max_speed;
    const auto mode = museum_.modes.find(options_.mode);
    if (mode != museum_.modes.end()) {
      limits.max_speed = std::min(limits.max_speed, mode->second.max_speed);
    } else if (options_.mode != "open" && options_.mode != "hours") {
      return fail("--mode " + options_.mode + ": the museum has no such mode" + museum::mode_meant(options_.mode));
    }
    if (options_.max_speed) limits.max_speed = std::min(config_.body().max_speed, *options_.max_speed);
    operator_bus_->publisher(topics::kLimits).publish(limits);
    return {};
  }

  Result<void> start_world() {
    if (!museum_.simulation_path) return fail(museum_.folder.string() + ": the museum has no simulation.yaml");
    auto world = simulator::load_world(*museum_.simulation_path);
    if (!world) return tl::unexpected<Error>(world.error());
    simulator::SimulationOptions options;
    options.world = std::move(*world);
    options.hardware = simulated_hardware(config_.body());
    options.seed = options_.seed;
    options.crowd = options_.crowd;
    options.crowd_count = options_.people;
    options.bodies = simulator::bodies_of(options_.bodies);
    if (!options.bodies) return fail("--bodies " + options_.bodies + ": legs or discs");
    options.heedless = options_.heedless;
    options.start = options_.explore ? options_.explore : options_.start;
    // Sonars alone find no place from nowhere.
    if (!options.start && config_.body().scanners.empty()) options.start = museum_.home;
    if (options_.start && !contains(museum_.area, options_.start->position())) {
      return fail("--start: outside the area in which the robot may be");
    }
    options.requests_per_hour = options_.requests_per_hour;
    auto eyes = simulated_eyes(config_);
    if (!eyes) return tl::unexpected<Error>(eyes.error());
    const bool shows = options_.hosts_web || !options_.camera_pictures.empty();
    if (shows || eyes->up || eyes->depth || eyes->front)
      options.cameras = simulator::CameraOptions{.for_people = shows, .eyes = *eyes};
    if (museum_.charger) options.charger = museum_.charger->position();
    auto contacts = simulator::load_contacts(*museum_.simulation_path);
    if (!contacts) return tl::unexpected<Error>(contacts.error());
    options.contacts = std::move(*contacts);
    options.run_info.museum = museum_.folder.filename().string();
    options.run_info.mode = options_.mode;
    options.run_info.config_hash = config_.hash();
    auto simd = modules::simd_of_localize(config_);
    if (!simd) return tl::unexpected<Error>(simd.error());
    options.run_info.simd = *simd;
    options.run_info.crippled = options_.robot_maker->crippled();
    if (!options_.scenario.empty()) {
      auto scenario = simulator::load_scenario(options_.scenario);
      if (!scenario) return tl::unexpected<Error>(scenario.error());
      if (auto built = build_wrongly(options.hardware, scenario->build); !built) return built;
      if (options.start) options.start = *options.start * scenario->build.start;
      const bool alters_belief = std::any_of(scenario->events.begin(), scenario->events.end(), [](const auto& event) {
        return std::holds_alternative<simulator::PoseError>(event.what) ||
               std::holds_alternative<simulator::SecondMode>(event.what);
      });
      if (alters_belief) alter_belief();
      watch_things(*scenario);
      options.scenario = std::move(*scenario);
      options.application = [this](const auto& event) {
        std::visit([this](const auto& what) { this->carry_out(what); }, event);
      };
    }
    if (auto valid = validate(options); !valid) return valid;
    if (!options_.camera_pictures.empty()) keep_pictures();
    world_robot_bus_ = hub_.connect("simulator");
    world_truth_bus_ = hub_.connect("simulator.truth");
    world_ = std::make_unique<simulator::SimulatedMuseum>(*world_robot_bus_, *world_truth_bus_, std::move(options));
    return {};
  }

  void watch_things(const simulator::Scenario& scenario) {
    std::vector<evaluation::WatchedThing> things;
    for (const auto& event : scenario.events)
      if (const auto* stool = std::get_if<simulator::Stool>(&event.what))
        things.push_back({stool->at, stool->radius, stool->duration});
    things_.watch(std::move(things), [&body = config_.body()](std::string_view frame) -> std::optional<Pose2> {
      for (const robot::Scanner& scanner : body.scanners)
        if (frame == "laser_" + scanner.name) return scanner.base_from_sensor();
      if (const auto sonar = body.sonar_of(std::string{frame})) return body.base_from_sonar(*sonar);
      if (const auto infrared = body.infrared_of(std::string{frame})) return body.base_from_infrared(*infrared);
      return std::nullopt;
    });
  }

  void keep_pictures() {
    for (const auto& [topic, name] :
         {std::pair{topics::kCamera, "robot.jpg"}, std::pair{topics::kSceneCamera, "scene.jpg"}}) {
      operator_bus_->subscribe<sensor_msgs::CompressedImage>(topic,
                                                             [this, name = std::string{name}](const auto& image) {
                                                               pictures_[name] = {image.data.begin(), image.data.end()};
                                                             });
    }
  }

  [[nodiscard]] Result<void> save_camera_pictures() const {
    std::filesystem::create_directories(options_.camera_pictures);
    for (const auto& [name, file] : pictures_) {
      auto saved = write_file_atomically(std::filesystem::path{options_.camera_pictures} / name, file);
      if (!saved) return saved;
    }
    return {};
  }

  Result<void> start_module(const modules::ModuleEntry& entry) {
    modules::ModuleHost::Options options;
    options.state = state_;
    options.cache = options_.cache;
    options.seed = options_.seed;
    options.virtual_time = true;
    options.day_begins = options_.day_begins;
    auto host = options_.robot_maker->make(entry, hub_.connect(entry.name), museum_, config_, options);
    if (!host) return tl::unexpected<Error>(host.error());
    hosts_[entry.name] = std::move(*host);
    return {};
  }

  /// Faults of the belief strike between `localize` and its readers.
  void alter_belief() {
    hub_.alter(transport::topic_info(topics::kBelief), [this](Time now, std::shared_ptr<const void> message) {
      const auto& belief = *static_cast<const docent_msgs::Belief*>(message.get());
      return std::make_shared<docent_msgs::Belief>(belief_fault_.apply(belief, now));
    });
  }

  void carry_out(const simulator::PoseError& event) { belief_fault_.strike(event, hub_.now()); }
  void carry_out(const simulator::SecondMode& event) { belief_fault_.strike(event, hub_.now()); }
  /// A killed module is gone at once and back a second later, as its process would be; a stopped one is gone for the
  /// time of the stop.
  void carry_out(const simulator::Kill& kill) {
    operator_bus_->post([this, kill] {
      const modules::ModuleEntry* entry = modules::find_module(kill.module);
      const auto host = hosts_.find(kill.module);
      if (entry == nullptr || host == hosts_.end()) {
        failure_ = "scenario: no module '" + kill.module + "' to kill";
        return;
      }
      hosts_.erase(host);
      operator_bus_->after(seconds(kill.signal == "stop" ? kill.duration : 1.0), [this, entry] {
        if (auto started = start_module(*entry); !started) failure_ = started.error().message;
      });
    });
  }

  museum::Museum museum_;
  robot::RobotConfig config_;
  SimulationRunOptions options_;
  TemporaryFolder temporary_;
  std::filesystem::path state_;
  transport::VirtualTimeHub hub_;
  evaluation::DeploymentEvaluator evaluator_;
  evaluation::ClaimLog claims_;
  evaluation::HealthLog health_;
  evaluation::DriveLog drive_;
  BeliefFault belief_fault_;
  evaluation::EventLog events_;
  evaluation::RequestLog requests_;
  evaluation::PeopleLog people_;
  evaluation::ThingLog things_;
  evaluation::OfficeLog office_;
  SimulationPicture picture_;
  std::map<std::string, std::string> pictures_;  ///< of the cameras, by file name
  std::optional<recording::Recorder> recorder_;
  std::string failure_;
  std::optional<docent_msgs::Exploration> exploration_;
  double wall_s_ = 0.0;
  double cpu_s_ = 0.0;
  double evaluation_s_ = 0.0;
  std::unique_ptr<transport::Bus> operator_bus_;
  std::unique_ptr<transport::Bus> world_robot_bus_;
  std::unique_ptr<transport::Bus> world_truth_bus_;
  std::unique_ptr<simulator::SimulatedMuseum> world_;
  std::map<std::string, std::unique_ptr<modules::ModuleHost>, std::less<>> hosts_;
};

SimulationRun::SimulationRun(std::unique_ptr<Parts> parts) : parts_{std::move(parts)} {}
SimulationRun::~SimulationRun() = default;

Result<std::unique_ptr<SimulationRun>> SimulationRun::create(const SimulationRunOptions& options) {
  Deployment deployment;
  deployment.museum = options.museum;
  deployment.robot = options.robot;
  deployment.settings = options.settings;
  auto museum = deployment.load();
  if (!museum) return tl::unexpected<Error>(museum.error());
  auto config = deployment.load_config(options.robot_maker->sections());
  if (!config) return tl::unexpected<Error>(config.error());
  if (auto read = options.robot_maker->read(*config); !read) return tl::unexpected<Error>(read.error());
  if (options.explore) *museum = museum::without_map(*museum, *options.explore);
  auto parts = std::make_unique<Parts>(std::move(*museum), std::move(*config), options);
  if (auto started = parts->start(); !started) return tl::unexpected<Error>(started.error());
  return std::unique_ptr<SimulationRun>{new SimulationRun{std::move(parts)}};
}

Result<void> SimulationRun::run_until(Time end) { return parts_->run_until(end); }
Time SimulationRun::now() const { return parts_->hub_.now(); }
std::optional<docent_msgs::Exploration> SimulationRun::exploration() const { return parts_->exploration_; }
std::string SimulationRun::report_json() const {
  return evaluation::to_json(parts_->evaluator_.report(), parts_->cost());
}
std::string SimulationRun::summary() const {
  return evaluation::summary_table(parts_->evaluator_.report(), parts_->cost());
}
std::string SimulationRun::status() const {
  const evaluation::DeploymentReport report = parts_->evaluator_.report();
  char text[160];
  std::snprintf(text, sizeof text, "%.2f km, %d explained, %d of %d requests, %d contacts", report.distance_m / 1000.0,
                report.exhibits_explained, report.requests.fulfilled, report.requests.offered, report.contacts.all());
  return text;
}

evaluation::RunCost SimulationRun::cost() const { return parts_->cost(); }

std::map<std::string, double> SimulationRun::seconds_by_module() const {
  std::map<std::string, double> seconds;
  double inside_taps = parts_->evaluation_s_;
  for (const auto& [name, cost] : parts_->hub_.costs()) seconds[name] = cost.total_s;
  seconds["evaluation and recording"] = inside_taps;
  return seconds;
}

Result<void> SimulationRun::finish() {
  if (!parts_->options_.claims.empty()) {
    if (auto saved = parts_->claims_.save(parts_->options_.claims); !saved) return saved;
  }
  if (!parts_->options_.health_log.empty()) {
    if (auto saved = parts_->health_.save(parts_->options_.health_log); !saved) return saved;
  }
  if (!parts_->options_.event_log.empty()) {
    if (auto saved = parts_->events_.save(parts_->options_.event_log); !saved) return saved;
  }
  if (!parts_->options_.request_log.empty()) {
    if (auto saved = parts_->requests_.save(parts_->options_.request_log); !saved) return saved;
  }
  if (!parts_->options_.travel_times.empty()) {
    if (auto saved = parts_->save_travel_times(); !saved) return saved;
  }
  if (!parts_->options_.drive_log.empty()) {
    if (auto saved = parts_->drive_.save(parts_->options_.drive_log); !saved) return saved;
  }
  if (!parts_->options_.thing_log.empty()) {
    if (auto saved = parts_->things_.save(parts_->options_.thing_log); !saved) return saved;
  }
  if (!parts_->options_.office_log.empty()) {
    if (auto saved = parts_->office_.save(parts_->options_.office_log); !saved) return saved;
  }
  if (!parts_->options_.people_log.empty()) {
    if (auto saved = parts_->people_.save(parts_->options_.people_log); !saved) return saved;
  }
  if (!parts_->options_.camera_pictures.empty()) {
    if (auto saved = parts_->save_camera_pictures(); !saved) return saved;
  }
  if (!parts_->recorder_) return {};
  return parts_->recorder_->close();
}

Result<void> SimulationRun::save_picture(const std::string& path) const {
  return parts_->picture_.save(parts_->museum_, path);
}

}  // namespace docent::apps::simulate_command
