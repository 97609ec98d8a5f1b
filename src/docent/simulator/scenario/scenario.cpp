#include "docent/simulator/scenario/scenario.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "docent/base/yaml.h"

namespace docent::simulator {
namespace {

constexpr double kFar = 1e5, kLongest = 1e8;  // [m], [s]
constexpr std::array kFaults{"dead", "frozen", "half", "late", "short", "deaf", "storm"};
constexpr std::array kLies{"units",  "silent", "sector", "too_near", "blind_near",
                           "offset", "scaled", "stale",  "looped"};

/// [name, value] of an enumeration whose names stand in its order.
template <class T, std::size_t N>
std::vector<std::pair<std::string, T>> named(const std::array<const char*, N>& names) {
  std::vector<std::pair<std::string, T>> pairs;
  for (std::size_t i = 0; i < N; ++i) pairs.emplace_back(names[i], static_cast<T>(i));
  return pairs;
}

class EventReader {
 public:
  explicit EventReader(const YamlFile& file) : file_{file} {}

  ScenarioEvent read(const YAML::Node& node) {
    if (!node.IsMap()) fault(node, "expected an event {at: SECONDS, KIND: {...}}");
    ScenarioEvent event;
    std::string kind;
    YAML::Node body;
    bool has_time = false;
    std::optional<double> after;
    for (const auto& entry : node) {
      if (!entry.first.IsScalar()) fault(entry.first, "expected a plain key");
      const std::string& key = entry.first.Scalar();
      if (key == "at") {
        if (has_time) fault(entry.first, "key 'at' stands twice");
        has_time = true;
        event.at = number(entry.second, 0.0, kLongest);
      } else if (key == "during") {
        if (event.during) fault(entry.first, "key 'during' stands twice");
        event.during.emplace().phase = phase(entry.second);
      } else if (key == "after") {
        if (after) fault(entry.first, "key 'after' stands twice");
        after = number(entry.second, 0.0, kLongest);
      } else if (!kind.empty()) {
        fault(entry.first, "one kind an event: '" + kind + "' or '" + key + "'");
      } else {
        kind = key;
        body = entry.second;
        kind_at_ = entry.first;
      }
    }
    if (!has_time) fault(node, "missing key 'at'");
    if (kind.empty()) fault(node, "the event has no kind");
    if (after && !event.during) fault(node, "'after' needs 'during'");
    if (after) event.during->after = *after;
    event.what = content(kind, body);
    return event;
  }

 private:
  [[noreturn]] void fault(const YAML::Node& at, const std::string& what) const {
    throw YamlFault{file_.fault(at, what)};
  }

  decltype(ScenarioEvent::what) content(const std::string& kind, const YAML::Node& body) {
    if (kind == "kidnap") return kidnap(body);
    if (kind == "fault") return sensor_fault(body);
    if (kind == "stool") return stool(body);
    if (kind == "closed") return closed(body);
    if (kind == "pose_error") return pose_error(body);
    if (kind == "visitors") return visitors(body);
    if (kind == "pushers") return pushers(body);
    if (kind == "runners") return runners(body);
    if (kind == "escort") return escort(body);
    if (kind == "steering") return steering(body);
    if (kind == "lasers") return lasers(body);
    if (kind == "request") return wish(body);
    if (kind == "answers") return answers(body);
    if (kind == "battery") return battery(body);
    if (kind == "kill") return kill(body);
    if (kind == "second_mode") return second_mode(body);
    if (kind == "odometry_jump") return odometry_jump(body);
    if (kind == "lie") return scanner_lie(body);
    if (kind == "transport") return read_transport(file_, body);
    if (kind == "charger") return read_charger(file_, body);
    if (kind == "eye") return read_eye_fault(file_, body);
    if (kind == "office") return read_office_event(file_, body);
    fault(kind_at_, "unknown kind '" + kind +
                        "' (known: kidnap, fault, stool, closed, pose_error, visitors, pushers, runners, escort, "
                        "steering, lasers, request, answers, battery, kill, second_mode, odometry_jump, lie, "
                        "transport, charger, eye, office)");
  }

