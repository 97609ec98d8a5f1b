#include "docent/apps/laboratory/laboratory.h"

#include "docent/apps/laboratory/ablations/crippled_robot.h"
#include "docent/apps/laboratory/attract/attract_command.h"
#include "docent/apps/laboratory/crowd/crowd_command.h"
#include "docent/apps/laboratory/evaluate/evaluate_command.h"
#include "docent/apps/laboratory/follow_ceiling/follow_ceiling_command.h"
#include "docent/apps/laboratory/learn/learn_command.h"
#include "docent/apps/laboratory/plan/plan_command.h"
#include "docent/apps/laboratory/rooms/rooms_command.h"
#include "docent/apps/laboratory/score_map/score_map_command.h"
#include "docent/apps/laboratory/take_pictures/take_pictures_command.h"
#include "docent/apps/laboratory/train_sonar/train_sonar_command.h"
#include "docent/apps/replay/replay_command.h"
#include "docent/apps/simulate/explore_command.h"
#include "docent/apps/simulate/simulate_command.h"
#include "docent/apps/up/run_command.h"

namespace docent::apps::laboratory {

Program docent_lab(const std::string& version) {
  const auto robot = std::make_shared<ablations::CrippledRobot>();
  return {
      .name = "docent-lab",
      .meaning = "Docent's laboratory: measures the robot and learns its models.",
      .version = version,
      .groups =
          {{"As docent has them, also with a robot that section `evaluation` cripples",
            {with_robot(simulate_command::add_simulate_command, robot),
             with_robot(simulate_command::add_explore_command, robot),
             with_robot(replay_command::add_replay_command, robot), with_robot(up_command::add_run_command, robot)}},
           {"Measure",
            {evaluate_command::add_evaluate_command, with_robot(crowd_command::add_crowd_command, robot),
             plan_command::add_plan_command}},
           {"Look at maps", {rooms_command::add_rooms_command, score_map_command::add_score_map_command}},
           {"See",
            {take_pictures_command::add_take_pictures_command, follow_ceiling_command::add_follow_ceiling_command}},
           {"Learn",
            {learn_command::add_learn_command, train_sonar_command::add_train_sonar_command,
             with_robot(attract_command::add_attract_command, robot)}}},
      .other = {},
      .others = {},
      .examples = {{"simulate", "simulate --museum museums/bonn --crowd busy --seed 7 --report report.json"},
                   {"explore", "explore --museum museums/bonn --out explored"},
                   {"replay", "replay run.mcap --museum museums/bonn --modules localize"},
                   {"run", "run localize --museum museums/bonn"},
                   {"evaluate", "evaluate run.mcap --report again.json"},
                   {"crowd", "crowd --seed 1 --density 0.4"},
                   {"plan", "plan --museum museums/bonn --from 9,3.6 --to 26.9,9.3"},
                   {"rooms", "rooms --museum museums/bonn --picture rooms.svg"},
                   {"score-map", "score-map --map explored/map.yaml --world museums/bonn/simulation.yaml"},
                   {"learn-sensor-model", "learn-sensor-model --museum museums/bonn --log run.mcap --out learned.yaml"},
                   {"take-pictures", "take-pictures --opening 15 --out build/hall"},
                   {"train-sonar", "train-sonar --out sonar.json"},
                   {"attract", "attract --seed 1 --picture attract.svg"}}};
}

}  // namespace docent::apps::laboratory
