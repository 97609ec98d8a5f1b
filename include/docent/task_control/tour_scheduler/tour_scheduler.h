#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "docent/base/result.h"
#include "docent/task_control/tour_scheduler/programme.h"
#include "docent/task_control/tour_scheduler/request_board.h"
#include "docent/task_control/tour_scheduler/scheduler_params.h"

namespace docent::task_control {

/// What decides whether a request is taken.
struct Conditions {
  bool is_open = true;                                      ///< the museum is
  std::optional<OperatingMode> mode = OperatingMode::open;  ///< nullopt: one that is not known, taken as open
  bool takes_points = true;  ///< the planner can drive to points on the map, and to rooms
  Reason delay = {};         ///< why all who come now wait a while; none: they do not
  Point2 robot{};            ///< [m], map: where it is, for whoever wishes for the next room
};

/// One exhibit to show, for one request or many.
struct Visit {
  std::string exhibit_id;   ///< of the museum
  int viewpoint = -1;       ///< -1: the exhibit's own place
  Pose2 map_from_base;      ///< where to stand
  std::string language;     ///< that of the first request
  std::string tour_id;      ///< empty: not a stop of the tour under way
  bool is_joinable = true;  ///< nothing was said yet: whoever wishes for the exhibit now takes part
  Time started;             ///< when its drive began
  bool asks = true;         ///< there is time to hear more
  bool is_point = false;    ///< a point on the map or a room; `exhibit_id` is its name (point_name) or the room's id

  [[nodiscard]] TaskKind task_kind() const { return is_point ? TaskKind::point : TaskKind::visit; }  ///< as a task
};

/// What became of a stop; skipped: the robot could not get there, declined: its visitors did not want it.
enum class StopStatus { pending, explained, skipped, declined };
/// An exhibit of a tour.
struct TourStop {
  std::string exhibit_id;                   ///< of the museum
  StopStatus status = StopStatus::pending;  ///< what became of it
  int attempts = 0;                         ///< to reach it
  int number = 0;  ///< from 0, in the order in which stops were added to a tour with a fixed order
};

/// A request that takes part in a tour, and in which of its stops it does.
struct TourMember {
  std::string request_id;  ///< of the board
  std::vector<int> stops;  ///< their numbers; empty: all there are (composed tours)
};

/// A tour under way.
struct TourRun {
  std::string tour_id;                ///< of the museum
  std::string language;               ///< of its first request
  std::vector<TourStop> stops;        ///< in the order of visiting; what failed went to the end
  bool just_inserted = false;         ///< the last visit was not one of the tour's
  double target_s = 0.0;              ///< [s] 0: none
  Time started;                       ///< when it began
  std::vector<TourMember> members{};  ///< who takes part
  bool asks = true;                   ///< at the next stop: more, or next?
  Time composed_at{-1};               ///< when its pending stops were chosen last
  Time broken_off{};                  ///< when it was, while it waits to go on
};

/// A tour is over, and its visitors are still there.
struct Farewell {
  std::string tour_id;   ///< of the museum
  std::string language;  ///< it was given in
  Time started;          ///< when the tour began
};

/// Since the mission began.
struct Counters {
  std::uint32_t exhibits_explained = 0;  ///< in full
  std::uint32_t tours_completed = 0;     ///< to their last stop
  std::uint32_t requests_served = 0;     ///< that ended well
  std::uint32_t tours_since_vote = 0;    ///< begun since the last one for which the Web voted
};

/// So many different things were wished for at once when a request came.
struct Load {
  Time at;        ///< when it came
  int stops = 0;  ///< different things
};

/// All that must survive.
struct SchedulerState {
  RequestBoard board;                    ///< all requests
  std::optional<Visit> visit;            ///< the one under way
  std::optional<TourRun> tour;           ///< the one under way
  Counters counters;                     ///< of what was done
  std::optional<Farewell> farewell{};    ///< to be said before anything else
  std::vector<Load> loads{};             ///< rising in time, falling in stops: each the most since it was
  std::optional<TourRun> broken_tour{};  ///< broken off; it goes on where it stood when its members have their turn
};

/// Which exhibit comes next, and what becomes of each request (architecture 10.8; [Rhino1999] 4.3).
///
/// Requests for one exhibit are merged into one visit as far as their viewpoints allow, requests for one tour into one
/// run; each keeps a state and a reason of its own. A wish for the tour under way joins it where it is, and what its
/// visitors missed is shown at the end; once its first round is over, or if it is composed, they get a run of their
/// own. Without a tour, single exhibits are visited in the order of the least travel, anew after every visit, but who
/// is overdue comes first (the least travel among these), and the oldest open request decides whether a tour begins; so
/// does a visit that a waiting tour would make as well: then one visit serves both. A tour keeps its order; between two
/// of its stops at most one single exhibit is put in: an overdue one, or one with a small detour. A composed tour
/// chooses each exhibit when the one before was explained, by travel times that were learned, so that it ends in time
/// ([Minerva2000] 5.3); it rather shows what others have wished for, and only an overdue exhibit is put in. A tour for
/// which the charge does not last is shortened. A tour that was broken off goes on where it stood, if anybody still
/// follows it. A tour that showed something ends with a farewell. Points on the map
/// and rooms are approached in the order in which they were wished for ([Minerva2000] 6.4): one has its turn when its
/// request is the oldest. A tour that was voted for is the next to begin.
class TourScheduler {
 public:
  /// Open requests in `state` for what the museum no longer has are failed at once.
  TourScheduler(const SchedulerParams& params, Programme programme, TravelDistance travel, SchedulerState state,
                Time now);

