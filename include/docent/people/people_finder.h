#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/people/breadth.h"
#include "docent/people/free_memory.h"
#include "docent/people/groups.h"
#include "docent/people/people_tracker.h"
#include "docent/people/sightlines.h"
#include "docent/people/standing_things.h"

namespace docent::people {

/// Section `people`: who stands and walks round the robot.
struct PeopleFinderParams {
  SightingParams sightings;     ///< what looks like a person
  PeopleTrackerParams tracker;  ///< from sightings to persons
  StandingThingParams things;   ///< what stands too long is a thing
  BreadthParams breadth;        ///< what is broader than people here is a thing
  GroupParams groups;           ///< who belongs together
  bool keeps_all = false;       ///< crippled, for evaluation: nobody is ever forgotten, and every thing is a person
  template <class V>
  void visit(V& v) {
    v("sightings", sightings);
    v("tracker", tracker);
    v("things", things);
    v("breadth", breadth);
    v("groups", groups);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Finds and follows the people round the robot, sweep by sweep, in odometry's frame. While the robot knows its place,
/// what the map does not hold may be people, and what has stood in one place of the map for long is none; while it does
/// not, those are followed who were known before, and those who move.
class PeopleFinder {
 public:
  /// @pre params are valid
  explicit PeopleFinder(const PeopleFinderParams& params);

  /// Times must not fall. `map_from_odom`: while the robot knows its place. O(beams * cells a beam + tracks^2).
  void update(const PeopleSweep& sweep, const std::optional<Pose2>& map_from_odom, Time time);
  [[nodiscard]] const std::vector<TrackedPerson>& people() const { return people_; }  ///< odom; by falling age
  [[nodiscard]] const std::vector<std::uint32_t>& groups() const { return groups_; }  ///< [people], see Groups
 private:
  void watch_things(const Sightlines& sightlines, const Pose2& map_from_odom, const Pose2& odom_from_base, Time time);
  void learn_breadth(Time time);
  [[nodiscard]] bool is_person(const PersonTrack& track, const std::optional<Pose2>& map_from_odom) const;

  PeopleFinderParams params_;
  FreeMemory memory_;
  PeopleTracker tracker_;
  StandingThings things_;
  Breadth breadth_;
  Groups grouping_;
  std::optional<Pose2> odom_from_base_;  ///< of the last sweep
  std::vector<TrackedPerson> people_;
  std::vector<std::uint32_t> groups_;
};

}  // namespace docent::people
