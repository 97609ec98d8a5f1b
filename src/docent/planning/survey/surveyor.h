#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "docent/planning/exploration/exploration_drive.h"
#include "docent/planning/exploration/explorer.h"
#include "docent/planning/mark_alignment/mark_alignment.h"
#include "docent/planning/survey/keyframes.h"
#include "docent/planning/survey/normal_pose.h"
#include "docent/planning/survey/survey_frame.h"
#include "docent/planning/survey/survey_map.h"
#include "docent/planning/survey/survey_store.h"
#include "docent/planning/survey/surveyor_params.h"
#include "docent/planning/survey/walkers.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::planning {

/// How far a survey has come. mapping: the robot stands, and the map is made of what it has seen; stranded: the map is
/// made, but the robot stands elsewhere than at its home.
enum class SurveyPhase { starting, exploring, returning, mapping, done, stranded };
constexpr auto words_of(SurveyPhase) {
  return std::array{"starting", "exploring", "returning", "mapping", "done", "stranded"};
}

/// The building, as far as people know it before there is a map.
struct SurveySite {
  Pose2 home;                    ///< where the robot sets out, map
  std::vector<Polygon> hazards;  ///< [m], map: what no sensor sees
  Polygon area;                  ///< [m], map: the robot's centre stays inside; empty: anywhere
};

/// The robot that goes about in it.
struct SurveyBody {
  std::vector<Pose2> base_from_laser;  ///< [lasers], at least one
  double radius = 0.265;               ///< [m], > 0
  motion_models::BaseReach reach{};    ///< more than that is a jump of its odometry
};

/// Maps a building: drives about in it by itself, or lets itself be driven, and makes the map when it has seen all or
/// is told to. It finds its place in the map that it is making. Deterministic; knows no wall clock.
class Surveyor {
 public:
  /// Goes on with a survey that `store` knows of a moment ago. @pre params are valid
  Surveyor(const SurveyorParams& params, SurveySite site, const SurveyBody& body, SurveyStore store, Time now);

  // What the robot senses and is told.
  void move(Time stamp, const collision_avoidance::BaseState& state) { frame_.move(stamp, state); }
  void note_people(std::span<const TrackedPerson> people);  ///< in odometry's own frame
  /// What avoidance says. @param fault  in words, what is broken or missing that it stands for; empty: nothing
  void note_hindrance(ExplorationDrive::Hindrance hindrance, std::string fault = {}) {
    hindrance_ = hindrance;
    hindering_fault_ = std::move(fault);
  }
  void note_stop(bool is_stopped) { is_stopped_ = is_stopped; }  ///< somebody has pressed the stop button
  void note_steering(Time now) { steered_ = now; }               ///< somebody steers by hand
  /// A laser is found to be mounted elsewhere: what was drawn so far is forgotten, where that matters.
  void mount(std::size_t laser, const Pose2& base_from_laser);
  void keep(std::size_t laser, Time stamp, const sensor_models::LaserReading& reading) {
    keyframes_.keep(laser, stamp, reading);
  }
  /// @returns whether it still could be obeyed. To finish before anything was seen waits until something is.
  bool obey(ExplorationOrder order);

  // What it does, in the order of a sweep, of a second, of the end.
  /// The newest sweeps of all lasers, and which beams ended on people; none: nothing to compare them with.
  struct Sight {
    Keyframes::Look look;  ///< in odometry's own frame
    Pose2 map_from_base;
    std::vector<sensor_models::BeamOrigin> origins;  ///< [beams of the look]
  };
  [[nodiscard]] std::optional<Sight> sight() const;
  /// Adds the newest sweeps to the map, if they are worth it. @returns whether they are
  bool add_moment();
  enum class Step { none, looked, planned, ended };
  /// Once a second: looks at the map so far, plans anew where it drives by itself, keeps its place.
  /// @returns ended: it was told to finish; planned: see `way`, and perhaps it has arrived and `is_done`
  Step plan(Time now);
  /// When it is done and stands: makes the map and saves it. @returns none: see `fault`
  std::optional<OccupancyGrid> finish(Time now);

  // What it says.
  [[nodiscard]] bool is_done() const { return is_done_; }  ///< no more is seen
  [[nodiscard]] bool has_odometry() const { return frame_.odom_from_base().has_value(); }
  [[nodiscard]] bool has_begun() const { return frame_.map_from_odom().has_value(); }
  [[nodiscard]] const std::string& fault() const { return fault_; }  ///< why there is no map in the end
  /// What a technician should look to: it was set down elsewhere than it was told, or nobody knows; empty: nothing.
  [[nodiscard]] std::string plea() const;
  /// Where it is, and where odometry has it then; none before the first moment.
  struct Place {
    NormalPose pose;
    Pose2 odom_from_base;  ///< in odometry's own frame, as are the two below
  };
  [[nodiscard]] std::optional<Place> place() const;
  /// The way ahead [m], odom; empty: stand.
  [[nodiscard]] ExplorationDrive::Ahead ahead() const;
  [[nodiscard]] const std::vector<Point2>& way() const { return drive_.way(); }  ///< [m], map: all of it
  [[nodiscard]] OccupancyGrid map() const { return map_.drawn(); }               ///< as it is drawn so far
  struct Report {
    SurveyPhase phase = SurveyPhase::starting;
    ExplorationOrder order = ExplorationOrder::by_itself;
    double known_m2 = 0.0;                       ///< free floor
    std::size_t frontier = 0;                    ///< unknown cells that it can go to
    double way_m = 0.0;                          ///< driven
    std::size_t loops = 0;                       ///< closed
    std::vector<Explorer::Unreached> unreached;  ///< in the end
    std::string map;                             ///< its file; empty: it is not made yet
    std::string warning;                         ///< why it is not to be trusted; empty: it is
    double mark_margin = 0.0;                    ///< [m] that it keeps off what people have marked near it, too
  };
  [[nodiscard]] Report report() const;

 private:
  [[nodiscard]] SurveyPhase phase() const;
  void align_marks();
  [[nodiscard]] bool is_held(Time now) const;
  [[nodiscard]] ExplorationDrive::Hindrance hindrance() const;
  void keep_place(Time now) const;
  [[nodiscard]] std::string why_away(double metres) const;

  SurveyorParams params_;
  double body_radius_;
  SurveyStore store_;
  SurveyFrame frame_;
  Keyframes keyframes_;
  Walkers walkers_;
  SurveyMap map_;
  MarkAlignment alignment_;
  Pose2 start_;  ///< site, as it was told
  bool has_marks_ = false;
  std::size_t aligned_moments_ = 0;
  bool is_away_ = false;  ///< in the end
  ExplorationDrive drive_;
  ExplorationOrder order_;
  ExplorationDrive::Hindrance hindrance_ = ExplorationDrive::Hindrance::unknown;
  std::string hindering_fault_;
  bool is_stopped_ = false;
  std::optional<Time> steered_;
  bool is_done_ = false;
  std::string file_;  ///< of the map
  std::string warning_;
  std::string fault_;
  std::vector<Explorer::Unreached> unreached_;
};

}  // namespace docent::planning