  /// Puts the request on the board: queued, active (joins the visit under way) or refused; or does what a `cancel`
  /// says. A known id changes nothing.
  void submit(VisitorRequest request, const Conditions& conditions, Time now);

  /// Chooses and begins the next visit from where the robot stands; nullopt: nothing to do now, or what comes next, the
  /// visit or the whole tour, is foreseen to take longer than `budget_s` [s], or (state) a farewell is to be said
  /// first.
  /// @pre no visit is under way.
  const std::optional<Visit>& begin_visit(Point2 robot, Time now,
                                          double budget_s = std::numeric_limits<double>::infinity());
  /// Of which exhibits one may be visited next, for planners that choose themselves: the next stop of the tour under
  /// way, the first of one whose turn it is, or all that are wished for singly. Empty while a visit is under way.
  [[nodiscard]] std::vector<std::string> choices(Point2 robot, Time now);
  /// Begins a visit of one of the `choices`; false: it is none. @pre no visit is under way.
  [[nodiscard]] bool begin_visit_to(const std::string& exhibit_id, Point2 robot, Time now);
  /// The visit under way waits again, as if it had never begun. @pre one is under way.
  void suspend_visit(Time now);
  /// Somebody waits whose turn it may be, or a tour is under way.
  [[nodiscard]] bool is_anything_due(Time now) const { return state_.tour || oldest_due(now) != nullptr; }
  /// Ends the visit and the tour under way for a reason that is not theirs. Their requests wait again, and a tour goes
  /// on at the stop at which it was; after `max_attempts` they fail.
  void break_off(const Reason& reason, Time now);
  /// Nobody is near: the tour that was broken off is over for whoever asked for it in the hall, once they have been
  /// away for `wait_for_group_s`. Whoever follows it on the Web is still there.
  void let_go_broken_tour(Time now);
  /// [s] foreseen for the way.
  [[nodiscard]] double way_duration(Point2 from, Point2 to, Time now) const;
  [[nodiscard]] double way_length(Point2 from, Point2 to) const { return travel_(from, to); }  ///< [m]
  /// The farewell was said. @pre there is one.
  void finish_farewell(Time now);
  /// The explanation began: from now on nobody joins the visit.
  void close_visit();
  /// The visit ended; its requests are fulfilled, tried again later or failed. @pre a visit is under way.
  void finish_visit(bool is_success, const Reason& reason, Time now);
  /// A visitor before the robot, or the staff, do not want the stop under way of their tour: the visit ends, the stop
  /// is left out, and what else was wished for there waits again. Who follows the same tour from elsewhere is shown it
  /// at the end. False: it is not under way, or nobody of theirs takes part in the tour.
  [[nodiscard]] bool decline_stop(const VisitorRequest& skip, Time now);
  /// True while somebody has waited long who is not being served: then nobody is asked whether they want more.
  [[nodiscard]] bool is_in_a_hurry(Time now) const;
  /// True when no request wants the visit under way any more.
  [[nodiscard]] bool is_visit_unwanted() const;
  /// Ends a visit that nobody wants any more, without counting it. @pre is_visit_unwanted()
  void drop_visit(Time now);

  /// Exhibits still to come, in order, as it looks from here.
  [[nodiscard]] std::vector<std::string> agenda(Point2 robot, Time now) const;

  [[nodiscard]] const SchedulerState& state() const { return state_; }     ///< all that must survive
  [[nodiscard]] RequestBoard& board() { return state_.board; }             ///< all requests
  [[nodiscard]] TravelTimes& times() { return times_; }                    ///< what drives have taken
  [[nodiscard]] const TravelTimes& times() const { return times_; }        ///< what drives have taken
  [[nodiscard]] const Programme& programme() const { return programme_; }  ///< what the museum offers
  /// Adds to the history what the scheduler does not see itself.
  void note(Happening happening) { happenings_.push_back(std::move(happening)); }
  /// What happened since the last call, in order.
  [[nodiscard]] std::vector<Happening> take_happenings();

