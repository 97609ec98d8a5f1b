#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "docent/base/random.h"
#include "docent/simulator/crowd/crowd_params.h"
#include "docent/simulator/crowd/person.h"
#include "docent/simulator/crowd/replay.h"
#include "docent/simulator/crowd/steering.h"
#include "docent/simulator/crowd/walkable_floor.h"
#include "docent/simulator/world/world.h"

namespace docent::simulator {

/// Persons per m2 of free floor at a level: empty 0, quiet 0.02, busy 0.08, packed 0.2; nullopt for another name.
[[nodiscard]] std::optional<double> crowd_density(std::string_view level);

/// The visitors of a museum. They stroll, gather, follow the robot, step in its way, line up, block, push and listen
/// (RHINO, sections 1 and 5; Minerva, section 4). They know of the robot what people know: where it is and how it
/// moves, its horn, its voice and its face. The world's recorded people are among them; these know nothing of it.
class Crowd {
 public:
  /// @param floor  of this world
  /// @param count  how many people; 0: nobody. The recorded ones walk in full, even where they are more; the others
  ///               make up the rest on average, and who of them leaves is replaced at an entrance
  Crowd(const World& world, WalkableFloor floor, const CrowdParams& params, std::size_t count, Rng rng,
        const RobotView& robot);

  /// 50 Hz. Every person decides at 10 Hz. O(people * neighbours). @param now [s], @param dt [s]
  void step(double now, double dt, const RobotView& robot);
  void hear_horn(double now);
  /// The robot asks for way, in words.
  void hear_request(double now);
  /// Its face from now on: -1 (angry) .. 1 (happy).
  void see_face(double valence) { valence_ = valence; }
  /// The robot talks until then [s]; a time in the past ends it.
  void hear_speech(double until) { speech_until_ = until; }
  /// Puts people where a scenario wants them; they stay until `until` [s], then behave as the others and leave.
  /// @param heeds  chance that one steps aside at the horn, a blast
  void add_standing(std::span<const Point2> places, double until, std::optional<double> heeds = std::nullopt);
  /// People wait round `at` until the robot comes within sight and 5 m, then press it towards `heading` [rad] in a half
  /// ring, as near as they can. They give way to what comes at them, as all who push.
  void add_pushers(int count, Point2 at, double heading, double until);
  /// Children run about within `within` [m] of `at` and heed neither the robot nor the horn.
  void add_runners(int count, Point2 at, double within, double until);
  /// People come and walk along with the robot until `until` [s], as near as `near` and as far as `far` [m] between the
  /// outlines, all round it but ahead; then they behave as the others and leave.
  void add_escort(int count, double near, double far, double now, double until);
  /// Something was put up or taken away.
  void change_world(const World& world);

  [[nodiscard]] std::span<const Person> people() const { return people_; }
  [[nodiscard]] const WalkableFloor& floor() const { return floor_; }
  /// How many different people there have been.
  [[nodiscard]] std::uint32_t visitors() const { return next_id_; }
  /// The robot's outline presses into a person: they give way unless something is behind them.
  /// @param robot  [m] where its centre would be, did it touch them in their middle
  /// @param reach  [m] sum of both radii. @returns the overlap that remains [m].
  [[nodiscard]] double give_way(std::size_t person, Point2 robot, double reach);

 private:
  struct Group {
    int attraction = -1;
    double until = 0.0;
  };
  struct Sight {
    Point2 offset;      ///< [m] from the person to the robot
    double away = 0.0;  ///< [m]
    double gap = 0.0;   ///< [m] between the outlines
    bool in_sight = false;
  };

  [[nodiscard]] Person new_person(double now);
  /// Draws how they are built, by what is known of them.
  void build(Person& person);
  /// A free place within `within` [m] of `centre`, apart from the others; the centre where there is none.
  [[nodiscard]] Point2 place_near(Point2 centre, double within);
  void place_anywhere(Person& person, const RobotView& robot, bool near_robot);
  void enter(Person& person);
  void let_recorded_in(double now, const RobotView& robot);
  void sort_into_cells();
  /// Indices in outlines_; they live until the next call.
  [[nodiscard]] std::span<const std::uint32_t> outlines_within(Point2 point, double range);

