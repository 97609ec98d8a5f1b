#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/museum/museum.h"
#include "docent/task_control/tour_scheduler/programme.h"

namespace docent::apps {

/// What a program must know of a museum: its places.
[[nodiscard]] task_control::Programme programme_of(const museum::Museum& museum);

struct TourFindings {
  std::vector<Error> faults;
  std::vector<std::string> notes;  ///< what may be meant so, but hardly is
};

/// Reads the program and the golex.yaml of the museum's folder, if there is one, and compares them: the robot must know
/// what to do for each action of the program. Notes are about keys that no action calls, and about texts that are
/// missing in a language of the museum or stand in another one. Each names file and line.
[[nodiscard]] TourFindings check_tour(const std::filesystem::path& program, const museum::Museum& museum);

}  // namespace docent::apps