 private:
  /// None: it is taken.
  [[nodiscard]] Reason refusal(const VisitorRequest& request, const Conditions& conditions) const;
  void drop_what_is_gone(Time now);
  /// Whether the visit or the tour under way serves the request, too; a tour takes it as a member.
  [[nodiscard]] bool join(const VisitorRequest& request);
  /// Nothing of the tour under way was said yet. @pre a tour is under way.
  [[nodiscard]] bool is_at_its_beginning() const;
  [[nodiscard]] bool join_tour(const VisitorRequest& request);
  /// Goes on with the tour that was broken off, if it is this one and somebody still waits for it. nullopt: it is not;
  /// false: the rest is foreseen to take longer than `budget_s` [s]. @param members  who wait for the tour
  [[nodiscard]] std::optional<bool> resume_tour(const std::string& tour_id, const std::vector<std::string>& members,
                                                Point2 robot, Time now, double budget_s);
  void cancel(const VisitorRequest& request, Time now);
  /// Of a tour with a fixed order: who has declined all that was theirs.
  void drop_members_without_stops(Time now);
  void close_request(const std::string& id, RequestStatus status, const Reason& reason, Time now);
  [[nodiscard]] std::vector<std::string> ids(RequestKind kind, RequestStatus status, const std::string& target) const;
  /// Of requests for an exhibit, or for a point, which a visit may serve.
  [[nodiscard]] std::vector<std::string> ids_of_visit(RequestStatus status, const std::string& target) const;
  [[nodiscard]] Reason refusal_of_place(const VisitorRequest& request, const Conditions& conditions) const;
  /// Where a wish for a point or a room wants the robot; nullopt: nowhere that there is.
  [[nodiscard]] std::optional<Point2> place_of_wish(const VisitorRequest& request) const;
  /// "next" becomes the room after the last one for which somebody waits, else after that in which the robot is; a
  /// point gets its one name.
  void name_place(VisitorRequest& request, Point2 robot) const;
  /// The programme holds the points and rooms of the open requests, and no others.
  void keep_points();
  /// @pre there is a tour
  void cancel_tour_without_members();
  /// The stop at which the exhibit is shown to the most patient of those who wish for it singly.
  [[nodiscard]] WishedStop stop_at(const std::string& exhibit_id, Time now) const;
  [[nodiscard]] Point2 place_of(const WishedStop& stop) const;
  /// The stops of which each meets the wish: any viewpoint of the exhibit, where the wish names none.
  [[nodiscard]] std::vector<WishedStop> ways_to_meet(const WishedStop& stop) const;
  /// Stops wished for singly and due, in the order to visit them: overdue ones first, each part by the least travel.
  [[nodiscard]] std::vector<WishedStop> single_order(Point2 robot, Time now) const;
  /// Adds stops in the order of the least travel from the end of `order`, or from the robot where that is empty.
  void append_shortest(const std::vector<WishedStop>& stops, Point2 robot, std::vector<WishedStop>& order) const;
  [[nodiscard]] const BoardEntry* oldest_due(Time now) const;
  /// Of a composed tour that somebody waits for, if it began here and now.
  [[nodiscard]] std::vector<std::string> first_stops(const VisitorRequest& request, Point2 robot, Time now) const;
  /// The first tour that somebody waits for and that stops at the exhibit.
  [[nodiscard]] std::optional<std::string> waiting_tour_to(const std::string& exhibit_id, Time now) const;
  [[nodiscard]] std::optional<WishedStop> stop_to_insert(Point2 robot, Time now) const;
  [[nodiscard]] std::vector<std::string> wished_exhibits() const;
  /// False: it would take longer than the budget.
  [[nodiscard]] bool begin_tour(const std::string& tour_id, Point2 robot, Time now, double budget_s);
  [[nodiscard]] double duration_of(const TourRun& tour, Point2 robot, Time now) const;
  [[nodiscard]] double stop_duration_of(const ProgrammeExhibit& exhibit, const std::string& language, Point2 from,
                                        Point2 to, Time now) const;
  /// How a composed tour goes on from here.
  [[nodiscard]] TourPlan compose(const TourRun& tour, Point2 robot, Time now, double budget_s) const;
  /// A composed tour is fitted to the time that is left: its pending stops are chosen anew.
  void recompose(Point2 robot, Time now, double budget_s);
  /// A tour with a fixed order that would take longer than the budget leaves out its last stops, but never more than a
  /// fulfilled tour may, nor the next one.
  void shorten(Point2 robot, Time now, double budget_s);
  void begin_stop(Point2 robot, Time now, double budget_s);
  void begin_visit_of(const WishedStop& stop, bool is_stop, Time now);
  void finish_stop(const std::string& exhibit_id, bool is_success);
  /// Closes the requests of members whose stops are over, and the tour with the last of them.
  void end_tour_if_over(Time now);
  /// One more attempt that came to nothing: waits again, not before `not_before`, or fails.
  void try_again(const std::string& id, const Reason& reason, Time not_before, Time now);
  void note_load(const VisitorRequest& newest, Time now);
  [[nodiscard]] bool is_overdue(const BoardEntry& entry, Time now) const;

  SchedulerParams params_;
  Programme programme_;
  TravelDistance travel_;
  TravelTimes times_;
  SchedulerState state_;
  std::vector<Happening> happenings_;
};

}  // namespace docent::task_control