  // decisions.cpp
  void decide(std::size_t index, double now);
  [[nodiscard]] bool gets_nowhere(Person& person, Point2 desired, double now);
  [[nodiscard]] bool minds_robot(const Person& person, const Sight& sight) const;
  void take_interest(std::size_t index, const Sight& sight, double now);
  /// A displeased face makes who is in its way step aside.
  void look_at_face(Person& person, const Sight& sight, double now);
  /// The robot means this person: ahead of it and within `range` [m], or beside it within `near` [m].
  [[nodiscard]] bool is_meant(const Person& person, double range, double near) const;
  void form_wall(std::size_t leader, double now);
  void step_aside(Person& person, const Sight& sight, double now);
  void return_to_strolling(Person& person, double now, bool bored);
  void next_attraction(Person& person, double now);

  // activities.cpp
  [[nodiscard]] Point2 desired_velocity(Person& person, const Sight& sight, double now);
  [[nodiscard]] Point2 looking(Person& person, const Sight& sight, double now);
  [[nodiscard]] Point2 running(Person& person, const Sight& sight, double now);
  [[nodiscard]] Point2 strolling(Person& person, double now);
  [[nodiscard]] Point2 leaving(Person& person, double now);
  [[nodiscard]] Point2 keeping_company(Person& person, const Sight& sight, double now);
  [[nodiscard]] Point2 standing_in_the_way(Person& person, const Sight& sight, double now);
  [[nodiscard]] Point2 escorting(Person& person, double now);
  [[nodiscard]] Point2 pushing(Person& person, const Sight& sight) const;
  [[nodiscard]] Point2 pressing(Person& person, const Sight& sight, double now);
  [[nodiscard]] Point2 romping(Person& person, double now);
  [[nodiscard]] Point2 stepping_aside(const Person& person, const Sight& sight) const;
  [[nodiscard]] std::optional<Point2> walk_to(const Person& person, Point2 goal, double speed) const;
  [[nodiscard]] Point2 robot_ahead(double distance) const;
  [[nodiscard]] FlowField& field(int attraction);
  [[nodiscard]] std::size_t count_of(Activity activity) const;
  void draw_people_near(double now);
  void move(std::size_t index, double dt, const RobotView& robot);
  /// A person who does not walk into the robot comes no nearer to it than a hand's breadth.
  void keep_off(Person& person, Point2& next, const RobotView& robot) const;
  void follow_track(Person& person, double now, double dt) const;
  /// How far [m] somebody's body reaches from their middle in the direction of the unit vector `towards`.
  [[nodiscard]] double reach_to(const Person& person, Point2 towards) const {
    return params_.physique.bodies == Bodies::discs ? person.radius : reach_towards(person.posture(), towards);
  }
  [[nodiscard]] bool ignores_robot(const Person& person) const {
    return person.ignores_robot && now_ >= person.bumped_until;
  }

  World world_;
  CrowdParams params_;
  Rng rng_;
  Rng physique_rng_;
  WalkableFloor floor_;
  Replay replay_;
  std::vector<Walk> waiting_;  ///< recorded people who have not come in yet
  std::vector<Person> people_;
  std::vector<Group> groups_;
  std::vector<FlowField> fields_;  ///< of attractions, then entrances; empty until asked for
  FlowField robot_field_;
  double robot_field_at_ = -1e9;
  std::uint32_t next_id_ = 0;
  int next_group_left_ = 0;  ///< members that the newest group still lacks
  std::uint64_t steps_ = 0;
  double now_ = 0.0;  ///< [s] of the last step
  double speech_until_ = -1.0;
  double valence_ = 0.0;

  std::array<RobotView, 32> seen_{};  ///< ring of what there was to see
  std::size_t seen_count_ = 0;
  RobotView robot_{};  ///< as people believe it to be now

  Point2 cells_low_{};
  int cell_columns_ = 1;
  int cell_rows_ = 1;
  /// What others see of a person while they decide: packed, for the search reads many.
  struct Outline {
    Point2 position;
    Point2 velocity;
    double radius;
    std::size_t person;
  };
  std::vector<Outline> outlines_;          ///< [people] by cell, then by person
  std::vector<std::uint32_t> cell_begin_;  ///< [cells + 1] into outlines_
  std::vector<std::uint32_t> cell_of_;     ///< [people]
  std::vector<std::uint32_t> within_;      ///< of outlines_within
};

}  // namespace docent::simulator
