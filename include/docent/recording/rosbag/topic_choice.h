#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "docent/base/result.h"

namespace docent::recording {

/// What somebody wants of a recording; what is empty is chosen.
struct WantedTopics {
  std::vector<std::string> scans = {};  ///< "/scan"
  std::string odometry = {};            ///< "/odom"
  std::string robot = {};               ///< name space, "/robot1"; "/" the one without
};

/// What a recording holds, as far as a choice needs it.
struct RecordedTopics {
  /// Of one topic.
  struct Scans {
    std::size_t count = 0;   ///< messages
    std::string frame;       ///< of its messages
    bool has_place = false;  ///< the frame's place on the robot is known
  };
  /// Of one topic.
  struct Odometry {
    std::size_t count = 0;   ///< messages
    std::string parent;      ///< "odom"
    std::string child = {};  ///< "base_link"
  };
  std::map<std::string, Scans> scans = {};        ///< by topic
  std::map<std::string, Odometry> odometry = {};  ///< by topic
  /// Odometry told by transforms: readings, by the topic's name space and, behind it, the prefix of the frames.
  std::map<std::string, std::size_t> transforms = {};
};

/// What is used of it.
struct ChosenTopics {
  std::string robot = {};          ///< name space; empty: there is none
  std::vector<std::string> scans;  ///< topics
  std::string odometry;            ///< topic; empty: none
  std::string transforms;          ///< which of the transforms that tell odometry, where no topic does
  bool is_by_transforms = false;   ///< no topic tells odometry, but a transform does
  std::vector<std::string> notes;  ///< what was left, and why
};

/// Chooses the topics of one robot: those of a name space that has its own odometry belong together, or, without name
/// spaces, those whose frames have one prefix. Of several scans
/// of one scanner the raw ones are taken, of several odometries that of the wheels with most messages; what is called
/// ground truth, or lies in the map's frame, is never odometry. Error: what is wanted is not there; it says what is.
[[nodiscard]] Result<ChosenTopics> choose_topics(const RecordedTopics& recorded, const WantedTopics& wanted);

/// "/robot1" of "/robot1/tf"; empty for "/tf".
[[nodiscard]] std::string name_space_of(const std::string& topic);

}  // namespace docent::recording
