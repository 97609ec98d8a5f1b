#pragma once

namespace docent::modules {

/// The slots of the live channel.
enum Slot : int {
  kLive,
  kBelief,
  kPath,
  kMission,
  kSpeech,
  kBoard,
  kHealth,
  kWindow,
  kHorn,
  kSound,
  kExpression,
  kButton,
  kPose,
  kVotes,
  kHours,
  kOperation,
  kField,
  kLog,
  kMaps,
  kExploration
};

}  // namespace docent::modules
