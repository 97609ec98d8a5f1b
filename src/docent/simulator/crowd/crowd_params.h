#pragma once

#include "docent/simulator/physique/physique.h"

namespace docent::simulator {

/// What people are like. Shares are of all people, rates are per second and person near the robot.
struct CrowdParams {
  double child_share = 0.15;
  double run_rate = 0.02;   ///< [1/s] a child starts to run about
  double dwell_min = 15.0;  ///< [s] before an exhibit
  double dwell_max = 60.0;
  double stay_min = 600.0;  ///< [s] in the museum
  double stay_max = 2400.0;
  double back_turned_share = 0.3;    ///< of those who look at an exhibit: do not notice a robot behind them
  double inattentive_share = 0.03;   ///< of the time: notices the robot only when it is near
  double inattentive_notices = 0.8;  ///< [s] before they would touch

  double interest_range = 6.0;  ///< [m] within which, in sight, the robot tempts
  double follow_rate = 0.015;
  double curious_rate = 0.05;  ///< steps in its way for 3 to 15 s
  double block_rate = 0.005;   ///< stands in its way for 45 to 180 s
  double wall_rate = 0.006;    ///< three to five people line up in its way for 10 to 40 s
  double push_rate = 0.0025;   ///< walks into it, for 3 to 10 s
  double listen_share = 0.5;   ///< comes to listen when it begins to talk
  double boredom_min = 60.0;   ///< [s] after such an adventure
  double boredom_max = 240.0;

  double horn_range = 5.0;    ///< [m] who is ahead or near hears that it is meant
  double horn_effect = 0.75;  ///< chance that an ordinary person steps aside, a blast
  double horn_effect_wall = 0.5;
  double horn_effect_block = 0.3;
  double horn_reward = 0.15;  ///< chance to come back and have it blow again

  // Our own model of what asking and a face do: nothing was measured, so what it brings is no evidence about people. It
  // takes from [Minerva2000] 6 and 7 that people understood the moods, and cleared the way faster than for RHINO, which
  // had only its horn.
  double ask_range = 3.0;   ///< [m] who is ahead or near hears that they are asked: nearer than the horn, it is a voice
  double ask_effect = 0.5;  ///< chance that an ordinary person steps aside when asked before a neutral face, less than
                            ///< at a blast of the horn: it does not startle
  double ask_effect_firm = 0.25;  ///< of those who stand in its way on purpose, likewise
  double mood_effect = 0.5;       ///< both are multiplied by 1 - mood_effect valence: by 0.5 (happy) to 1.5 (angry)
  double face_rate = 0.05;  ///< [1/s] someone in its way steps aside unasked before an angry face; in proportion before
                            ///< a less displeased one, never before a neutral or happy one

  double acceleration = 2.5;       ///< [m/s^2]
  double braking = 3.0;            ///< [m/s^2]
  double reaction_time = 0.3;      ///< [s] they see the robot as it was so long ago, carried forward
  double ignoring_share = 0.0;     ///< of all people: walk and stand as if no robot were there, until they touch it
  double heedless_share = 0.0;     ///< of all people: likewise, with a phone in hand or their backs turned; of these,
                                   ///< children run about most of the time
  double heedless_run_rate = 0.2;  ///< [1/s] such a child starts to run about
  double near_share = 0.0;         ///< of all people, kept within 5 m of the robot; packed: 0.25

  PhysiqueParams physique{.bodies = Bodies::discs};  ///< how they are built: legs where a run asks for them
};

}  // namespace docent::simulator
