#include "docent/modules/host/registry.h"

#include <array>

#include "docent/modules/drive/avoid_module.h"
#include "docent/modules/drive/hazards_module.h"
#include "docent/modules/drive/plan_module.h"
#include "docent/modules/drive/robot_module.h"
#include "docent/modules/edge/record_module.h"
#include "docent/modules/edge/scene_camera_module.h"
#include "docent/modules/edge/visualize_module.h"
#include "docent/modules/exploration/explore_module.h"
#include "docent/modules/eyes/capture_module.h"
#include "docent/modules/eyes/ceiling_module.h"
#include "docent/modules/eyes/dock_module.h"
#include "docent/modules/eyes/sight_module.h"
#include "docent/modules/eyes/things_module.h"
#include "docent/modules/guide/buttons_module.h"
#include "docent/modules/guide/executive_module.h"
#include "docent/modules/guide/head_module.h"
#include "docent/modules/guide/mission_module.h"
#include "docent/modules/guide/sound_module.h"
#include "docent/modules/office/office_module.h"
#include "docent/modules/office/voice_module.h"
#include "docent/modules/perception/calibrate_module.h"
#include "docent/modules/perception/localize_module.h"
#include "docent/modules/perception/map_module.h"
#include "docent/modules/perception/people_module.h"
#include "docent/modules/web/web_module.h"

namespace docent::modules {
namespace {

// clang-format off
constexpr std::array kModules{
    ModuleEntry{.name = "avoid", .make = make_avoid, .parameters = parameters_of_avoid, .is_urgent = true, .explores = true, .marks = true},
    ModuleEntry{.name = "hazards", .make = make_hazards, .parameters = parameters_of_hazards, .is_urgent = true, .explores = true, .marks = true},
    ModuleEntry{.name = "localize", .make = make_localize, .parameters = parameters_of_localize, .is_prompt = true, .keeps_cache = true, .marks = true},
    ModuleEntry{.name = "calibrate", .make = make_calibrate, .parameters = parameters_of_calibrate, .explores = true, .marks = true},
    ModuleEntry{.name = "map", .make = make_map, .parameters = parameters_of_map, .marks = true},
    ModuleEntry{.name = "people", .make = make_people, .parameters = parameters_of_people, .explores = true, .marks = true},
    ModuleEntry{.name = "capture", .make = make_capture, .parameters = parameters_of_capture, .is_prompt = true, .explores = true, .marks = true},
    ModuleEntry{.name = "ceiling", .make = make_ceiling, .parameters = parameters_of_ceiling},
    ModuleEntry{.name = "sight", .make = make_sight, .parameters = parameters_of_sight, .is_prompt = true, .explores = true, .marks = true},
    ModuleEntry{.name = "dock", .make = make_dock, .parameters = parameters_of_dock, .is_prompt = true},
    ModuleEntry{.name = "things", .make = make_things, .parameters = parameters_of_things},
    ModuleEntry{.name = "plan", .make = make_plan, .parameters = parameters_of_plan},
    ModuleEntry{.name = "record", .make = make_record, .parameters = parameters_of_record, .is_prompt = true, .sees_truth = true, .explores = true, .marks = true},
    ModuleEntry{.name = "robot", .make = make_robot, .parameters = parameters_of_robot, .is_urgent = true, .explores = true, .marks = true},
    ModuleEntry{.name = "sound", .make = make_sound, .parameters = parameters_of_sound},
    ModuleEntry{.name = "buttons", .make = make_buttons, .parameters = parameters_of_buttons},
    ModuleEntry{.name = "mission", .make = make_mission, .parameters = parameters_of_mission},
    ModuleEntry{.name = "office", .make = make_office, .parameters = parameters_of_office},
    ModuleEntry{.name = "voice", .make = make_voice, .parameters = parameters_of_voice},
    ModuleEntry{.name = "executive", .make = make_executive, .parameters = parameters_of_executive},
    ModuleEntry{.name = "web", .make = make_web, .parameters = parameters_of_web, .explores = true, .marks = true},
    ModuleEntry{.name = "visualize", .make = make_visualize, .parameters = parameters_of_visualize, .explores = true, .marks = true},
    ModuleEntry{.name = "head", .make = make_head, .parameters = parameters_of_head, .explores = true, .marks = true},
    ModuleEntry{.name = "scene_camera", .make = make_scene_camera, .parameters = parameters_of_scene_camera},
    ModuleEntry{.name = "explore", .make = make_explore, .parameters = parameters_of_explore, .explores = true, .guides = false},
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
