#include "docent/telepresence/counting/count_desk.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "docent/messages/conversions.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::telepresence {
namespace {

constexpr double kMoves = 0.02;                  // [m/s] and more
constexpr double kLongestGap = 1.0;              // [s] between two odometries that belong together
constexpr double kFastest = 3.0;                 // [m/s] whatever says more has jumped
constexpr double kOneContact = 1.0;              // [s] what touches again within this time has not let go
constexpr std::size_t kKnownAnswers = 64;        // more than a screen can have under way
constexpr std::size_t kMostAddresses = 100'000;  // between two stores

std::optional<Counted> counted_of(const std::string& source) {
  switch (parse<RequestSource>(source).value_or(RequestSource::web)) {
    case RequestSource::web:
      return Counted::web;
    case RequestSource::kiosk:
      return Counted::kiosk;
    case RequestSource::visitor:
      return Counted::visitor;
    case RequestSource::staff:
      return Counted::staff;
    case RequestSource::vote:
      return Counted::vote;
  }
  return std::nullopt;
}

}  // namespace

void CountDesk::arrived(const std::string& address) {
  if (counting_.addresses.size() < kMostAddresses) counting_.addresses.insert(address);
}

void CountDesk::asked(std::uint64_t accesses) {
  counting_.own[Counted::accesses] += static_cast<double>(accesses - std::min(accesses, accesses_));
  accesses_ = accesses;
}

void CountDesk::see(const nav_msgs::Odometry& odometry) {
  const Time stamp = from_message(odometry.header.stamp);
  const Pose2 now = from_message(odometry.pose.pose);
  const double passed = moved_ ? to_seconds(stamp - *moved_) : 0.0;
  const double way = odom_from_base_ ? distance(odom_from_base_->position(), now.position()) : 0.0;
  const double speed = std::abs(odometry.twist.twist.linear.x);
  moved_ = stamp;
  odom_from_base_ = now;
  if (!(passed > 0.0 && passed < kLongestGap) || way > kFastest * passed || speed > kFastest) return;
  counting_.robot[Counted::uptime_s] += passed;
  if (speed < kMoves) return;
  counting_.robot[Counted::travel_s] += passed;
  counting_.robot[Counted::distance_m] += way;
  counting_.robot[Counted::max_speed] = std::max(counting_.robot[Counted::max_speed], speed);
}

void CountDesk::see(const docent_msgs::Event& event) {
  const auto kind = parse<EventKind>(event.kind);
  if (kind == EventKind::tour_started) {
    stops_ = 0;
    tour_began_ = from_message(event.header.stamp);
  }
  if (kind == EventKind::tour_completed) {
    counting_.robot[Counted::tours] += 1.0;
    counting_.robot[Counted::last_stop] += people_at_stop_;
  }
  if (kind == EventKind::tour_failed) counting_.robot[Counted::tours_failed] += 1.0;
  if (kind == EventKind::tour_broken_off) counting_.robot[Counted::tours_broken] += 1.0;
  if (kind == EventKind::plan_inserted || kind == EventKind::plan_removed || kind == EventKind::plan_rescheduled ||
      kind == EventKind::plan_shortened)
    counting_.robot[Counted::plan_revisions] += 1.0;
  if (kind == EventKind::point_reached) counting_.robot[Counted::points] += 1.0;
  if (kind != EventKind::explained) return;
  counting_.robot[Counted::exhibits] += 1.0;
  counting_.robot[Counted::visitors] += audience_.count();
  const std::string& tour = event.detail;
  if (!tour.empty()) count_stop_of_tour(tour, event.subject, from_message(event.header.stamp));
}

void CountDesk::count_stop_of_tour(const std::string& tour, const std::string& exhibit, Time stamp) {
  const int people = audience_.count();
  people_at_stop_ = people;
  if (stops_ == 0) counting_.robot[Counted::first_stop] += people;
  if (tour_began_ == Time{}) tour_began_ = stamp;  // it began before this program
  counting_.stops.push_back({tour_began_, ++stops_, tour, exhibit, people});
}

void CountDesk::see(const docent_msgs::Tactile& ring) {
  const bool is_touched = std::find(ring.segments.begin(), ring.segments.end(), 1) != ring.segments.end();
  if (!is_touched) return;
  const Time stamp = from_message(ring.header.stamp);
  if (!touched_ || stamp - *touched_ > seconds(kOneContact)) counting_.robot[Counted::contacts] += 1.0;
  touched_ = stamp;
}

void CountDesk::answered(const std::string& id, PollQuestion question, PollAnswer answer) {
  if (std::find(answers_.begin(), answers_.end(), id) != answers_.end()) return;
  answers_.push_back(id);
  if (answers_.size() > kKnownAnswers) answers_.pop_front();
  counting_.own[counted_of(question, answer)] += 1.0;
}

void CountDesk::see(const docent_msgs::RequestBoard& board) {
  std::map<std::string, bool> requests;
  for (const auto& entry : board.requests) {
    const auto known = requests_.find(entry.request.id);
    bool& is_over = requests[entry.request.id];
    is_over = known != requests_.end() && known->second;
    // What the board held before this program began was counted by the one before.
    if (known == requests_.end() && from_message(entry.created) >= begun_)
      if (const auto source = counted_of(entry.request.source)) counting_.robot[*source] += 1.0;
    if (is_over || from_message(entry.changed) < begun_) continue;
    const auto status = parse<RequestStatus>(entry.state);
    if (status == RequestStatus::fulfilled) counting_.robot[Counted::fulfilled] += 1.0;
    if (status == RequestStatus::failed) counting_.robot[Counted::failed] += 1.0;
    is_over = status == RequestStatus::fulfilled || status == RequestStatus::failed;
  }
  requests_ = std::move(requests);
}

void CountDesk::store(const std::string& mode, Time now) {
  const auto counted = std::make_shared<Counting>(std::exchange(counting_, {}));
  queue_.put([this, counted, mode, now] { return store(*counted, mode, now); },
             [this, counted](const Result<void>& stored) {
               fault_ = stored ? "" : stored.error().message;
               if (!stored) take_back(std::move(*counted));
             },
             now);
}

Result<void> CountDesk::store(const Counting& counted, const std::string& mode, Time now) {
  if (auto own = statistics_->add(now, mode, counted.own); !own) return own;
  if (auto visitors = statistics_->add_web_visitors(now, mode, counted.addresses); !visitors) return visitors;
  const auto is_ours = statistics_->may_count_robot(gateway_, now);
  if (!is_ours) return tl::unexpected<Error>(is_ours.error());
  if (!*is_ours) return {};  // another gateway counts it
  if (auto stops = statistics_->add_attendance(now, mode, counted.stops); !stops) return stops;
  return statistics_->add(now, mode, counted.robot);
}

void CountDesk::take_back(Counting counted) {
  const auto add = [](Counts& counts, const Counts& more) {
    for (const auto& [what, amount] : more)
      counts[what] = what == Counted::max_speed ? std::max(counts[what], amount) : counts[what] + amount;
  };
  add(counting_.own, counted.own);
  add(counting_.robot, counted.robot);
  for (const std::string& address : counted.addresses) arrived(address);
  counting_.stops.insert(counting_.stops.begin(), counted.stops.begin(), counted.stops.end());
}

}  // namespace docent::telepresence