  [[nodiscard]] double number(const YAML::Node& node, double low, double high) const {
    double value = 0.0;
    if (!node.IsScalar()) fault(node, "expected a number");
    try {
      value = node.as<double>();
    } catch (const YAML::Exception&) {
      fault(node, "expected a number, found '" + node.Scalar() + "'");
    }
    check(node, value, low, high);
    return value;
  }
  void check(const YAML::Node& node, double value, double low, double high) const {
    if (!(value >= low && value <= high)) {
      fault(node, "expected a number from " + text(low) + " to " + text(high) + ", found " + text(value));
    }
  }
  static std::string text(double value) {
    std::string digits = std::to_string(value);
    digits.erase(digits.find_last_not_of('0') + 1);
    if (!digits.empty() && digits.back() == '.') digits.pop_back();
    return digits;
  }
  [[nodiscard]] Point2 point(const YAML::Node& node) const {
    if (!node.IsSequence() || node.size() != 2) fault(node, "expected a point [x, y]");
    return {number(node[0], -kFar, kFar), number(node[1], -kFar, kFar)};
  }
  /// Reads one mapping: a handler a key; `needed` must be there.
  using Handlers = std::map<std::string, std::function<void(const YAML::Node&)>>;
  void fields(const YAML::Node& node, const Handlers& handlers, const std::vector<std::string>& needed) const {
    if (!node.IsDefined() || node.IsNull()) {
      if (!needed.empty()) fault(kind_at_, "missing key '" + needed.front() + "'");
      return;
    }
    if (!node.IsMap()) fault(node, "expected a mapping (key: value)");
    std::vector<std::string> seen;
    for (const auto& entry : node) {
      if (!entry.first.IsScalar()) fault(entry.first, "expected a plain key");
      const std::string& key = entry.first.Scalar();
      const auto handler = handlers.find(key);
      if (handler == handlers.end()) {
        std::string names;
        for (const auto& [name, unused] : handlers) names += (names.empty() ? "" : ", ") + name;
        fault(entry.first, "unknown key '" + key + "' (known: " + names + ")");
      }
      if (std::find(seen.begin(), seen.end(), key) != seen.end()) fault(entry.first, "key '" + key + "' stands twice");
      seen.push_back(key);
      handler->second(entry.second);
    }
    for (const std::string& key : needed) {
      if (std::find(seen.begin(), seen.end(), key) == seen.end()) fault(node, "missing key '" + key + "'");
    }
  }
  template <class T>
  void choice(const YAML::Node& node, const std::vector<std::pair<std::string, T>>& choices, T& value) const {
    const std::string found = string(node);
    std::string names;
    for (const auto& [name, option] : choices) {
      if (name == found) {
        value = option;
        return;
      }
      names += (names.empty() ? "" : ", ") + name;
    }
    fault(node, "expected one of " + names + ", found '" + found + "'");
  }
  [[nodiscard]] MissionPhase phase(const YAML::Node& node) const {
    const std::string found = string(node);
    const auto phase = parse<MissionPhase>(found);
    std::string names;
    for (const char* name : words_of(MissionPhase{})) names += (names.empty() ? "" : ", ") + std::string{name};
    if (!phase) fault(node, "expected one of " + names + ", found '" + found + "'");
    return *phase;
  }
  [[nodiscard]] std::string string(const YAML::Node& node) const {
    if (!node.IsScalar() || node.Scalar().empty()) fault(node, "expected a text");
    return node.Scalar();
  }
  [[nodiscard]] auto into(double& value, double low, double high) const {
    return [this, &value, low, high](const YAML::Node& node) { value = number(node, low, high); };
  }
  [[nodiscard]] auto degrees_into(double& value) const {
    return [this, &value](const YAML::Node& node) { value = Angle::degrees(number(node, -3600.0, 3600.0)).radians(); };
  }
  [[nodiscard]] auto into(Sensor& value) const {
    return [this, &value](const YAML::Node& node) { choice<Sensor>(node, named<Sensor>(kSensorNames), value); };
  }
  [[nodiscard]] auto into(Point2& value) const {
    return [this, &value](const YAML::Node& node) { value = point(node); };
  }
  [[nodiscard]] auto into(std::string& value) const {
    return [this, &value](const YAML::Node& node) { value = string(node); };
  }

