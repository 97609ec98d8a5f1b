#include "docent/planning/survey/surveyor.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "docent/planning/survey/beam_origins.h"

namespace docent::planning {

Surveyor::Surveyor(const SurveyorParams& params, SurveySite site, const SurveyBody& body, SurveyStore store, Time now)
    : params_{params},
      body_radius_{body.radius},
      store_{std::move(store)},
      frame_{site.home, store_.restored(now), body.reach},
      keyframes_{params.keyframes, params.mapping.points, body.base_from_laser},
      map_{params.mapping, params.map, body.radius},
      alignment_{params.alignment, site.area, site.home},
      start_{site.home},
      has_marks_{!site.hazards.empty()},
      drive_{params.drive, Explorer{params.explorer, std::move(site.hazards), std::move(site.area)},
             site.home.position()},
      order_{params.waits_for_order ? ExplorationOrder::wait : ExplorationOrder::by_itself} {}

void Surveyor::mount(std::size_t laser, const Pose2& base_from_laser) {
  constexpr double kMatters = 0.03;      // [m] and
  constexpr double kMattersTurn = 0.02;  // [rad]: less blurs no wall
  const Pose2 moved = keyframes_.mount(laser, base_from_laser) * inverse(base_from_laser);
  if (is_done_ || (norm(moved.position()) < kMatters && std::abs(moved.theta.radians()) < kMattersTurn)) return;
  map_ = SurveyMap{params_.mapping, params_.map, body_radius_};
  map_.lie(alignment_.site_from_survey());
  frame_.begin_anew(alignment_.site_from_survey());
  aligned_moments_ = 0;
}

void Surveyor::note_people(std::span<const TrackedPerson> people) {
  std::vector<TrackedPerson> placed{people.begin(), people.end()};
  const Pose2 odom_from_raw = inverse(frame_.raw_from_odom());
  for (TrackedPerson& person : placed) person.place = odom_from_raw * person.place;
  walkers_.note(placed);
}

bool Surveyor::obey(ExplorationOrder order) {
  if (is_done_) return false;
  order_ = order;
  is_done_ = order == ExplorationOrder::finish && has_begun();
  return true;
}

std::optional<Surveyor::Sight> Surveyor::sight() const {
  const auto map_from_odom = frame_.map_from_odom();
  if (is_done_ || !map_from_odom) return std::nullopt;
  auto look = keyframes_.look(frame_.odometry());
  if (!look) return std::nullopt;
  const Pose2 map_from_base = *map_from_odom * look->odom_from_base;
  auto origins = beam_origins(map_.seen(), look->sweep, map_from_base);
  look->odom_from_base = frame_.raw_from_odom(look->stamp) * look->odom_from_base;
  return Sight{std::move(*look), map_from_base, std::move(origins)};
}

bool Surveyor::add_moment() {
  if (is_done_) return false;
  auto moment = keyframes_.take(frame_.odometry(), walkers_.places());
  if (!moment) return false;
  moment->scan.odom_from_base = frame_.begin_moment(moment->scan.odom_from_base);
  frame_.end_moment(map_.add(std::move(*moment)));
  return true;
}

bool Surveyor::is_held(Time now) const {
  constexpr Duration kAfterSteering = std::chrono::seconds{3};
  return is_stopped_ || (steered_ && now - *steered_ < kAfterSteering);
}

/// Where somebody walks nearby, things are people who stand.
ExplorationDrive::Hindrance Surveyor::hindrance() const {
  constexpr double kNearby = 4.0;  // [m]
  if (hindrance_ != ExplorationDrive::Hindrance::thing) return hindrance_;
  const Point2 robot = frame_.odom_from_base()->position();
  const auto walkers = walkers_.places();
  const bool is_anybody_near =
      std::any_of(walkers.begin(), walkers.end(), [&](Point2 walker) { return distance(walker, robot) < kNearby; });
  return is_anybody_near ? ExplorationDrive::Hindrance::person : hindrance_;
}

Surveyor::Step Surveyor::plan(Time now) {
  keep_place(now);
  const auto here = frame_.map_from_base();
  if (!here || is_done_) return Step::none;
  map_.follow();
  align_marks();
  if (order_ == ExplorationOrder::finish) {
    is_done_ = true;
    return Step::ended;
  }
  map_.look();
  if (order_ != ExplorationOrder::by_itself) return Step::looked;
  drive_.set_doubt(map_.poses().doubt_of_marks());
  drive_.set_mark_margin([alignment = alignment_](Point2 place) { return alignment.margin_at(place); });
  drive_.set_trail(map_.trail());
  drive_.plan(map_.seen(), here->position(), is_held(now), now, hindrance());
  is_done_ = drive_.state() == ExplorationDrive::State::arrived;
  return Step::planned;
}

/// The robot was set down by hand: what people have marked is laid onto the walls that it sees.
void Surveyor::align_marks() {
  constexpr std::size_t kAtFirst = 3;  // moments
  constexpr std::size_t kLater = 25;   // likewise, once it is aligned
  const std::size_t moments = map_.poses().map_from_base().size();
  if (!has_marks_ || moments < aligned_moments_ + (alignment_.is_aligned() ? kLater : kAtFirst)) return;
  aligned_moments_ = moments;
  const Pose2 before = alignment_.site_from_survey();
  if (!alignment_.align(map_.walls(SurveyMap::kWallsApart))) return;
  const Pose2& after = alignment_.site_from_survey();
  map_.lie(after);
  map_.follow();
  frame_.lie(after * inverse(before));
  drive_.set_home(after * start_.position());
}

std::string Surveyor::plea() const {
  constexpr double kOff = 0.4;        // [m] or
  constexpr double kOffTurn = 2.5;    // [deg] is worth a word
  constexpr std::size_t kLong = 100;  // moments, some 15 m
  if (!has_marks_) return {};
  char text[200];
  if (!alignment_.is_aligned()) {
    if (map_.poses().map_from_base().size() < kLong) return {};
    std::snprintf(text, sizeof text,
                  "the area is not drawn along walls that I see: I keep %.1f m more off what is marked; was I set down "
                  "where I was told?",
                  report().mark_margin);
    return text;
  }
  const Pose2& moved = alignment_.site_from_survey();
  const Point2 off = moved * start_.position() - start_.position();
  const double turned = moved.theta.degrees();
  if (norm(off) < kOff && std::abs(turned) < kOffTurn) return {};
  std::snprintf(text, sizeof text,
                "I began x %+.2f y %+.2f m and %+.1f degrees from where I was told by the area's border", off.x, off.y,
                turned);
  return text;
}

std::optional<OccupancyGrid> Surveyor::finish(Time now) {
  constexpr double kAway = 1.0;  // [m]: its home was a little elsewhere on the map by which it drove
  const SurveyMap::SiteOf site_of = [this](const std::vector<mapping::SurfacePoint>& walls) {
    if (has_marks_) (void)alignment_.align(walls);
    return alignment_.site_from_survey();
  };
  auto finished = map_.finish({params_.explorer.robot_radius, params_.stray_floor}, site_of);
  if (!finished) {
    fault_ = finished.error().message;
    return std::nullopt;
  }
  auto saved = store_.save(finished->map, finished->map_from_base);
  if (!saved) {
    fault_ = saved.error().message;
    return std::nullopt;
  }
  file_ = std::move(*saved);
  warning_ = std::move(finished->warning);
  frame_.end_moment(finished->map_from_base.back());
  const auto here = frame_.map_from_base();
  const Point2 home = alignment_.site_from_survey() * start_.position();
  is_away_ = order_ == ExplorationOrder::by_itself && here && distance(here->position(), home) > kAway;
  if (is_away_) warning_ += (warning_.empty() ? "" : "; ") + why_away(distance(here->position(), home));
  unreached_ = drive_.explorer().unreached(finished->map);
  keep_place(now);
  return std::move(finished->map);
}

/// @param metres  from home
std::string Surveyor::why_away(double metres) const {
  char text[160];
  std::snprintf(text, sizeof text, "the robot stands %.1f m from its home: %s", metres,
                drive_.is_enclosed() ? "it knew no way there" : "it was held up on its ways there");
  return text + (hindering_fault_.empty() ? "" : ", while " + hindering_fault_);
}

/// As sure as it is at worst: nobody knows how it moves until the next process begins.
void Surveyor::keep_place(Time now) const {
  const auto here = frame_.map_from_base();
  if (!here) return;
  store_.keep_place(mode_of({*here, params_.most_sigma, params_.sigma_heading}),
                    frame_.raw_from_odom() * *frame_.odom_from_base(), now);
}

std::optional<Surveyor::Place> Surveyor::place() const {
  const auto here = frame_.map_from_base();
  if (!here) return std::nullopt;
  const double spread = map_.poses().spread().position;  // no number where no poses fit together
  const double sigma = spread <= params_.most_sigma ? std::max(spread, params_.least_sigma) : params_.most_sigma;
  return Place{{*here, sigma, params_.sigma_heading}, frame_.raw_from_odom() * *frame_.odom_from_base()};
}

ExplorationDrive::Ahead Surveyor::ahead() const {
  const auto here = frame_.map_from_base();
  if (!here || is_done_ || order_ != ExplorationOrder::by_itself) return {};
  ExplorationDrive::Ahead ahead = drive_.ahead(here->position());
  const Pose2 raw_from_map = frame_.raw_from_odom() * inverse(*frame_.map_from_odom());
  for (Point2& via : ahead.via) via = raw_from_map * via;
  return ahead;
}

SurveyPhase Surveyor::phase() const {
  if (!file_.empty()) return is_away_ ? SurveyPhase::stranded : SurveyPhase::done;
  if (is_done_) return SurveyPhase::mapping;
  if (!has_begun()) return SurveyPhase::starting;
  return drive_.state() == ExplorationDrive::State::returning ? SurveyPhase::returning : SurveyPhase::exploring;
}

Surveyor::Report Surveyor::report() const {
  const auto here = frame_.map_from_base();
  const double margin = has_marks_ && here ? alignment_.margin_at(here->position()) : 0.0;
  return {phase(), order_,   map_.known_m2(), drive_.frontier(), frame_.way(), map_.poses().loops(), unreached_,
          file_,   warning_, margin};
}

}  // namespace docent::planning
