#include <map>
#include <memory>
#include <string>

#include "docent/apps/config/config_command.h"
#include "docent/apps/doctor/doctor_command.h"
#include "docent/apps/eyes/calibrate_camera_command.h"
#include "docent/apps/eyes/map_ceiling_command.h"
#include "docent/apps/eyes/objects_command.h"
#include "docent/apps/gateway/gateway_command.h"
#include "docent/apps/golog/golog_command.h"
#include "docent/apps/localize/calibrate_command.h"
#include "docent/apps/localize/localize_command.h"
#include "docent/apps/localize/map_command.h"
#include "docent/apps/museum/check_command.h"
#include "docent/apps/museum/museum_command.h"
#include "docent/apps/museum/office_command.h"
#include "docent/apps/museum/survey_command.h"
#include "docent/apps/replay/replay_command.h"
#include "docent/apps/ros/ros_command.h"
#include "docent/apps/shared/laboratory_commands.h"
#include "docent/apps/shared/program.h"
#include "docent/apps/shared/robot_maker.h"
#include "docent/apps/simulate/explore_command.h"
#include "docent/apps/simulate/simulate_command.h"
#include "docent/apps/state/state_command.h"
#include "docent/apps/up/run_command.h"
#include "docent/apps/up/setup_command.h"
#include "docent/apps/up/up_command.h"
#include "docent/apps/voice/listen_command.h"
#include "docent/apps/web_account/web_account_command.h"

namespace {

/// One of each command, for its help.
std::map<std::string, std::string> examples() {
  return {{"simulate", "simulate --museum museums/bonn --crowd busy --seed 7 --report report.json"},
          {"explore", "explore --museum museums/bonn --out explored"},
          {"up", "up --sim --museum museums/bonn"},
          {"doctor", "doctor --museum my-museum --robot robot.yaml"},
          {"web-account", "web-account add ada --role operator"},
          {"web-account add", "web-account add mary --role moderator"},
          {"web-account passwd", "web-account passwd mary"},
          {"web-account remove", "web-account remove mary"},
          {"web-account list", "web-account list"},
          {"state", "state check"},
          {"state check", "state check"},
          {"state backup", "state backup --museum my-museum --to /media/stick/docent-backup"},
          {"state restore", "state restore --from 20261129"},
          {"gateway", "gateway --from museum:8090 --key uplink.key --address 0.0.0.0 --port 8080"},
          {"setup", "setup my-museum"},
          {"museum", "museum map.yaml --out my-museum --picture my-museum.png"},
          {"office", "office --seed 7 --out office-7 --pictures"},
          {"survey", "survey --world museums/bonn/simulation.yaml --seed 1995 --out survey"},
          {"check", "check museums/bonn"},
          {"golog", "golog check museums/bonn"},
          {"golog check", "golog check museums/bonn"},
          {"golog plan", "golog plan museums/bonn --request zuse --request airbus"},
          {"golog trace", "golog trace museums/bonn --request zuse"},
          {"localize", "localize --map map.yaml --log drive.mcap"},
          {"map", "map --log drive.mcap --out map"},
          {"calibrate", "calibrate --log drive.mcap --robot robot.yaml"},
          {"replay", "replay run.mcap --museum museums/bonn --modules localize"},
          {"learn-objects", "learn-objects pictures --out objects.json"},
          {"map-ceiling", "map-ceiling drive --out museums/bonn/ceiling.yaml --pictures stages"},
          {"calibrate-camera", "calibrate-camera boards --board 9x6 --square 0.025 --out lens.yaml"},
          {"listen", "listen said.wav --museum museums/bonn"},
          {"name-objects", "name-objects --book objects.json photo.jpg"},
          {"config", "config avoid > robot.yaml"},
          {"ros", "ros check --robot robot.yaml"},
          {"ros check", "ros check --robot robot.yaml"},
          {"run", "run localize --museum museums/bonn"}};
}

}  // namespace

int main(int argc, char** argv) {
  using namespace docent::apps;
  const auto whole = std::make_shared<RobotMaker>();
  return run(
      {.name = "docent",
       .meaning = "Docent: an autonomous museum tour guide.",
       .version = DOCENT_VERSION,
       .groups = {{"Drive through a museum",
                   {with_robot(simulate_command::add_simulate_command, whole),
                    with_robot(simulate_command::add_explore_command, whole), up_command::add_up_command,
                    doctor_command::add_doctor_command, web_account_command::add_web_account_command,
                    state_command::add_state_command, gateway_command::add_gateway_command}},
                  {"Make a museum",
                   {up_command::add_setup_command, museum_command::add_museum_command,
                    museum_command::add_office_command, museum_command::add_survey_command,
                    museum_command::add_check_command, golog_command::add_golog_command}},
                  {"Look at recordings and pictures",
                   {localize_command::add_localize_command, localize_command::add_map_command,
                    localize_command::add_calibrate_command, with_robot(replay_command::add_replay_command, whole),
                    objects_command::add_learn_objects_command, objects_command::add_name_objects_command,
                    map_ceiling_command::add_map_ceiling_command,
                    calibrate_camera_command::add_calibrate_camera_command, listen_command::add_listen_command}},
                  {"Tune", {config_command::add_config_command}},
                  {"Put it into a robot of your own",
                   {ros::add_ros_command, with_robot(up_command::add_run_command, whole)}}},
       .other = "docent-lab",
       .others = {kLaboratoryCommands.begin(), kLaboratoryCommands.end()},
       .examples = examples()},
      argc, argv);
}
