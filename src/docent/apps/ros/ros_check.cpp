#include "docent/apps/ros/ros_check.h"

#include <algorithm>
#include <map>

#include "docent/messages/topics.h"
#include "docent/transport/create3_support.h"

namespace docent::apps::ros {
namespace {

using transport::Endpoint;
using transport::topic_info;

std::string vendor_of(const transport::Discovered& heard, const std::string& participant) {
  for (const auto& one : heard.participants)
    if (one.id == participant) return one.vendor;
  return "?";
}

/// The word for a rename in ROS 2: "-r scan:=scan_front".
std::string renamed(const std::string& from, const std::string& to) { return "-r " + from + ":=" + to; }

std::string without_slash(const std::string& topic) { return topic.starts_with('/') ? topic.substr(1) : topic; }

}  // namespace

std::vector<Need> needs_of(const robot::RobotBody& body, bool needs_sonar, bool is_create3, const Eyes& eyes) {
  std::vector<Need> needs;
  needs.push_back({topic_info(topics::kOdometry),
                   true,
                   "the robot stands",
                   {"avoid", "calibrate", "explore", "hazards", "head", "localize", "robot", "web"}});
  for (const auto& scanner : body.scanners)
    needs.push_back({topic_info(topics::scan_topic(scanner.name)),
                     true,
                     "the robot stands",
                     {"avoid", "calibrate", "explore", "localize", "map", "plan", "web"}});
  const bool stands_without_sonar = needs_sonar || body.scanners.empty();
  if (body.sonars > 0)
    needs.push_back({topic_info(topics::kSonar),
                     stands_without_sonar,
                     stands_without_sonar ? "the robot stands, unless body.sonars is 0 or avoid.needs_sonar is false"
                                          : "it drives, as avoid.needs_sonar is false",
                     {"avoid", "localize", "map"}});
  if (body.infrareds > 0)
    needs.push_back(
        {topic_info(topics::kInfrared), true, "the robot stands, unless body.infrareds is 0", {"avoid", "map"}});
  if (body.tactile && is_create3)
    needs.push_back({topic_info(topics::kHazards), true, "the robot stands, unless body.tactile is false", {"robot"}});
  else if (body.tactile)
    needs.push_back(
        {topic_info(topics::kTactile), true, "the robot stands, unless body.tactile is false", {"avoid", "map"}});
  needs.push_back({topic_info(topics::kBattery), false, "it drives, and never goes to charge", {"mission", "web"}});
  needs.push_back({topic_info(topics::kObstacleLines), false, "it drives by its other sensors", {"avoid"}});
  if (eyes.sight) {
    const char* const without = "it drives, and sees no low things";
    needs.push_back({topic_info(topics::kDepthImage), false, without, {"sight"}});
    needs.push_back({topic_info(topics::kDepthInfo), false, without, {"sight"}});
  }
  if (eyes.ceiling) {
    const char* const without = "it finds its place by its lasers alone";
    needs.push_back({topic_info(topics::kCeilingImage), false, without, {"ceiling"}});
    needs.push_back({topic_info(topics::kCeilingInfo), false, without, {"ceiling"}});
    needs.push_back({topic_info(topics::kPoseFix), false, without, {"localize"}});
  }
  needs.push_back({topic_info(topics::kCamera), false, "the page shows no picture", {"web"}});
  return needs;
}

bool is_docent(const transport::Discovered& heard, const std::string& participant, const std::string& health) {
  return std::any_of(heard.endpoints.begin(), heard.endpoints.end(), [&](const Endpoint& one) {
    return one.writes && one.participant == participant && one.topic == health;
  });
}

Finding finding_of(const Need& need, const Arrivals& arrivals, double seconds, const Wire& wire,
                   const transport::Discovered& heard) {
  const std::string name = wire.name(need.topic);
  const std::string type = wire.type(need.topic);
  Finding finding{need, transport::ros_topic(name), arrivals, static_cast<double>(arrivals.messages) / seconds, {}};
  if (arrivals.refused > 0)
    finding.faults.push_back(std::to_string(arrivals.refused) + " messages refused: " + arrivals.refusal);
  int writers = 0;
  for (const Endpoint& one : heard.endpoints) {
    if (!one.writes || one.topic != name) continue;
    ++writers;
    if (const std::string why = transport::mismatch(need.topic, type, one); !why.empty())
      finding.faults.push_back("a program with " + vendor_of(heard, one.participant) + " publishes it, but " + why);
  }
  if (finding.arrives()) return finding;
  if (writers > 0 && finding.faults.empty())
    finding.faults.emplace_back("somebody offers it and says nothing: does the sensor run?");
  if (writers > 0) return finding;
  finding.faults.emplace_back("nobody publishes it");
  for (const Endpoint& one : heard.endpoints) {
    const std::string other = transport::ros_topic(one.topic);
    if (one.writes && one.type == type && other.starts_with('/'))
      finding.faults.push_back(other + " is of this type: is it that? Then start its driver with --ros-args " +
                               renamed(without_slash(other), without_slash(finding.topic)));
  }
  return finding;
}

void check_commands(Check& check, const Wire& wire) {
  const auto topic = topic_info(topics::kCommandVelocity);
  const std::string name = wire.name(topic);
  const std::string health = wire.name(topic_info(topics::kHealth));
  const std::string said = transport::ros_topic(name);
  int readers = 0, own_writers = 0;
  for (const Endpoint& one : check.heard.endpoints) {
    if (one.topic != name) continue;
    if (is_docent(check.heard, one.participant, health)) {
      own_writers += one.writes ? 1 : 0;
      continue;
    }
    const std::string who = "a program with " + vendor_of(check.heard, one.participant);
    if (one.writes) {
      check.faults.push_back(who + " publishes " + said + ": the base obeys whoever spoke last; only Docent may");
      continue;
    }
    ++readers;
    std::string why = transport::mismatch(topic, wire.type(topic), one);
    if (why.empty()) continue;
    if (one.type != wire.type(topic))
      why += one.type.find("Stamped") == std::string::npos ? " (body.stamped_commands: false)"
                                                           : " (body.stamped_commands: true)";
    check.faults.push_back(who + " reads " + said + ", but " + why);
  }
  if (own_writers > 1)
    check.faults.push_back(std::to_string(own_writers) + " programs of Docent's publish " + said +
                           ": two robots of one name are on this domain, and each drives both bases");
  if (readers == 0) check.notes.push_back("nobody reads " + said + ": no base would obey");
}

void check_others(Check& check, const Wire& wire) {
  const std::string health = wire.name(topic_info(topics::kHealth));
  std::map<std::string, transport::TopicInfo> known;
  for_each_robot_topic([&](const auto& topic) { known.emplace(wire.name(topic_info(topic)), topic_info(topic)); });
  for (const Finding& finding : check.findings) known.erase(wire.name(finding.need.topic));
  known.erase(wire.name(topic_info(topics::kCommandVelocity)));
  for (const Endpoint& one : check.heard.endpoints) {
    const auto topic = known.find(one.topic);
    if (topic == known.end() || is_docent(check.heard, one.participant, health)) continue;
    const std::string why = transport::mismatch(topic->second, wire.type(topic->second), one);
    if (!why.empty())
      check.notes.push_back("a program with " + vendor_of(check.heard, one.participant) +
                            (one.writes ? " publishes " : " reads ") + transport::ros_topic(one.topic) + ", but " +
                            why);
  }
}

bool Check::is_fine() const {
  return faults.empty() && std::all_of(findings.begin(), findings.end(), [](const Finding& finding) {
           return finding.arrives() || !finding.need.is_needed;
         });
}

}  // namespace docent::apps::ros
