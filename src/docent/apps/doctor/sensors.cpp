#include "docent/apps/doctor/sensors.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>

#include "docent/messages/conversions.h"
#include "docent/transport/create3_support.h"

namespace docent::apps::doctor_command {
namespace {

// What the robot's modules want (docs/connect-your-robot.md, section 1).
constexpr StreamDemand kScanDemand{.least_hz = 5.0, .silent_s = 0.5, .oldest_s = 0.2};
constexpr StreamDemand kOdometryDemand{.least_hz = 10.0, .silent_s = 0.5, .oldest_s = 0.2};
constexpr StreamDemand kRingDemand{.least_hz = 2.0, .silent_s = 1.5, .oldest_s = 0.5};
constexpr StreamDemand kTactileDemand{.least_hz = 2.0, .silent_s = 0.8, .oldest_s = 0.5};
constexpr StreamDemand kBatteryDemand{.least_hz = 0.1, .silent_s = 10.0, .oldest_s = 5.0, .is_required = false};
constexpr StreamDemand kDockDemand{.least_hz = 0.2, .silent_s = 5.0, .oldest_s = 5.0};

constexpr double kCreeps = 0.35;         // share of beams without a reading
constexpr double kStands = 0.9;          // likewise
constexpr double kMillimetres = 60.0;    // [m] no hall's median reading is so long
constexpr double kTurned = 1.5;          // [deg] between two words on one mount
constexpr double kMoved = 0.03;          // [m]
constexpr double kOtherField = 0.1;      // share of the field
constexpr double kStandingStill = 0.02;  // [m/s]

void add(Finding& finding, Verdict verdict, const std::string& what) {
  finding.verdict = std::max(finding.verdict, verdict);
  finding.text += (finding.text.empty() ? "" : "; ") + what;
}

}  // namespace

Sensors::Sensors(transport::Bus& bus, const robot::RobotBody& body, const BaseKind& kind)
    : bus_{bus}, body_{body}, kind_{kind}, scans_(body.scanners.size()), readers_{body_} {
  listen();
  if (kind_.is_create3 || kind_.docks_by_action) listen_to_create3();
}

void Sensors::listen() {
  for (std::size_t i = 0; i < body_.scanners.size(); ++i)
    bus_.subscribe<sensor_msgs::LaserScan>(topics::scan_topic(body_.scanners[i].name),
                                           [this, i](const sensor_msgs::LaserScan& scan) { hear_scan(i, scan); });
  bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry, [this](const nav_msgs::Odometry& odometry) {
    odometry_.hear(from_message(odometry.header.stamp), bus_.now(), odometry.header.frame_id);
    fastest_ = std::max(fastest_, std::abs(odometry.twist.twist.linear.x));
    last_odometry_ = odometry;
  });
  bus_.subscribe<sensor_msgs::BatteryState>(topics::kBattery, [this](const sensor_msgs::BatteryState& battery) {
    battery_.hear(from_message(battery.header.stamp), bus_.now(), battery.header.frame_id);
    last_battery_ = battery;
  });
  bus_.subscribe<sensor_msgs::Range>(topics::kSonar, [this](const sensor_msgs::Range& range) {
    sonars_[range.header.frame_id].hear(from_message(range.header.stamp), bus_.now(), range.header.frame_id);
  });
  bus_.subscribe<sensor_msgs::Range>(topics::kInfrared, [this](const sensor_msgs::Range& range) {
    infrareds_[range.header.frame_id].hear(from_message(range.header.stamp), bus_.now(), range.header.frame_id);
  });
  bus_.subscribe<docent_msgs::Tactile>(topics::kTactile, [this](const docent_msgs::Tactile& tactile) {
    tactile_.hear(from_message(tactile.header.stamp), bus_.now(), tactile.header.frame_id);
  });
  bus_.subscribe<tf2_msgs::TFMessage>(topics::kStaticTransforms, [this](const tf2_msgs::TFMessage& transforms) {
    for (const auto& transform : transforms.transforms) frames_.add_static(transform);
    has_transforms_ = has_transforms_ || !transforms.transforms.empty();
  });
  bus_.subscribe<tf2_msgs::TFMessage>(topics::kTransforms, [this](const tf2_msgs::TFMessage& transforms) {
    for (const auto& transform : transforms.transforms) frames_.add_moving(transform);
  });
  bus_.subscribe<docent_msgs::Health>(
      topics::kHealth, [this](const docent_msgs::Health& health) { modules_[health.module] = health.state; });
}

void Sensors::listen_to_create3() {
  bus_.subscribe<irobot_create_msgs::HazardDetectionVector>(topics::kHazards, [this](const auto& hazards) {
    hazards_.hear(from_message(hazards.header.stamp), bus_.now(), hazards.header.frame_id);
  });
  bus_.subscribe<irobot_create_msgs::DockStatus>(topics::kDockStatus, [this](const auto& dock) {
    dock_.hear(from_message(dock.header.stamp), bus_.now(), dock.header.frame_id);
  });
}

