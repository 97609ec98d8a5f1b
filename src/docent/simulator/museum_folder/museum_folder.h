#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/simulator/museum_folder/places.h"
#include "docent/simulator/world/survey.h"

namespace docent::simulator {

/// A fixed tour.
struct Round {
  std::string id;
  std::string title;
  std::vector<std::string> stops;  ///< their ids, in order
};

/// A museum before it is a folder: the true world, and what its staff would write down of it.
struct MuseumPlan {
  std::string title;    ///< for people
  std::string made_of;  ///< first line of museum.yaml: where it comes from
  std::string topic;    ///< of every stop
  std::vector<std::string> languages{"en"};
  World world;              ///< its exhibits are the stops, its tours the rounds
  std::vector<Stop> stops;  ///< at least two
  std::vector<Round> rounds;
  Pose2 home;  ///< world_from_base
  std::optional<Pose2> charger;
};

/// simulation.yaml of a world whose walls end at its ceiling; load_world reads the same world back, to the millimetre.
[[nodiscard]] std::string to_yaml(const World& world);

/// Writes a museum folder (architecture 5): the true world with its recorded people, and what a survey of it tells the
/// robot. Error: a file that cannot be written, or that somebody wrote or edited by hand (MadeFiles).
[[nodiscard]] Result<void> write_museum(const MuseumPlan& plan, const Survey& survey,
                                        const std::filesystem::path& folder);

}  // namespace docent::simulator
