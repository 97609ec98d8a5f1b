#pragma once

/// The slots of the live channel: what viewers are shown, each with one newest value.
namespace docent::telepresence::slots {

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

}  // namespace docent::telepresence::slots
