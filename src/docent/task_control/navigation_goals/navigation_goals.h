#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/task_control/navigation_goals/request_id.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::task_control {

/// How goals are passed on.
struct NavigationGoalParams {
  double resend_s = 1.0;   ///< [s] > 0 between two sendings of what is not on the board yet
  double silence_s = 5.0;  ///< [s] > resend_s: what is then not on the board has not reached the robot; five sendings
  /// [s] > 0 without a word of the planner, after which the robot is gone: a module that died is back after 5 s and
  /// ready after some more
  double gone_s = 20.0;
  double speed = 0.5;    ///< [m/s] > 0 reckoned with until the robot has shown its own
  int most_poses = 100;  ///< 1..1000, of one goal

  template <class V>
  void visit(V& v) {
    v("resend_s", resend_s);
    v("silence_s", silence_s);
    v("gone_s", gone_s);
    v("speed", speed);
    v("most_poses", most_poses);
  }
  /// Names field and bound; empty: all is well.
  [[nodiscard]] std::string fault() const;
};

/// Of an orientation as ROS 2 has it: the heading of the body's x axis. nullopt: it is no rotation, and a client that
/// has left it empty is not taken for one that means 0.
[[nodiscard]] std::optional<Angle> heading_of(double x, double y, double z, double w);

/// Where a client wants the robot.
struct NavigationGoal {
  GoalId id{};
  std::vector<Pose2> map_from_base;  ///< in this order; only of the last one the heading matters
};

/// How a goal ends.
enum class GoalOutcome { succeeded, aborted, canceled };

/// The end of a goal, which comes once.
struct GoalEnd {
  GoalId id{};
  GoalOutcome outcome = GoalOutcome::aborted;
  std::string reason;  ///< a word of ReasonWord, perhaps with what it is about; or robot_silent, replaced, deactivated
};

/// How far the goal under way is.
struct GoalProgress {
  GoalId id{};
  std::optional<Pose2> map_from_base;  ///< where the robot was last; nullopt: it has never known its place
  double distance_m = 0.0;             ///< still to drive: along the robot's path, as the crow flies beyond its end
  double navigation_s = 0.0;           ///< since the goal began
  double remaining_s = 0.0;            ///< at the robot's mean speed so far
  int poses_remaining = 0;
  int blocked = 0;  ///< how often its way was blocked
};

/// What the robot is to be told: one request of the staff.
struct StaffRequest {
  std::string id;
  RequestKind kind = RequestKind::point;  ///< or cancel
  std::string target;                     ///< "x,y" or "x,y,heading" [m, rad], map; for cancel the id of a request
};

/// What the board says of a request.
struct RequestNews {
  std::string id;
  RequestStatus status = RequestStatus::queued;
  std::string reason;
};

/// One goal of a client at a time, from accepted to its end: the requests that the robot is to be told, what becomes of
/// them, and what the client hears. A newer goal replaces the present one, which is aborted. Requests and their
/// withdrawals are sent again until the robot's board shows that they have come. Deterministic; knows nothing of
/// messages and of ROS.
class NavigationGoals {
 public:
  /// @pre params.fault().empty()
  explicit NavigationGoals(const NavigationGoalParams& params) : params_{params} {}

  /// Why a goal cannot be taken, in English; empty: it can.
  [[nodiscard]] std::string refusal(const NavigationGoal& goal) const;
  /// @pre refusal(goal).empty()
  void begin(NavigationGoal goal, Time now);
  /// Its client no longer wants it. Ends as canceled once the robot has said so.
  void cancel(const GoalId& id, Time now);
  /// Nobody wants anything any more: what is under way is aborted.
  void deactivate(Time now);
  /// All requests on the robot's board.
  void board(std::span<const RequestNews> all, Time now);
  /// What the robot's planner says, whatever it drives to.
  /// @param remaining_m  along its path
  void drive(double remaining_m, bool is_blocked, Time now);
  /// Where the robot is.
  void pose(const Pose2& map_from_base);
  /// Several times a second.
  void tick(Time now);

  /// What is to be done, in this order.
  struct Actions {
    std::vector<StaffRequest> requests;
    std::vector<GoalEnd> ends;
  };
  [[nodiscard]] Actions take_actions() { return std::exchange(actions_, {}); }
  /// nullopt: nothing is under way.
  [[nodiscard]] std::optional<GoalProgress> progress(Time now) const;

 private:
  struct Present {
    NavigationGoal goal;
    std::size_t at = 0;  ///< number of the pose under way
    int requests = 0;    ///< made so far
    StaffRequest request;
    bool is_on_board = false;
    bool is_active = false;  ///< the robot is on its way
    Time began, requested, sent;
    std::optional<Time> cancel_began;
    double driven_m = 0.0;
    double driving_s = 0.0;
    int blocked = 0;
  };
  /// A request that nobody wants any more.
  struct Withdrawal {
    std::string request;
    StaffRequest cancel;
    Time sent;
  };
  void request_next(Time now);
  void send(const StaffRequest& request) { actions_.requests.push_back(request); }
  void withdraw(Time now);
  void end(GoalOutcome outcome, std::string reason);
  void judge(const RequestNews& news, Time now);
  /// The clock was set back: all waiting begins anew.
  void begin_time_anew(Time now);

  NavigationGoalParams params_;
  Actions actions_;
  std::optional<Present> present_;
  std::vector<Withdrawal> withdrawals_;
  std::optional<Pose2> map_from_base_;
  double remaining_m_ = 0.0;
  bool is_blocked_ = false;
  Time now_, heard_;
};

}  // namespace docent::task_control
