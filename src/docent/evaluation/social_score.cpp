#include "docent/evaluation/social_score.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "docent/evaluation/deployment_evaluator.h"
#include "docent/messages/conversions.h"

namespace docent::evaluation {
namespace {

constexpr double kIntimate = 0.45;  // [m]
constexpr double kPersonal = 1.2;   // [m]
constexpr double kSocial = 3.6;     // [m]
constexpr double kCloses = 0.02;    // [m/s] towards somebody: less is the noise of a stop
constexpr double kRound = 2.0;      // [m] of the density that is met

}  // namespace

void SocialScore::add(const docent_msgs::TrueState& state) {
  const Time stamp = from_message(state.header.stamp);
  if (is_over_ || stamp < start_) return;
  if (last_) {
    const double dt = to_seconds(stamp - from_message(last_->header.stamp));
    const double way = distance(Point2{state.x, state.y}, {last_->x, last_->y});
    report_.seconds = to_seconds(stamp - start_);
    report_.path_m += way;
    report_.heading_changes += std::abs((Angle::radians(state.theta) - Angle::radians(last_->theta)).radians());
    if (std::abs(state.linear) < 0.001 && std::abs(state.angular) < 0.01) report_.not_moving_s += dt;
    judge_people(state, dt, way);
  }
  last_ = state;
  report_.arrived = distance(Point2{state.x, state.y}, goal_) < goal_radius_;
  is_over_ = report_.arrived || to_seconds(stamp - start_) >= limit_;
}

void SocialScore::judge_people(const docent_msgs::TrueState& state, double dt, double way) {
  const Point2 here{state.x, state.y};
  const Point2 velocity = state.linear * unit(Angle::radians(state.theta));
  double nearest = 1e3;  // outline to middle
  double gap = 1e3;      // outline to outline
  int round = 0;
  bool closes_intimate = false;
  bool closes_near = false;
  for (const auto& person : state.people) {
    const Point2 offset = Point2{person.x, person.y} - here;
    const double away = norm(offset);
    const double to_middle = away - robot_radius_;
    const double to_outline = to_middle - static_cast<double>(person.radius);
    nearest = std::min(nearest, to_middle);
    gap = std::min(gap, to_outline);
    round += away < kRound ? 1 : 0;
    const bool closes = dot(velocity, offset) > kCloses * away;
    closes_intimate = closes_intimate || (closes && to_middle < kIntimate);
    closes_near = closes_near || (closes && to_outline < kIntimate);
  }
  if (nearest < kIntimate)
    report_.intimate_s += dt;
  else if (nearest < kPersonal)
    report_.personal_s += dt;
  else if (nearest < kSocial)
    report_.social_s += dt;
  if (closes_intimate) report_.intimate_closing_s += dt;
  if (closes_near) report_.near_closing_s += dt;
  const double density = round / (std::numbers::pi * (kRound * kRound - robot_radius_ * robot_radius_));
  density_sum_ += density * dt;
  density_way_sum_ += density * way;
  closest_sum_ += gap * dt;
  report_.least_m = report_.least_m == 0.0 ? gap : std::min(report_.least_m, gap);
}

void SocialScore::add(const docent_msgs::TrueContact& contact) {
  const Time stamp = from_message(contact.header.stamp);
  // A contact is told up to 0.3 s after the touch.
  if (stamp < start_ || (is_over_ && to_seconds(stamp - start_) > report_.seconds)) return;
  if (is_contact(contact))
    ++report_.contacts[contact.kind];
  else
    ++report_.bumped_by_people;
}

SocialReport SocialScore::report() const {
  SocialReport report = report_;
  if (report.seconds > 0.0) {
    report.mean_closest_m = closest_sum_ / report.seconds;
    report.density_met = density_sum_ / report.seconds;
  }
  if (report.path_m > 0.0) report.density_passed = density_way_sum_ / report.path_m;
  return report;
}

std::string to_json(const SocialReport& report) {
  const auto rounded = [](double value) { return std::round(value * 1e4) / 1e4; };
  nlohmann::ordered_json json;
  json["arrived"] = report.arrived;
  json["seconds"] = rounded(report.seconds);
  json["path_m"] = rounded(report.path_m);
  json["heading_changes"] = rounded(report.heading_changes);
  json["not_moving_s"] = rounded(report.not_moving_s);
  json["intimate_s"] = rounded(report.intimate_s);
  json["personal_s"] = rounded(report.personal_s);
  json["social_s"] = rounded(report.social_s);
  json["intimate_closing_s"] = rounded(report.intimate_closing_s);
  json["near_closing_s"] = rounded(report.near_closing_s);
  json["mean_closest_m"] = rounded(report.mean_closest_m);
  json["least_m"] = rounded(report.least_m);
  json["density_met"] = rounded(report.density_met);
  json["density_passed"] = rounded(report.density_passed);
  for (const char* kind : {"people", "furniture", "walls", "hazards"}) {
    const auto place = report.contacts.find(kind);
    json["contacts"][kind] = place == report.contacts.end() ? 0 : place->second;
  }
  json["bumped_by_people"] = report.bumped_by_people;
  return json.dump(2);
}

}  // namespace docent::evaluation
