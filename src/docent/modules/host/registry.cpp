#include "docent/modules/host/registry.h"

#include <array>

#include "docent/modules/drive/avoid_module.h"
#include "docent/modules/drive/hazards_module.h"
#include "docent/modules/drive/plan_module.h"
#include "docent/modules/drive/robot_module.h"
#include "docent/modules/edge/record_module.h"
#include "docent/modules/edge/scene_camera_module.h"
#include "docent/modules/edge/visualize_module.h"
#include "docent/modules/guide/buttons_module.h"
#include "docent/modules/guide/executive_module.h"
#include "docent/modules/guide/head_module.h"
#include "docent/modules/guide/mission_module.h"
#include "docent/modules/guide/sound_module.h"
#include "docent/modules/perception/localize_module.h"
#include "docent/modules/perception/map_module.h"
#include "docent/modules/perception/people_module.h"
#include "docent/modules/web/web_module.h"

namespace docent::modules {
namespace {

// clang-format off
constexpr std::array kModules{
    ModuleEntry{"avoid", make_avoid, parameters_of_avoid, true},
    ModuleEntry{"hazards", make_hazards, parameters_of_hazards},
    ModuleEntry{"localize", make_localize, parameters_of_localize, false, false, true},
    ModuleEntry{"map", make_map, parameters_of_map},
    ModuleEntry{"people", make_people, parameters_of_people},
    ModuleEntry{"plan", make_plan, parameters_of_plan},
    ModuleEntry{"record", make_record, parameters_of_record, false, true},
    ModuleEntry{"robot", make_robot, parameters_of_robot, true},
    ModuleEntry{"sound", make_sound, parameters_of_sound},
    ModuleEntry{"buttons", make_buttons, parameters_of_buttons},
    ModuleEntry{"mission", make_mission, parameters_of_mission},
    ModuleEntry{"executive", make_executive, parameters_of_executive},
    ModuleEntry{"web", make_web, parameters_of_web},
    ModuleEntry{"visualize", make_visualize, parameters_of_visualize},
    ModuleEntry{"head", make_head, parameters_of_head},
    ModuleEntry{"scene_camera", make_scene_camera, parameters_of_scene_camera},
};
// clang-format on

}  // namespace

std::span<const ModuleEntry> all_modules() { return kModules; }

const ModuleEntry* find_module(std::string_view name) {
  for (const auto& entry : kModules) {
    if (entry.name == name) return &entry;
  }
  return nullptr;
}

}  // namespace docent::modules