void Sensors::hear_scan(std::size_t i, const sensor_msgs::LaserScan& written) {
  Scan& scan = scans_[i];
  scan.watch.hear(from_message(written.header.stamp), bus_.now(), written.header.frame_id);
  scan.newest = written;
  const sensor_msgs::LaserScan read = readers_.read(i, written);
  std::vector<float> returned;
  std::size_t failed = 0;
  for (const float range : read.ranges) {
    if (std::isnan(range))
      ++failed;
    else if (range < read.range_max)
      returned.push_back(range);
  }
  const std::size_t own =
      static_cast<std::size_t>(std::count(readers_.own_body(i).begin(), readers_.own_body(i).end(), true));
  scan.failed_share = read.ranges.empty() ? 1.0
                                          : static_cast<double>(failed - std::min(failed, own)) /
                                                static_cast<double>(read.ranges.size());
  if (returned.empty()) {
    scan.median = 0.0;
    return;
  }
  const auto middle = returned.begin() + static_cast<std::ptrdiff_t>(returned.size() / 2);
  std::nth_element(returned.begin(), middle, returned.end());
  scan.median = static_cast<double>(*middle);
}

void Sensors::judge_mount(Finding& finding, const robot::Scanner& scanner) const {
  const auto told = frames_.mount_of(recording::plain_frame(scanner.frame), "base_link");  // or base_footprint
  const auto shown = [](const Pose2& mount, bool hangs) {
    return text_of("x %.2f, y %.2f, heading %.1f%s", mount.x, mount.y, mount.theta.degrees(),
                   hangs ? ", upside down" : "");
  };
  if (!scanner.has_mount) {
    if (told)
      add(finding, Verdict::fine, "/tf_static has it at " + shown(told->base_from_sensor, told->is_upside_down));
    else
      add(finding, Verdict::wrong,
          "robot.yaml says no x, y and heading, and no /tf_static says where '" + scanner.frame + "' is on base_link");
    return;
  }
  if (!told) return;
  const Pose2 said = scanner.base_from_sensor();
  const double apart = distance(said.position(), told->base_from_sensor.position());
  const double turned = std::abs((said.theta - told->base_from_sensor.theta).degrees());
  if (apart > kMoved || turned > kTurned || told->is_upside_down != scanner.upside_down)
    add(finding, Verdict::wrong,
        "/tf_static has it at " + shown(told->base_from_sensor, told->is_upside_down) + ", robot.yaml at " +
            shown(said, scanner.upside_down));
}

void Sensors::judge_scans(std::vector<Finding>& all, Time begin) {
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    const Scan& scan = scans_[i];
    const robot::Scanner& scanner = body_.scanners[i];
    const auto& topic = topics::scan_topic(scanner.name);
    Finding finding = scan.watch.judge("scanner " + scanner.name, kScanDemand, writers(topic), begin, bus_.now());
    if (scan.watch.count() > 0) {
      const double field = std::abs(static_cast<double>(scan.newest.angle_increment)) *
                           static_cast<double>(scan.newest.ranges.size()) * 180.0 / std::numbers::pi;
      add(finding, Verdict::fine, text_of("%zu beams over %.0f degrees", scan.newest.ranges.size(), field));
      if (scan.median > kMillimetres)
        add(finding, Verdict::wrong, text_of("its readings (median %.0f) look like millimetres", scan.median));
      if (scan.failed_share > kCreeps)
        add(finding, scan.failed_share > kStands ? Verdict::wrong : Verdict::note,
            text_of("%.0f %% of its beams have no reading: the robot %s", 100.0 * scan.failed_share,
                    scan.failed_share > kStands ? "stands" : "creeps"));
      if (scan.median == 0.0) add(finding, Verdict::wrong, "nothing comes back");
      if (std::abs(field - scanner.field) > kOtherField * scanner.field)
        add(finding, Verdict::note, text_of("robot.yaml says a field of %.0f degrees", scanner.field));
      if (scan.newest.header.frame_id != scanner.frame)
        add(finding, Verdict::note,
            "its frame is '" + scan.newest.header.frame_id + "', robot.yaml says '" + scanner.frame +
                "': rviz2 goes by it");
      const auto& own = readers_.own_body(i);
      if (const auto beams = std::count(own.begin(), own.end(), true); beams > 0)
        add(finding, Verdict::fine,
            text_of("%ld beams see the robot itself and are left out", static_cast<long>(beams)));
      judge_mount(finding, scanner);
      finding.figures.emplace_back("no_reading_share", scan.failed_share);
      finding.figures.emplace_back("median_m", scan.median);
    }
    all.push_back(std::move(finding));
  }
  if (const std::string notes = readers_.notes(); !notes.empty())
    all.push_back({"base", "scanners", Verdict::note, notes});
}

