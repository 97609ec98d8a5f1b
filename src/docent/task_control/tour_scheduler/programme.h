#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/task_control/travel_times/travel_distance.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::task_control {

/// How long the texts of an exhibit last when they are spoken.
struct SpokenLength {
  double short_s = 0.0;  ///< [s] title and short text
  double long_s = 0.0;   ///< [s] 0: there is no long text
};

/// What the scheduler must know of an exhibit.
struct ProgrammeExhibit {
  std::string id;
  Pose2 pose;                     ///< map_from_base where the robot stands to show it
  std::vector<Pose2> viewpoints;  ///< other places to show it from; Web visitors may choose one
  double speech_s = 15.0;         ///< [s] title and short text, spoken
  bool web_only = false;
  std::vector<std::string> next{};               ///< exhibits that make sense right after this one (sensible_next)
  double long_s = 0.0;                           ///< [s] the long text, spoken; 0: there is none
  std::map<std::string, SpokenLength> spoken{};  ///< by language; speech_s and long_s for those that are not there
  bool is_point = false;  ///< no exhibit of the museum: a point on the map or a room for which somebody wishes

  /// Where to stand for the viewpoint of this number; -1: for the exhibit's own place.
  [[nodiscard]] const Pose2& place(int viewpoint) const {
    return viewpoint < 0 ? pose : viewpoints.at(static_cast<std::size_t>(viewpoint));
  }
  [[nodiscard]] SpokenLength length_in(const std::string& language) const;
};

/// Where a wish for a point on the map wants the robot.
struct PointWish {
  Point2 place;                    ///< [m], map
  std::optional<Angle> heading{};  ///< to take there; nullopt: that in which it comes
};
/// "x,y" or "x,y,heading" [m, rad], map; nullopt: it is no such text.
[[nodiscard]] std::optional<PointWish> point_of(const std::string& target);
/// The same text for the same place, to the centimetre and the hundredth of a radian.
[[nodiscard]] std::string point_name(const PointWish& wish);

/// What the scheduler must know of a tour.
struct ProgrammeTour {
  std::string id;
  std::vector<std::string> exhibits;  ///< fixed order; empty for a composed tour
  double target_s = 0.0;              ///< [s] > 0: composed on the fly to last so long
};

/// Where the robot goes in a room.
struct ProgrammeRoom {
  std::string id;
  Point2 place;  ///< [m], map
};

/// The rooms that the robot can get to, in the order of a walk through all of them.
struct Rooms {
  std::vector<ProgrammeRoom> rooms;
  std::function<int(Point2)> room_at{};  ///< number of the room of a point; -1: in none

  [[nodiscard]] const ProgrammeRoom* find(const std::string& id) const;
  /// The one after that of a point in the walk, after the last the first; nullptr: there is no other.
  [[nodiscard]] const ProgrammeRoom* after(Point2 point) const;
};

/// What a museum offers.
struct Programme {
  std::vector<ProgrammeExhibit> exhibits;
  std::vector<ProgrammeTour> tours;
  std::vector<std::string> languages{"en"};  ///< the first is the museum's own
  Pose2 home;
  std::optional<Pose2> charger;
  double farewell_s = 4.0;  ///< [s] what is said at the end of a tour
  /// Whether the robot has room at a point [m, map]; empty: everywhere.
  std::function<bool(Point2)> has_room{};
  /// To cut a map into rooms takes a while: asked for when somebody wishes for one; empty: there are none.
  std::function<const Rooms&()> rooms{};

  [[nodiscard]] const ProgrammeExhibit* find_exhibit(const std::string& id) const;
  [[nodiscard]] const ProgrammeTour* find_tour(const std::string& id) const;
};

/// One stop that somebody wishes for: an exhibit, seen from a viewpoint of it or (-1) from anywhere.
struct WishedStop {
  std::string exhibit_id;
  int viewpoint = -1;
  friend bool operator==(const WishedStop&, const WishedStop&) = default;
};

/// The name of a stop among places: the exhibit's id, with /NUMBER behind it for one of its viewpoints.
[[nodiscard]] std::string place_name(const WishedStop& stop);
/// The name of the nearest place where the robot stands, `kAtPlace` m around: of a stop, "home" or "charger"; empty: it
/// is at none. O(places).
[[nodiscard]] std::string place_at(const Programme& programme, Point2 position);
inline constexpr double kAtPlace = 0.7;  ///< [m] as near as a robot counts as at home

/// The same pose but for rounding.
[[nodiscard]] bool is_same(const Pose2& a, const Pose2& b);

/// Something that happened, for the history (docs/terminology.md, Events).
struct Happening {
  EventKind kind{};
  std::string subject;
  std::string detail;
  double value = 0.0;
};

}  // namespace docent::task_control
