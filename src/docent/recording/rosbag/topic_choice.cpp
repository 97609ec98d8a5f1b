#include "docent/recording/rosbag/topic_choice.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>
#include <tuple>

#include "docent/base/text.h"
#include "docent/recording/rosbag/frame_tree.h"

namespace docent::recording {
namespace {

template <std::size_t N>
bool holds_one_of(const std::string& topic, const std::array<std::string_view, N>& words) {
  const std::string name = lower_case(topic);
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return name.find(word) != std::string::npos; });
}

/// Where a robot truly is, or is in its map, is not what its wheels say.
bool is_truth(const std::string& topic, const RecordedTopics::Odometry& odometry) {
  constexpr std::array<std::string_view, 14> kWords{"truth", "/gt",       "_gt",      "mocap", "vicon",
                                                    "vrpn",  "optitrack", "qualisys", "p3d",   "gazebo",
                                                    "/sim/", "perfect",   "ideal",    "exact_"};
  const std::string parent = odometry.parent.substr(odometry.parent.rfind('/') + 1);
  return holds_one_of(topic, kWords) || parent == "map" || parent == "world" || parent == "earth";
}
/// Made of several sensors, maybe of the very scans that are to be localized.
bool is_fused(const std::string& topic) {
  constexpr std::array<std::string_view, 28> kWords{
      "filtered", "ekf",  "ukf",  "fused", "amcl",       "slam",   "localiz",    "visual",     "rtabmap", "icp",
      "rf2o",     "gps",  "gnss", "gicp",  "scan_match", "vins",   "laser_odom", "lidar_odom", "camera",  "/zed",
      "vio/",     "_vio", "loam", "kiss",  "lio",        "mapped", "t265",       "orb_"};
  return holds_one_of(topic, kWords);
}
/// Against a name that tells nothing.
bool sounds_like_wheels(const std::string& topic) {
  return holds_one_of(topic, std::array<std::string_view, 4>{"odom", "wheel", "encoder", "drive"});
}
/// Made of other scans.
bool is_made_of_scans(const std::string& topic) {
  constexpr std::array<std::string_view, 10> kWords{"filter",  "merged", "multi",  "throttle", "downsampl",
                                                    "virtual", "crop",   "safety", "relay",    "converted"};
  return holds_one_of(topic, kWords);
}

bool lies_in(const std::string& topic, const std::string& name_space) { return topic.starts_with(name_space + "/"); }

/// "/robot1" for frame "robot1/laser"; empty for one without a prefix.
std::string robot_of_frame(const std::string& frame) {
  const std::string prefix = prefix_of(frame);
  return prefix.empty() ? prefix : "/" + prefix;
}

/// The innermost name space round the topic that has an odometry of its own; where there is none, the prefix of its
/// frame, if an odometry has the same; empty: the robot without a name.
std::string robot_of(const std::string& topic, const std::string& frame, const RecordedTopics& recorded) {
  for (std::string robot = name_space_of(topic); !robot.empty(); robot = name_space_of(robot)) {
    for (const auto& [odometry, about] : recorded.odometry)
      if (lies_in(odometry, robot)) return robot;
    for (const auto& [name_space, count] : recorded.transforms)
      if (name_space == robot || lies_in(name_space, robot)) return robot;
  }
  const std::string robot = robot_of_frame(frame);
  const bool is_known =
      !robot.empty() && (recorded.transforms.contains(robot) ||
                         std::any_of(recorded.odometry.begin(), recorded.odometry.end(),
                                     [&](const auto& of) { return robot_of_frame(of.second.child) == robot; }));
  return is_known ? robot : std::string{};
}

template <class T>
std::vector<std::string> names_of(const std::map<std::string, T>& topics) {
  std::vector<std::string> names;
  for (const auto& [name, about] : topics) names.push_back(name);
  return names;
}
std::string spoken(const std::string& robot) { return robot.empty() ? "/" : robot; }

/// One choice; its steps fill the result.
class Choice {
 public:
  Choice(const RecordedTopics& recorded, const WantedTopics& wanted) : recorded_{recorded}, wanted_{wanted} {
    for (const auto& [topic, about] : recorded.scans) robots_[robot_of(topic, about.frame, recorded)].push_back(topic);
  }