void Sensors::judge_odometry(std::vector<Finding>& all, Time begin) {
  Finding finding = odometry_.judge("odom", kOdometryDemand, writers(topics::kOdometry), begin, bus_.now());
  if (odometry_.count() > 0) {
    add(finding, Verdict::fine,
        fastest_ < kStandingStill ? "it stands" : text_of("it moves, up to %.2f m/s", fastest_));
    if (fastest_ > 1.5 * body_.max_speed)
      add(finding, Verdict::wrong, text_of("faster than body.max_speed (%.2f m/s): other units?", body_.max_speed));
    finding.figures.emplace_back("fastest_m_s", fastest_);
  } else if (!has_transforms_) {
    add(finding, Verdict::fine, "a transform odom -> base_link on /tf would do");
  }
  all.push_back(std::move(finding));
}

void Sensors::judge_ring(std::vector<Finding>& all, const std::string& name, int wanted,
                         const std::map<std::string, StreamWatch>& heard, const transport::TopicInfo& topic,
                         const StreamDemand& demand, Time begin) {
  if (wanted == 0) {
    if (!heard.empty())
      all.push_back({"base", name, Verdict::note, "they speak, and robot.yaml says that there are none"});
    return;
  }
  int known = 0;
  int slow = 0;
  std::string strangers;
  for (const auto& [frame, watch] : heard) {
    const bool is_known = name == "sonars" ? body_.sonar_of(frame).has_value() : body_.infrared_of(frame).has_value();
    known += is_known ? 1 : 0;
    if (!is_known) strangers += " " + frame;
    if (is_known && watch.longest_pause_s(begin, bus_.now()) > demand.silent_s) ++slow;
  }
  Finding finding{"base", name, Verdict::fine, text_of("%d of %d speak", known, wanted)};
  if (known == 0) {
    finding.verdict = Verdict::wrong;
    if (bus_.other_writers(topic) == 0) finding.text = "nobody publishes " + std::string{topic.name};
  } else if (known < wanted) {
    finding.verdict = Verdict::note;
  }
  if (slow > 0) add(finding, Verdict::note, std::to_string(slow) + " of them fall silent at times");
  if (!strangers.empty()) add(finding, Verdict::note, "frames that robot.yaml does not know:" + strangers);
  finding.figures = {{"speak", known}, {"wanted", wanted}};
  all.push_back(std::move(finding));
}

void Sensors::judge_battery(std::vector<Finding>& all, Time begin) {
  Finding finding = battery_.judge("battery", kBatteryDemand, writers(topics::kBattery), begin, bus_.now());
  if (battery_.count() > 0) {
    const double share = static_cast<double>(last_battery_.percentage);
    add(finding, Verdict::fine, text_of("%.0f %%", 100.0 * share));
    if (share <= 0.15) add(finding, Verdict::note, "low");
    if (last_battery_.power_supply_status == 0) add(finding, Verdict::note, "it does not say whether it charges");
    finding.figures.emplace_back("share", share);
  }
  all.push_back(std::move(finding));
}

void Sensors::judge_commands(std::vector<Finding>& all) {
  const int others = writers(topics::kCommandVelocity) - (modules_.contains("robot") ? 1 : 0);
  Finding finding{"base", "cmd_vel", Verdict::fine, body_.stamped_commands ? "a TwistStamped" : "a Twist"};
  if (others > 0)
    add(finding, Verdict::wrong,
        std::to_string(others) + (others == 1 ? " other program commands" : " other programs command") + " the base");
  all.push_back(std::move(finding));
  if (robot_runs()) {
    const auto ready =
        std::count_if(modules_.begin(), modules_.end(), [](const auto& one) { return one.second == "ready"; });
    all.push_back({"base", "robot", Verdict::note,
                   text_of("a robot of Docent's runs in this domain: %ld of %zu modules are ready",
                           static_cast<long>(ready), modules_.size())});
  }
}

std::vector<Finding> Sensors::findings(Time begin) {
  std::vector<Finding> all;
  judge_odometry(all, begin);
  judge_scans(all, begin);
  judge_ring(all, "sonars", body_.sonars, sonars_, transport::topic_info(topics::kSonar), kRingDemand, begin);
  judge_ring(all, "infrareds", body_.infrareds, infrareds_, transport::topic_info(topics::kInfrared), kRingDemand,
             begin);
  if (kind_.is_create3)
    all.push_back(hazards_.judge("hazard_detection", kTactileDemand, writers(topics::kHazards), begin, bus_.now()));
  else if (body_.tactile)
    all.push_back(tactile_.judge("tactile", kTactileDemand, writers(topics::kTactile), begin, bus_.now()));
  if (kind_.docks_by_action) {
    all.push_back(dock_.judge("dock_status", kDockDemand, writers(topics::kDockStatus), begin, bus_.now()));
    const bool offers = writers(topics::kDockGoals) > 0 && writers(topics::kUndockGoals) > 0;
    all.push_back({"base", "dock, undock", offers ? Verdict::fine : Verdict::wrong,
                   offers ? "it offers both actions" : "the base offers no action /dock or no action /undock"});
  }
  judge_battery(all, begin);
  judge_commands(all);
  for (const auto& [topic, refused] : bus_.refusals())
    all.push_back(
        {"base", topic, Verdict::wrong, std::to_string(refused.count) + " messages refused: " + refused.last.text()});
  return all;
}

}  // namespace docent::apps::doctor_command
