#include "docent/apps/ros/ros_report.h"

#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace docent::apps::ros {
namespace {

using transport::Endpoint;

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const auto& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
}

/// How many programs of each vendor, Docent's own named so.
std::map<std::string, int> programs_of(const Check& check, const std::string& health) {
  std::map<std::string, int> count;
  for (const auto& one : check.heard.participants)
    ++count[is_docent(check.heard, one.id, health) ? "Docent" : one.vendor];
  return count;
}

/// What is heard of one topic and type.
struct TopicLine {
  std::map<std::string, int> writers, readers;  ///< by vendor
  std::set<std::string> qualities;              ///< of the writers
};

std::string counted(const std::map<std::string, int>& by_vendor) {
  std::vector<std::string> words;
  for (const auto& [vendor, count] : by_vendor) words.push_back(std::to_string(count) + " " + vendor);
  return joined(words);
}

std::map<std::pair<std::string, std::string>, TopicLine> topics_of(const Check& check, const std::string& health) {
  std::map<std::string, std::string> vendors;
  for (const auto& one : check.heard.participants)
    vendors[one.id] = is_docent(check.heard, one.id, health) ? "Docent" : one.vendor;
  std::map<std::pair<std::string, std::string>, TopicLine> lines;
  for (const Endpoint& one : check.heard.endpoints) {
    TopicLine& line = lines[{transport::ros_topic(one.topic), transport::ros_type(one.type)}];
    const auto vendor = vendors.find(one.participant);
    ++(one.writes ? line.writers : line.readers)[vendor == vendors.end() ? "?" : vendor->second];
    if (one.writes)
      line.qualities.insert(std::string{one.is_reliable ? "reliable" : "best effort"} +
                            (one.is_latched ? ", transient local" : ", volatile"));
  }
  return lines;
}

/// Between Docent's own modules alone: of no interest to whoever connects a base.
bool is_inner(const std::string& topic, const TopicLine& line) {
  const auto only_docent = [](const std::map<std::string, int>& by_vendor) {
    return by_vendor.empty() || (by_vendor.size() == 1 && by_vendor.contains("Docent"));
  };
  return topic.find("/docent/") != std::string::npos && only_docent(line.writers) && only_docent(line.readers);
}

/// Names of the nodes of others, one line; empty: there are none.
std::string nodes_of(const Check& check, const std::string& health) {
  std::vector<std::string> others;
  std::size_t own = 0;
  for (const auto& one : check.nodes) {
    if (is_docent(check.heard, one.participant, health))
      ++own;
    else
      others.push_back(one.name);
  }
  if (own > 0) others.push_back(std::to_string(own) + " of Docent");
  return others.empty() ? "" : "  nodes of ROS 2: " + joined(others) + "\n";
}

const char* word_of(const Finding& finding) {
  if (finding.arrives()) return finding.faults.empty() ? "ok" : "faulty";
  return finding.need.is_needed ? "MISSING" : "absent";
}

std::string settings_of(const Check& check) {
  std::string text = "Settings: " + in_words(check.reach) + ".\n";
  for (const auto& one : check.interfaces) {
    const bool is_heard = one.is_loopback || one.name == check.reach.interface;
    text += "  " + one.name + " " + one.address +
            (!check.reach.uri.empty() ? ""
             : is_heard               ? ": heard"
                                      : ": not heard (--interface " + one.name + ")") +
            "\n";
  }
  text += "For ROS 2's side, in each of its shells:\n";
  for (const auto& line : check.lines) text += "  " + line.implementation + ": " + line.line + "\n";
  return text;
}

}  // namespace

std::string text_of(const Check& check, const std::string& health) {
  std::string text = settings_of(check);
  const auto programs = programs_of(check, health);
  char seconds[32];
  std::snprintf(seconds, sizeof seconds, "%.1f", check.seconds);
  text += std::string{"Heard within "} + seconds + " s: " + (programs.empty() ? "nobody" : counted(programs)) + ".\n";
  text += nodes_of(check, health);
  int inner = 0;
  for (const auto& [topic, line] : topics_of(check, health)) {
    if (is_inner(topic.first, line)) {
      ++inner;
      continue;
    }
    text += "  " + topic.first + " (" + topic.second + ")";
    if (!line.writers.empty())
      text += ", from " + counted(line.writers) + ": " + joined({line.qualities.begin(), line.qualities.end()});
    if (!line.readers.empty()) text += ", to " + counted(line.readers);
    text += "\n";
  }
  if (inner > 0) text += "  and " + std::to_string(inner) + " topics between Docent's modules\n";
  text += "What the robot needs (body of robot.yaml):\n";
  for (const Finding& finding : check.findings) {
    char rate[64] = "";
    if (finding.arrives()) std::snprintf(rate, sizeof rate, ", %.1f Hz", finding.rate);
    text += std::string{"  "} + word_of(finding) + " " + finding.topic + rate + ": " + joined(finding.need.modules);
    if (!finding.arrives()) text += "; without it: " + finding.need.without;
    text += "\n";
    if (!finding.arrives() && !finding.need.is_needed && finding.faults.size() == 1) continue;  // it is just not there
    for (const auto& fault : finding.faults) text += "    " + fault + "\n";
  }
  for (const auto& fault : check.faults) text += "fault: " + fault + "\n";
  for (const auto& note : check.notes) text += "note: " + note + "\n";
  return text + (check.is_fine() ? "All that is needed arrives.\n" : "Not all that is needed arrives.\n");
}

std::string json_of(const Check& check, const std::string& health) {
  using nlohmann::json;
  json interfaces = json::array(), lines = json::array(), participants = json::array(), endpoints = json::array(),
       needs = json::array(), nodes = json::array();
  for (const auto& one : check.interfaces) interfaces.push_back({{"name", one.name}, {"address", one.address}});
  for (const auto& one : check.lines) lines.push_back({{"implementation", one.implementation}, {"line", one.line}});
  for (const auto& one : check.heard.participants)
    participants.push_back({{"id", one.id},
                            {"vendor", one.vendor},
                            {"user_data", one.user_data},
                            {"is_docent", is_docent(check.heard, one.id, health)}});
  for (const auto& one : check.nodes)
    nodes.push_back(
        {{"participant", one.participant}, {"name", one.name}, {"readers", one.readers}, {"writers", one.writers}});
  for (const auto& one : check.heard.endpoints)
    endpoints.push_back({{"participant", one.participant},
                         {"topic", transport::ros_topic(one.topic)},
                         {"type", transport::ros_type(one.type)},
                         {"writes", one.writes},
                         {"reliable", one.is_reliable},
                         {"transient_local", one.is_latched},
                         {"user_data", one.user_data}});
  for (const auto& one : check.findings)
    needs.push_back({{"topic", one.topic},
                     {"needed", one.need.is_needed},
                     {"arrives", one.arrives()},
                     {"rate", one.rate},
                     {"modules", one.need.modules},
                     {"without", one.need.without},
                     {"faults", one.faults}});
  const json all{{"settings",
                  {{"domain", check.reach.domain},
                   {"interface", check.reach.interface},
                   {"cyclonedds_uri", check.reach.uri},
                   {"words", in_words(check.reach)},
                   {"interfaces", interfaces}}},
                 {"ros", lines},
                 {"seconds", check.seconds},
                 {"participants", participants},
                 {"nodes", nodes},
                 {"endpoints", endpoints},
                 {"needs", needs},
                 {"faults", check.faults},
                 {"notes", check.notes},
                 {"fine", check.is_fine()}};
  return all.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace docent::apps::ros