  Result<ChosenTopics> run() {
    if (auto robot = choose_robot(); !robot) return tl::unexpected<Error>(robot.error());
    if (auto scans = choose_scans(); !scans) return tl::unexpected<Error>(scans.error());
    if (auto odometry = choose_odometry(); !odometry) return tl::unexpected<Error>(odometry.error());
    return std::move(chosen_);
  }

 private:
  void note(std::string text) { chosen_.notes.push_back(std::move(text)); }

  /// Whether that robot is the innermost one round the topic or, without any, that of the frame.
  [[nodiscard]] bool is_of(const std::string& topic, const std::string& frame, const std::string& robot) const {
    for (std::string around = name_space_of(topic); !around.empty(); around = name_space_of(around))
      if (robots_.contains(around)) return around == robot;
    const std::string of_frame = robot_of_frame(frame);
    if (robots_.contains(of_frame)) return of_frame == robot;
    return robot.empty() || robots_.size() == 1;
  }
  [[nodiscard]] bool has_odometry(const std::string& robot) const {
    return std::any_of(recorded_.odometry.begin(), recorded_.odometry.end(),
                       [&](const auto& topic) { return is_of(topic.first, topic.second.child, robot); }) ||
           std::any_of(recorded_.transforms.begin(), recorded_.transforms.end(),
                       [&](const auto& tf) { return is_of(tf.first + "/tf", {}, robot); });
  }

  Result<void> choose_robot() {
    if (!wanted_.robot.empty()) {
      std::string robot = wanted_.robot == "/" ? "" : wanted_.robot;
      if (!robot.empty() && !robot.starts_with('/')) robot.insert(0, "/");
      while (robot.ends_with('/')) robot.pop_back();
      if (!robots_.contains(robot)) {
        std::vector<std::string> all;
        for (const auto& [name, topics] : robots_) all.push_back(spoken(name));
        return fail("no robot " + spoken(robot) + " has scans in it; there are: " + listed(all, "none"));
      }
      chosen_.robot = robot;
    } else if (!wanted_.scans.empty() && recorded_.scans.contains(wanted_.scans.front())) {
      chosen_.robot = robot_of(wanted_.scans.front(), recorded_.scans.at(wanted_.scans.front()).frame, recorded_);
    } else {
      const auto weight = [&](const auto& robot) {
        std::size_t scans = 0;
        for (const std::string& topic : robot.second) scans += recorded_.scans.at(topic).count;
        return std::pair{has_odometry(robot.first), scans};
      };
      chosen_.robot = std::max_element(robots_.begin(), robots_.end(), [&](const auto& a, const auto& b) {
                        return weight(a) < weight(b);
                      })->first;
    }
    if (robots_.size() > 1 && wanted_.robot.empty() && wanted_.scans.empty()) {
      std::vector<std::string> others;
      for (const auto& [name, topics] : robots_)
        if (name != chosen_.robot) others.insert(others.end(), topics.begin(), topics.end());
      note("several robots are in it: that of " + spoken(chosen_.robot) + " is used, and left out are the scans of " +
           listed(others, "none") + "; --robot and --scan choose");
    }
    return {};
  }