  [[nodiscard]] Kidnap kidnap(const YAML::Node& node) const {
    Kidnap event;
    double heading = 0.0;
    std::optional<Point2> to;
    fields(node,
           {{"to", [&](const YAML::Node& at) { to = point(at); }},
            {"heading", degrees_into(heading)},
            {"from_hazards", into(event.from_hazards, 0.0, 20.0)},
            {"near_hazards", into(event.near_hazards, 0.0, 20.0)},
            {"shift", into(event.shift, 0.0, 1000.0)},
            {"turn", into(event.turn, -360.0, 360.0)},
            {"keeps_speed", into(event.keeps_speed, 0.0, 1.0)}},
           {});
    if (to && event.shift > 0.0) fault(kind_at_, "'to' or 'shift', not both");
    if (to) event.to = Pose2{to->x, to->y, Angle::radians(heading)};
    return event;
  }
  [[nodiscard]] SensorFault sensor_fault(const YAML::Node& node) const {
    SensorFault event;
    fields(node,
           {{"sensor", into(event.sensor)},
            {"kind", [&](const YAML::Node& at) { choice<FaultKind>(at, named<FaultKind>(kFaults), event.kind); }},
            {"for", into(event.duration, 0.0, kLongest)},
            {"delay", into(event.delay, 0.01, 60.0)}},
           {"sensor", "kind"});
    const bool is_of_ranges = event.kind >= FaultKind::near;
    if (event.sensor == Sensor::odom && is_of_ranges) fault(kind_at_, "odometry has no ranges to be wrong");
    if (event.sensor == Sensor::tactile && is_of_ranges) fault(kind_at_, "the tactile ring has no ranges to be wrong");
    return event;
  }
  [[nodiscard]] ScannerLie scanner_lie(const YAML::Node& node) const {
    ScannerLie event;
    fields(node,
           {{"sensor", into(event.sensor)},
            {"kind", [&](const YAML::Node& at) { choice<Lie>(at, named<Lie>(kLies), event.lie); }},
            {"amount", [&](const YAML::Node& at) { event.amount = number(at, -100.0, 1e5); }},
            {"bearing", degrees_into(event.bearing)},
            {"for", into(event.duration, 0.0, kLongest)}},
           {"sensor", "kind"});
    if (event.sensor > Sensor::laser_right) fault(kind_at_, "only lasers lie");
    return event;
  }
  [[nodiscard]] Stool stool(const YAML::Node& node) const {
    Stool event;
    fields(node,
           {{"at", into(event.at)},
            {"radius", into(event.radius, 0.05, 2.0)},
            {"height", into(event.height, 0.05, 3.0)},
            {"bottom", into(event.bottom, 0.0, 3.0)},
            {"for", into(event.duration, 0.0, kLongest)}},
           {"at"});
    if (!(event.bottom < event.height)) fault(node, "'bottom' must be below 'height'");
    return event;
  }
  [[nodiscard]] ClosedPassage closed(const YAML::Node& node) const {
    ClosedPassage event;
    fields(node, {{"from", into(event.from)}, {"to", into(event.to)}, {"for", into(event.duration, 0.0, kLongest)}},
           {"from", "to"});
    if (distance(event.from, event.to) < 0.05) fault(node, "'from' and 'to' are the same point");
    return event;
  }
  [[nodiscard]] PoseError pose_error(const YAML::Node& node) const {
    PoseError event;
    fields(node,
           {{"x", into(event.x, -kFar, kFar)},
            {"y", into(event.y, -kFar, kFar)},
            {"heading", degrees_into(event.heading)},
            {"for", into(event.duration, 0.0, kLongest)}},
           {});
    if (event.x == 0.0 && event.y == 0.0 && event.heading == 0.0) fault(kind_at_, "a pose error of nothing");
    return event;
  }
  [[nodiscard]] SecondMode second_mode(const YAML::Node& node) const {
    SecondMode event;
    Point2 at;
    double heading = 0.0;
    fields(node, {{"at", into(at)}, {"heading", degrees_into(heading)}, {"for", into(event.duration, 0.0, kLongest)}},
           {"at"});
    event.at = {at.x, at.y, Angle::radians(heading)};
    return event;
  }
  [[nodiscard]] OdometryJump odometry_jump(const YAML::Node& node) const {
    OdometryJump event;
    double x = 0.0;
    double y = 0.0;
    double heading = 0.0;
    fields(node,
           {{"x", into(x, -kFar, kFar)},
            {"y", into(y, -kFar, kFar)},
            {"heading", degrees_into(heading)},
            {"over", into(event.over, 0.0, 60.0)}},
           {});
    if (x == 0.0 && y == 0.0 && heading == 0.0) fault(kind_at_, "a jump of nothing");
    event.by = {x, y, Angle::radians(heading)};
    return event;
  }
  [[nodiscard]] Visitors visitors(const YAML::Node& node) const {
    Visitors event;
    fields(node,
           {{"count", [&](const YAML::Node& at) { event.count = whole(at, 500.0); }},
            {"at", [&](const YAML::Node& at) { event.at = point(at); }},
            {"formation",
             [&](const YAML::Node& at) {
               choice<Formation>(
                   at, {{"gather", Formation::gather}, {"wall", Formation::wall}, {"ushape", Formation::ushape}},
                   event.formation);
             }},
            {"heading",
             [&](const YAML::Node& at) {
               degrees_into(event.heading)(at);
               event.has_heading = true;
             }},
            {"heeds", [&](const YAML::Node& at) { event.heeds = number(at, 0.0, 1.0); }},
            {"for", into(event.duration, 0.1, kLongest)}},
           {"count"});
    return event;
  }
  [[nodiscard]] Pushers pushers(const YAML::Node& node) const {
    Pushers event;
    fields(node,
           {{"count", [&](const YAML::Node& at) { event.count = whole(at, 100.0); }},
            {"at", into(event.at)},
            {"heading", degrees_into(event.heading)},
            {"for", into(event.duration, 0.0, kLongest)}},
           {"count", "at", "heading"});
    return event;
  }
  [[nodiscard]] Runners runners(const YAML::Node& node) const {
    Runners event;
    fields(node,
           {{"count", [&](const YAML::Node& at) { event.count = whole(at, 100.0); }},
            {"at", into(event.at)},
            {"within", into(event.within, 0.5, 50.0)},
            {"for", into(event.duration, 0.0, kLongest)}},
           {"count", "at"});
    return event;
  }
  [[nodiscard]] int whole(const YAML::Node& at, double most) const {
    const double count = number(at, 1.0, most);
    if (count != std::floor(count)) fault(at, "expected a whole number");
    return static_cast<int>(count);
  }
  [[nodiscard]] Escort escort(const YAML::Node& node) const {
    Escort event;
    fields(node,
           {{"count", [&](const YAML::Node& at) { event.count = whole(at, 100.0); }},
            {"near", into(event.near, 0.1, 5.0)},
            {"far", into(event.far, 0.1, 5.0)},
            {"for", into(event.duration, 0.0, kLongest)}},
           {"count"});
    if (event.far < event.near) fault(node, "'far' must not be less than 'near'");
    return event;
  }
  [[nodiscard]] Steering steering(const YAML::Node& node) const {
    Steering event;
    fields(node,
           {{"speed", into(event.speed, 0.05, 1.7)},
            {"for", into(event.duration, 0.0, kLongest)},
            {"way",
             [&](const YAML::Node& at) {
               if (!at.IsSequence() || at.size() == 0) fault(at, "expected a list of points [[x, y], …]");
               for (const auto& place : at) event.way.push_back(point(place));
             }}},
           {});
    return event;
  }
  [[nodiscard]] LaserReach lasers(const YAML::Node& node) const {
    LaserReach event;
    fields(node, {{"reach", into(event.range, 0.5, 10.0)}}, {"reach"});
    return event;
  }
  [[nodiscard]] Wish wish(const YAML::Node& node) const {
    Wish event;
    fields(node,
           {{"kind",
             [&](const YAML::Node& at) {
               choice<std::string>(at, {{"exhibit", "exhibit"}, {"tour", "tour"}, {"point", "point"}}, event.kind);
             }},
            {"target", into(event.target)},
            {"viewpoint", [&](const YAML::Node& at) { event.viewpoint = static_cast<int>(number(at, -1.0, 1000.0)); }},
            {"language", into(event.language)},
            {"source",
             [&](const YAML::Node& at) {
               choice<std::string>(at, {{"visitor", "visitor"}, {"kiosk", "kiosk"}, {"web", "web"}, {"staff", "staff"}},
                                   event.source);
             }}},
           {"target"});
    return event;
  }
  [[nodiscard]] Answers answers(const YAML::Node& node) const {
    Answers event;
    fields(node, {{"more", into(event.more, 0.0, 1.0)}, {"next", into(event.next, 0.0, 1.0)}}, {});
    if (event.more + event.next > 1.0) fault(node, "'more' and 'next' are more than 1 together");
    return event;
  }
  [[nodiscard]] BatteryChange battery(const YAML::Node& node) const {
    BatteryChange event;
    fields(node, {{"charge", into(event.charge, 0.0, 1.0)}}, {"charge"});
    return event;
  }
  [[nodiscard]] Kill kill(const YAML::Node& node) const {
    Kill event;
    fields(node,
           {{"module", into(event.module)},
            {"signal",
             [&](const YAML::Node& at) {
               choice<std::string>(at, {{"kill", "kill"}, {"stop", "stop"}}, event.signal);
             }},
            {"for", into(event.duration, 0.1, 3600.0)}},
           {"module"});
    return event;
  }

