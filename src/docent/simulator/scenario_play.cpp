#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <variant>

#include "docent/simulator/simulated_museum_impl.h"
#include "docent/simulator/start_pose.h"

// What the events of a scenario do to the robot, the crowd and the museum.

namespace docent::simulator {

void SimulatedMuseum::Impl::play_scenario() {
  const double now = run_seconds();
  const std::vector<ScenarioEvent>& events = options_.scenario.events;
  for (; next_event_ < events.size() && events[next_event_].at <= now; ++next_event_)
    waiting_events_.push_back(next_event_);
  std::erase_if(waiting_events_, [&](std::size_t i) {
    if (events[i].during && !is_now(*events[i].during)) return false;
    event_ = i;
    std::visit([this](const auto& event) { play(event); }, events[i].what);
    return true;
  });
  if (!every(10) || temporary_.empty()) return;
  bool changed = false;
  for (Temporary& item : temporary_) {
    if (!item.stands && !item.is_over &&
        distance(item.solid.polygon, body_.pose().position()) > body_.params().radius + 0.05) {
      // Nobody sets it down on top of the robot: it waits until there is room.
      item.stands = changed = true;
      world_.solids.push_back(item.solid);
    }
    if (item.until > 0.0 && now >= item.until && !item.is_over) {
      item.is_over = true;
      changed = changed || item.stands;
      std::erase_if(world_.solids, [&](const Solid& solid) { return solid.id == item.solid.id; });
    }
  }
  std::erase_if(temporary_, [](const Temporary& item) { return item.is_over; });
  if (changed) show_world();
}

void SimulatedMuseum::Impl::show_world() {
  obstacles_ = Obstacles{world_};
  instruments_.change_world(world_);
  if (cameras_) cameras_->change_world(world_);
  crowd_.change_world(world_);
}

void SimulatedMuseum::Impl::see_mission(const docent_msgs::MissionState& mission) {
  const auto phase = parse<MissionPhase>(mission.phase);
  if (phase != phase_) phase_began_ = bus_.now();
  phase_ = phase;
  visitors_.see_mission(bus_.now(), mission);
}

bool SimulatedMuseum::Impl::is_now(const Moment& moment) const {
  return phase_ == moment.phase && time_ - phase_began_ >= seconds(moment.after);
}

void SimulatedMuseum::Impl::play(const Kidnap& event) {
  std::optional<Pose2> to = event.to;
  const Point2 here = body_.pose().position();
  const bool is_near = event.shift > 0.0;
  const int tries = is_near ? 20000 : 200;
  if (event.near_hazards > 0.0) to = place_near_hazard(event.near_hazards);
  for (int i = 0; !to && i < tries && event.near_hazards == 0.0; ++i) {
    to = random_start(world_, crowd_.floor(), place_rng_, 0.6, here, is_near ? 0.0 : 3.0);
    if (to && hazard_distance(to->position()) < event.from_hazards) to.reset();
    if (to && is_near && distance(to->position(), here) > event.shift) to.reset();
  }
  if (is_near) {
    const Point2 place = to ? to->position() : here;  // no room: it is turned where it is
    to = Pose2{place.x, place.y, body_.pose().theta + Angle::degrees(event.turn)};
  }
  if (!to) {
    offer("kidnap_failed", "no free place");
    return;
  }
  body_.set_down(*to, event.keeps_speed);
  // The people who carry it ask for room.
  for (std::size_t i = 0; i < crowd_.people().size(); ++i) {
    (void)crowd_.give_way(i, to->position(), body_.params().radius + crowd_.people()[i].radius + 0.4);
  }
  has_fallen_ = false;
  log_.forget();
  offer("kidnap", "");
}

std::optional<Pose2> SimulatedMuseum::Impl::place_near_hazard(double within) {
  constexpr double kBeside = 0.05;  // [m] from everything: nobody sets it down on a thing
  const double radius = body_.params().radius;
  const auto [low, high] = crowd_.floor().bounds();
  for (int i = 0; i < 200000; ++i) {
    const Point2 at{place_rng_.uniform(low.x, high.x), place_rng_.uniform(low.y, high.y)};
    const Angle heading = Angle::radians(place_rng_.uniform(-std::numbers::pi, std::numbers::pi));
    const double away = hazard_distance(at) - radius;
    const bool is_there = away >= kBeside && away <= within && contains(world_.floor, at);
    if (is_there && crowd_.floor().clearance(at) >= radius + kBeside) return Pose2{at.x, at.y, heading};
  }
  return std::nullopt;
}

double SimulatedMuseum::Impl::hazard_distance(Point2 point) const {
  double least = 1e9;
  for (const Solid& solid : world_.solids)
    if (solid.kind == SolidKind::glass || solid.kind == SolidKind::plate || solid.kind == SolidKind::stairs)
      least = std::min(least, distance(solid.polygon, point));
  return least;
}

void SimulatedMuseum::Impl::play(const SensorFault& event) {
  instruments_.set_fault(event, time_);
  offer("fault", kSensorNames[static_cast<std::size_t>(event.sensor)]);
}

void SimulatedMuseum::Impl::play(const ScannerLie& event) {
  instruments_.set_lie(event, time_);
  offer("lie", "");
}

void SimulatedMuseum::Impl::play(const Stool& event) {
  Polygon outline;
  for (int i = 0; i < 8; ++i) outline.push_back(event.at + event.radius * unit(Angle::degrees(45.0 * i)));
  put_up("stool", event.bottom > 0.0 ? SolidKind::plate : SolidKind::furniture, std::move(outline), event.bottom,
         event.height, event.duration);
}

void SimulatedMuseum::Impl::play(const ClosedPassage& event) {
  const Point2 way = event.to - event.from;
  const Point2 across = (0.05 / norm(way)) * Point2{-way.y, way.x};
  put_up("closed", SolidKind::wall, {event.from - across, event.to - across, event.to + across, event.from + across},
         0.0, 1.2, event.duration);
}

void SimulatedMuseum::Impl::put_up(const std::string& kind, SolidKind solid, Polygon outline, double bottom, double top,
                                   double duration) {
  const std::string id = kind + "-" + std::to_string(event_);
  temporary_.push_back(
      {{id, solid, std::move(outline), bottom, top, true}, duration > 0.0 ? run_seconds() + duration : 0.0});
  offer(kind, id);
}

void SimulatedMuseum::Impl::play(const Visitors& event) {
  const Pose2& robot = body_.pose();
  const bool round_robot = !event.at && event.formation == Formation::ushape;
  const Point2 centre = event.at.value_or(round_robot ? robot.position() : robot * Point2{1.6, 0.0});
  const Angle facing = event.has_heading ? Angle::radians(event.heading) : robot.theta + Angle::degrees(180.0);
  std::vector<Point2> places;
  for (int i = 0; i < event.count; ++i) {
    const double slot = i - (event.count - 1) / 2.0;
    if (event.formation == Formation::wall) {
      places.push_back(centre + (0.55 * slot) * unit(facing + Angle::degrees(90.0)));
    } else if (event.formation == Formation::ushape) {
      // Three quarters of a ring; the open side faces `facing`.
      const double share = event.count > 1 ? slot / (event.count - 1) : 0.0;
      places.push_back(centre + 1.3 * unit(facing + Angle::degrees(180.0 + 270.0 * share)));
    } else {
      const double ring = 0.7 + 0.25 * (i % 3);
      places.push_back(centre + ring * unit(Angle::degrees(137.5 * i)));
    }
  }
  crowd_.add_standing(places, run_seconds() + event.duration, event.heeds);
  offer("visitors", std::to_string(event.count));
}

void SimulatedMuseum::Impl::play(const Pushers& event) {
  crowd_.add_pushers(event.count, event.at, event.heading, end_of(event.duration));
  offer("pushers", std::to_string(event.count));
}

void SimulatedMuseum::Impl::play(const Runners& event) {
  crowd_.add_runners(event.count, event.at, event.within, end_of(event.duration));
  offer("runners", std::to_string(event.count));
}

void SimulatedMuseum::Impl::play(const Escort& event) {
  crowd_.add_escort(event.count, event.near, event.far, run_seconds(), end_of(event.duration));
  offer("escort", std::to_string(event.count));
}

void SimulatedMuseum::Impl::play(const Steering& event) {
  steersman_.emplace(world_, event.speed, rng_.stream("steersman"), event.way);
  steered_until_ = event.duration > 0.0 ? run_seconds() + event.duration : 0.0;
  offer("steering", "");
}

void SimulatedMuseum::Impl::play(const LaserReach& event) {
  instruments_.limit_reach(event.range);
  offer("lasers", "");
}

void SimulatedMuseum::Impl::play(const Answers& event) {
  visitors_.answer_with(event.more, event.next);
  offer("answers", "");
}

void SimulatedMuseum::Impl::play(const BatteryChange& event) {
  battery_.set_charge(event.charge);
  offer("battery", "");
}

void SimulatedMuseum::Impl::play(const ChargerFault& event) {
  charger_fault_ = event.kind;
  charger_fault_until_ = end_of(event.duration);
  has_mute_battery_ = has_mute_battery_ || event.kind == ChargerFault::Kind::mute;
  offer("charger", "");
}

void SimulatedMuseum::Impl::play(const EyeFault& event) {
  if (cameras_) cameras_->set_fault(event, time_);
  constexpr std::array kNames{"depth", "ceiling", "front"};
  offer("eye", kNames.at(static_cast<std::size_t>(event.eye)));
}

void SimulatedMuseum::Impl::play(const OfficeEvent& event) {
  office_.play(event);
  offer("office", to_text(event.kind));
}

void SimulatedMuseum::Impl::help_in_office() {
  auto wanted = office_.step(time_);
  for (auto& order : wanted.orders) office_orders_.publish(std::move(order));
  for (auto& press : wanted.presses) buttons_.publish(std::move(press));
  if (!wanted.takes) return;
  constexpr double kAtHand = 0.3;  // [m] from where the robot points
  const auto lies_there = [&](const Solid& solid) {
    return is_litter(solid) && distance(solid.polygon, *wanted.takes) < kAtHand;
  };
  if (std::erase_if(world_.solids, lies_there) > 0) show_world();
}

void SimulatedMuseum::Impl::play(const OdometryJump& event) {
  instruments_.jump(event.by, event.over);
  offer("odometry_jump", "");
}

void SimulatedMuseum::Impl::play(const Transport& event) {
  instruments_.set_transport(event, time_);
  offer("transport", "");
}

}  // namespace docent::simulator
