#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/museum/museum.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::museum {

/// What the robot does meanwhile: it maps the building, is driven about by hand in a map that it knows, or guides.
enum class SetupWork { map, mark, guide };
[[nodiscard]] constexpr SetupWork work_of(SetupStep step) {
  if (step <= SetupStep::map) return SetupWork::map;
  return step < SetupStep::tour ? SetupWork::mark : SetupWork::guide;
}

/// Where a museum's folder is set up, step by step, from nothing to the first tour. How far it has come lies in
/// setup.yaml of the folder, so that it can be continued on another day. Every call reads the folder anew, and leaves
/// it as it was where it fails. Not thread-safe.
class MuseumSetup {
 public:
  /// @param folder  of the museum
  /// @param state   the robot's, in which the module `explore` leaves its map
  MuseumSetup(std::filesystem::path folder, const std::filesystem::path& state, const CheckedRobot& robot);

  struct Progress {
    SetupStep step = SetupStep::name;
    Pose2 start;  ///< of the robot, in the frame of the map that is made
  };
  /// Makes folder and museum where there are none yet. Error: the folder holds a museum that was not begun here.
  [[nodiscard]] static Result<Progress> begin(const std::filesystem::path& folder, const Pose2& start);
  [[nodiscard]] static Result<Progress> read(const std::filesystem::path& folder);

  [[nodiscard]] Result<Progress> read() const { return read(folder_); }
  /// @pre no map was kept yet
  [[nodiscard]] Result<void> name(const std::string& name, const std::vector<std::string>& languages) const;
  /// The robot's map is the museum's from now on. Error: it has not made one.
  [[nodiscard]] Result<void> keep_map() const;
  /// Forgets map, hazards and exhibits: the museum is mapped once more.
  /// @param start  where the robot is, in the frame of the map to come; nullopt: its frame is that of the map which is
  ///               being made, or the robot is at its origin
  [[nodiscard]] Result<void> map_again(std::optional<Pose2> start) const;
  [[nodiscard]] bool has_explored() const;  ///< there is a map that may be kept
  /// To another step. @returns why not; empty: it is there. The first tour waits for a museum without faults.
  [[nodiscard]] Result<std::vector<std::string>> go(SetupStep step) const;

 private:
  [[nodiscard]] Result<void> write(const Progress& progress) const;

  std::filesystem::path folder_, explored_, explorers_pose_;
  CheckedRobot robot_;
};

}  // namespace docent::museum
