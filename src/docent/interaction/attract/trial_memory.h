#pragma once

#include <filesystem>
#include <vector>

#include "docent/base/files.h"
#include "docent/base/time.h"
#include "docent/interaction/attract/style.h"

namespace docent::interaction {

/// One attraction phase, as it is remembered.
struct AttractionTrial {
  Time begin;
  double density = 0.0;  ///< [1/m2] persons around when it began
  AttractionAction action;
  StyleChances chances{};  ///< how probably each style was to be drawn with this gaze, as things stood then
  double reward = 0.0;
};

/// All phases, oldest first. Everything that the learner knows follows from them.
using TrialMemory = std::vector<AttractionTrial>;

inline constexpr std::size_t kMostTrials = 100000;  ///< years of phases; a full memory takes no more

/// A JSON file, replaced as a whole.
[[nodiscard]] Result<void> save_trials(const std::filesystem::path& path, const TrialMemory& trials,
                                       Survives survives = Survives::power_failure);
/// Empty where there is no file. Error: "FILE: why" of one that holds anything but trials as they can be.
[[nodiscard]] Result<TrialMemory> load_trials(const std::filesystem::path& path);
/// The same of a text. @param name stands where the file's name would
[[nodiscard]] Result<TrialMemory> parse_trials(const std::string& text, const std::string& name);

}  // namespace docent::interaction
