#pragma once

#include <string>

namespace docent::apps::ablations {

/// Section `evaluation` of robot.yaml: ways to cripple the robot, so that an evaluation shows what the crippled part is
/// for (architecture 10.17). By default nothing is crippled. `docent` refuses the section: it cannot cripple.
struct AblationParams {
  bool blind_to_people = false;    ///< avoid: sees virtual measurements and touch only
  bool without_watches = false;    ///< avoid: takes every sensor and belief for well
  bool misses_carrying = false;    ///< avoid: drives on by what it believed before somebody carried it elsewhere
  bool doubts_odometry = false;    ///< avoid: takes for a jump what the base does every day
  bool dead_reckoning = false;     ///< localize: odometry alone after the first "here"
  bool ignores_reach = false;      ///< localize: holds far readings against what it expects within its reach
  double best_pose_error_x = 0.0;  ///< [m], map: localize publishes the best hypothesis so far off (its cells are true)
  double best_pose_error_y = 0.0;  ///< [m], map: likewise
  double best_pose_error_heading = 0.0;  ///< [deg]: likewise
  bool trusts_dead_sonars = false;       ///< localize: readings of frozen and deaf sonars count as well
  bool best_pose_only = false;           ///< hazards: trusts the likeliest pose
  bool ignores_hazards = false;          ///< hazards, plan, explore: as if there were no hazards and no border
  bool ignores_live_map = false;         ///< plan: with the static map alone
  bool keeps_all_people = false;         ///< people: nobody is ever forgotten, and every thing is a person
  bool without_ladder = false;           ///< executive: it stands before what is in its way
  bool forgets_requests = false;         ///< mission: begins with an empty board whenever it starts
  bool serves_by_arrival = false;        ///< mission: single exhibits in the order in which they were asked for
  bool without_moods = false;            ///< head, executive: a neutral face, and nobody is asked for way
  bool never_gives_up = false;           ///< executive: no directive has a limit, no question a default
  bool without_battery_watch = false;    ///< mission: it never hears of its battery
  bool forgets_tasks = false;            ///< mission: a restart forgets what was under way, and keeps the requests
  bool without_stand_in = false;         ///< mission: nobody decides for a GOLOG program that has failed
  bool stores_at_once = false;           ///< web: what is stored is stored on the thread that takes the stop
  bool never_explores = false;           ///< attract: does what it knows best and nothing else
  bool ignores_reward = false;           ///< attract: remembers each phase as worth nothing
  bool forgets_touch = false;            ///< avoid, map: what only touch finds is forgotten at once
  bool takes_things_for_people = false;  ///< executive: whatever stands on the charger is somebody in its way
  bool calls_nobody = false;             ///< mission: the staff are never called
  template <class V>
  void visit(V& v) {
    v("blind_to_people", blind_to_people);
    v("without_watches", without_watches);
    v("misses_carrying", misses_carrying);
    v("doubts_odometry", doubts_odometry);
    v("dead_reckoning", dead_reckoning);
    v("ignores_reach", ignores_reach);
    v("best_pose_error_x", best_pose_error_x);
    v("best_pose_error_y", best_pose_error_y);
    v("best_pose_error_heading", best_pose_error_heading);
    v("trusts_dead_sonars", trusts_dead_sonars);
    v("best_pose_only", best_pose_only);
    v("ignores_hazards", ignores_hazards);
    v("ignores_live_map", ignores_live_map);
    v("keeps_all_people", keeps_all_people);
    v("without_ladder", without_ladder);
    v("forgets_requests", forgets_requests);
    v("serves_by_arrival", serves_by_arrival);
    v("without_moods", without_moods);
    v("never_gives_up", never_gives_up);
    v("without_battery_watch", without_battery_watch);
    v("forgets_tasks", forgets_tasks);
    v("without_stand_in", without_stand_in);
    v("stores_at_once", stores_at_once);
    v("never_explores", never_explores);
    v("ignores_reward", ignores_reward);
    v("forgets_touch", forgets_touch);
    v("takes_things_for_people", takes_things_for_people);
    v("calls_nobody", calls_nobody);
  }
  /// Names of what is not as by default, with ", " between them.
  [[nodiscard]] std::string crippled() const;
};

}  // namespace docent::apps::ablations
