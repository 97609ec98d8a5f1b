#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/task_control/office/view_plan.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::task_control {

/// What may be ordered of a robot in an office; confirm: done, by whoever stands before it.
enum class OfficeOrderKind { deliver, tidy, confirm, stop };
constexpr auto words_of(OfficeOrderKind) { return std::array{"deliver", "tidy", "confirm", "stop"}; }

/// How an order goes.
enum class OfficePhase {
  idle,
  driving,       ///< a delivery is under way
  handing_over,  ///< it is there, and waits until somebody has taken it
  looking,       ///< it drives from look to look
  approaching,   ///< it drives to something that it has seen
  checking,      ///< it stands before it and looks again
  asking,        ///< it points at it, and waits until somebody has put it into its bin
  to_bin,        ///< its bin is full, or all is done
  emptying,      ///< it waits until somebody has emptied its bin
  done,
  failed
};
constexpr auto words_of(OfficePhase) {
  return std::array{"idle",   "driving", "handing_over", "looking", "approaching", "checking",
                    "asking", "to_bin",  "emptying",     "done",    "failed"};
}

struct OfficeParams {
  std::vector<std::string> objects{"can", "wad"};  ///< of the object book, that are tidied up
  int bin_holds = 3;                               ///< >= 1 things in the bin that it brings ([Buhmann1995])
  std::string bin_room;                            ///< where the bin is emptied; empty: where the robot is at home
  double hand_over_s = 60.0;                       ///< [s] > 0 that a delivery waits for somebody
  double ask_s = 25.0;                             ///< [s] > 0 that it waits for a thing to be put in
  double empty_s = 120.0;                          ///< [s] > 0 that it waits for its bin to be emptied
  double check_s = 3.0;                            ///< [s] >= 0 that it looks at a thing from near, before it asks
  double settle_s = 1.2;                           ///< [s] >= 0 that it stands at each look
  double gone_s = 3.0;                             ///< [s] > 0 without the thing: somebody has taken it, button or not
  double before_thing = 1.15;                      ///< [m] > 0 from the robot's centre to what it points at
  ViewPlanParams view;                             ///< where it stands to look for things
  template <class V>
  void visit(V& v) {
    v("objects", objects);
    v("bin_holds", bin_holds);
    v("bin_room", bin_room);
    v("hand_over_s", hand_over_s);
    v("ask_s", ask_s);
    v("empty_s", empty_s);
    v("check_s", check_s);
    v("settle_s", settle_s);
    v("gone_s", gone_s);
    v("before_thing", before_thing);
    v("view", view);
  }
  [[nodiscard]] Result<void> validate() const;
};

struct OfficeOrder {
  std::string id;
  OfficeOrderKind kind = OfficeOrderKind::deliver;
  std::string room;  ///< of a delivery; of tidying up empty for all rooms
};

/// A thing as the eyes have it.
struct KnownThing {
  std::uint32_t id = 0;
  std::string object;  ///< empty: unknown, or not sure yet
  Point2 in_map;
};

/// What the robot is about in an office.
struct OfficeStatus {
  OfficeOrder order;
  OfficePhase phase = OfficePhase::idle;
  std::string reason;              ///< why it failed, in English
  std::optional<Point2> points{};  ///< [m], map: at what the head points
  std::uint32_t found = 0, picked_up = 0, left = 0, in_bin = 0;
  friend bool operator==(const OfficeStatus& a, const OfficeStatus& b) {
    return a.order.id == b.order.id && a.phase == b.phase && a.reason == b.reason &&
           a.points.has_value() == b.points.has_value() && a.found == b.found && a.picked_up == b.picked_up &&
           a.left == b.left && a.in_bin == b.in_bin;
  }
};

/// What the robot says.
enum class OfficeLine { delivery, please_put_in, thanks, please_empty, all_tidy, bin_stays_full, cannot_get_there };
constexpr auto words_of(OfficeLine) {
  return std::array{"delivery", "please_put_in",  "thanks",          "please_empty",
                    "all_tidy", "bin_stays_full", "cannot_get_there"};
}

/// Office Delivery and Office Cleanup ([Buhmann1995]): brings things to a room, and looks for litter, which it asks for
/// to be put into the bin that it brings, for it has no arm. It wishes for places as anybody of the staff does; the
/// mission drives. Deterministic: time, places and what became of the wishes come in.
class OfficeMission {
 public:
  /// Makes a plan of looks; which floor, by a room's id, empty: all. None: there is no such room.
  using MakePlan = std::function<std::optional<ViewPlan>(const std::string& room, Point2 robot)>;
  /// @param home  map_from_base where the robot waits
  OfficeMission(const OfficeParams& params, MakePlan make_plan, const Pose2& home)
      : params_{params}, make_plan_{std::move(make_plan)}, home_{home} {}

  void order(const OfficeOrder& order, Time now);
  /// A button, a voice or the page: done.
  void confirm(Time now);
  /// What became of the wish under way.
  void wish_over(bool is_fulfilled, const std::string& reason, Time now);
  void see_things(std::vector<KnownThing> things) { things_ = std::move(things); }
  /// Where the robot is, surely; several times a second. @param looks  a picture has come that was not blurred by a
  /// turn
  void stand(const Pose2& map_from_base, bool looks, Time now);
  void tick(Time now);
  /// It cannot go on. @param reason  in English
  void fail(const std::string& reason, Time now) { end(OfficePhase::failed, reason, now); }

  /// A place to drive to; the one wish at a time.
  struct Wish {
    RequestKind kind = RequestKind::point;
    std::string target;  ///< room, or "x,y,heading"
  };
  struct Actions {
    bool withdraws = false;  ///< first: what was wished for is no longer wanted
    std::optional<Wish> wish;
    std::vector<std::pair<OfficeLine, std::string>> lines;  ///< with what they are about: a room's id, an object
  };
  [[nodiscard]] Actions take_actions() { return std::exchange(actions_, {}); }
  [[nodiscard]] const OfficeStatus& status() const { return status_; }
  [[nodiscard]] double seen_share() const { return plan_ ? plan_->seen_share() : 0.0; }

 private:
  void enter(OfficePhase phase, Time now);
  void end(OfficePhase phase, std::string reason, Time now);
  void wish(const Wish& wish);
  void drive_to(const Pose2& pose);
  void look_on(Time now);
  void go_to_bin(Time now);
  void put_away(bool is_picked_up, Time now);
  [[nodiscard]] bool is_litter(const KnownThing& thing) const;
  [[nodiscard]] bool is_handled(const KnownThing& thing) const;
  [[nodiscard]] const KnownThing* wanted_thing() const;
  [[nodiscard]] bool waited(double duration_s, Time now) const { return now - since_ >= seconds(duration_s); }

  OfficeParams params_;
  MakePlan make_plan_;
  Pose2 home_;
  OfficeStatus status_;
  Actions actions_;
  Time since_;  ///< the phase
  bool is_wishing_ = false;
  std::optional<ViewPlan> plan_;
  std::optional<Pose2> pose_;
  std::optional<Pose2> goal_;         ///< of the drive under way
  std::optional<Time> stands_since_;  ///< it has come to a look
  std::vector<KnownThing> things_;
  std::optional<KnownThing> thing_;  ///< that it deals with
  Time thing_seen_;
  std::vector<Point2> handled_;      ///< places of things that were dealt with
  std::set<std::uint32_t> counted_;  ///< ids of things that count as found
};

}  // namespace docent::task_control