  Result<void> choose_scans() {
    for (const std::string& topic : wanted_.scans)
      if (!recorded_.scans.contains(topic))
        return fail("holds no scans of " + topic + "; there are those of " + listed(names_of(recorded_.scans), "none"));
    if (!wanted_.scans.empty()) {
      chosen_.scans = wanted_.scans;
      return {};
    }
    // Of one frame there is one scanner.
    std::map<std::string, std::vector<std::string>> by_frame;
    for (const std::string& topic : robots_[chosen_.robot]) by_frame[recorded_.scans.at(topic).frame].push_back(topic);
    std::vector<std::string> placed, unplaced;
    for (auto& [frame, topics] : by_frame) {
      const auto worth = [&](const std::string& topic) {
        return std::tuple{is_made_of_scans(topic), -static_cast<long>(recorded_.scans.at(topic).count), topic.size(),
                          topic};
      };
      std::sort(topics.begin(), topics.end(), [&](const auto& a, const auto& b) { return worth(a) < worth(b); });
      if (topics.size() > 1)
        note("of the scans of one scanner, '" + frame + "', those of " + topics.front() +
             " are used, and left out are those of " + listed({topics.begin() + 1, topics.end()}) + "; --scan chooses");
      (recorded_.scans.at(topics.front()).has_place ? placed : unplaced).push_back(topics.front());
    }
    const auto most = [&](const std::string& a, const std::string& b) {
      return recorded_.scans.at(a).count < recorded_.scans.at(b).count;
    };
    std::sort(unplaced.begin(), unplaced.end());
    if (placed.empty()) {
      const auto one = std::max_element(unplaced.begin(), unplaced.end(), most);
      placed.push_back(*one);
      unplaced.erase(one);
    }
    for (const std::string& topic : unplaced)
      note("the scans of " + topic + " are left out: nothing says where '" + recorded_.scans.at(topic).frame +
           "' is on the robot");
    chosen_.scans = std::move(placed);
    std::sort(chosen_.scans.begin(), chosen_.scans.end());
    return {};
  }

  Result<void> choose_odometry() {
    if (!wanted_.odometry.empty()) {
      if (!recorded_.odometry.contains(wanted_.odometry))
        return fail("holds no odometry of " + wanted_.odometry + "; there is that of " +
                    listed(names_of(recorded_.odometry), "none"));
      chosen_.odometry = wanted_.odometry;
      return {};
    }
    std::vector<std::string> wheels, fused, truth;
    for (const auto& [topic, about] : recorded_.odometry) {
      if (!is_of(topic, about.child, chosen_.robot)) continue;
      (is_truth(topic, about) ? truth : is_fused(topic) ? fused : wheels).push_back(topic);
    }
    const auto most = [&](const std::string& a, const std::string& b) {
      const auto worth = [&](const std::string& topic) {
        return std::pair{sounds_like_wheels(topic), recorded_.odometry.at(topic).count};
      };
      return worth(a) < worth(b);
    };
    const auto transforms = std::find_if(recorded_.transforms.begin(), recorded_.transforms.end(),
                                         [&](const auto& tf) { return is_of(tf.first + "/tf", {}, chosen_.robot); });
    std::vector<std::string> left;
    if (!wheels.empty()) {
      chosen_.odometry = *std::max_element(wheels.begin(), wheels.end(), most);
      std::copy_if(wheels.begin(), wheels.end(), std::back_inserter(left),
                   [&](const auto& topic) { return topic != chosen_.odometry; });
      left.insert(left.end(), fused.begin(), fused.end());
    } else if (transforms != recorded_.transforms.end()) {
      chosen_.transforms = transforms->first;
      chosen_.is_by_transforms = true;
      note("there is no odometry topic: the transform from odom of " + transforms->first + "/tf is taken");
      left = fused;
    } else if (!fused.empty()) {
      chosen_.odometry = *std::max_element(fused.begin(), fused.end(), most);
      note("there is no odometry of wheels: that of " + chosen_.odometry +
           " is taken, which seems to be made of several sensors");
    }
    left.insert(left.end(), truth.begin(), truth.end());
    if (!left.empty())
      note((chosen_.odometry.empty() ? "" : "the odometry of " + chosen_.odometry + " is used, and ") +
           ("left out is that of " + listed(left)) + "; --odom chooses");
    return {};
  }

  const RecordedTopics& recorded_;
  const WantedTopics& wanted_;
  std::map<std::string, std::vector<std::string>> robots_;  ///< topics of scans, by name space
  ChosenTopics chosen_;
};

}  // namespace

std::string name_space_of(const std::string& topic) {
  const std::size_t slash = topic.rfind('/');
  return slash == std::string::npos ? std::string{} : topic.substr(0, slash);
}

Result<ChosenTopics> choose_topics(const RecordedTopics& recorded, const WantedTopics& wanted) {
  return Choice{recorded, wanted}.run();
}

}  // namespace docent::recording