  const YamlFile& file_;
  YAML::Node kind_at_;
};

Result<Scenario> read_scenario(const YamlFile& file) {
  Scenario scenario;
  try {
    const YAML::Node& root = file.root();
    if (!root.IsMap()) throw YamlFault{file.fault(root, "expected a mapping with 'events'")};
    for (const auto& entry : root) {
      const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
      if (key == "build") scenario.build = read_build_errors(file, entry.second);
      if (key != "build" && key != "events")
        throw YamlFault{file.fault(entry.first, "unknown key '" + key + "' (known: build, events)")};
    }
    const YAML::Node events = root["events"];
    if (!events.IsSequence()) throw YamlFault{file.fault(root, "'events' must be a list")};
    EventReader reader{file};
    for (const auto& node : events) scenario.events.push_back(reader.read(node));
  } catch (const YamlFault& fault) {
    return tl::unexpected<Error>(fault.error);
  } catch (const YAML::Exception& exception) {
    return fail(file.name() + ":" + std::to_string(exception.mark.line + 1) + ": " + exception.msg);
  }
  std::stable_sort(scenario.events.begin(), scenario.events.end(),
                   [](const ScenarioEvent& a, const ScenarioEvent& b) { return a.at < b.at; });
  return scenario;
}

}  // namespace

Result<Scenario> parse_scenario(const std::string& text, const std::string& name) {
  auto file = YamlFile::parse(text, name);
  if (!file) return tl::unexpected<Error>(file.error());
  return read_scenario(*file);
}

Result<Scenario> load_scenario(const std::filesystem::path& path) {
  auto file = YamlFile::load(path);
  if (!file) return tl::unexpected<Error>(file.error());
  return read_scenario(*file);
}

}  // namespace docent::simulator
