#include "docent/simulator/simulated_museum.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "docent/base/check.h"
#include "docent/messages/conversions.h"
#include "docent/simulator/simulated_museum_impl.h"
#include "docent/simulator/start_pose.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::simulator {
namespace {

constexpr double kWorldStep = 0.01;    // [s]
constexpr double kPeopleStep = 0.02;   // [s]
constexpr double kChargerReach = 0.4;  // [m]
constexpr double kRobotHeight = 1.2;   // [m] what of people is higher it does not touch

CrowdParams params_for(const SimulationOptions& options) {
  CrowdParams params = options.crowd_params;
  if (options.bodies) params.physique.bodies = *options.bodies;
  if (options.heedless) params.heedless_share = *options.heedless;
  if (options.crowd == "packed" && params.near_share == 0.0) params.near_share = 0.25;
  return params;
}

}  // namespace

Result<void> validate(const SimulationOptions& options) {
  if (!crowd_density(options.crowd)) {
    return fail("crowd '" + options.crowd + "' is unknown (known: empty, quiet, busy, packed)");
  }
  if (options.world.floor.size() < 3) return fail("the world has no floor");
  if (options.start && Obstacles{options.world}.clearance(options.start->position()) < BodyParams{}.radius) {
    return fail("the start touches a solid of the world");
  }
  if (options.cameras) {
    if (auto valid = options.cameras->validate(); !valid) return valid;
  }
  if (options.heedless && !(*options.heedless >= 0.0 && *options.heedless <= 1.0))
    return fail("the share of the heedless must lie between 0 and 1");
  if (options.requests_per_hour && !(*options.requests_per_hour >= 0.0)) return fail("requests per hour must be >= 0");
  return {};
}

SimulatedMuseum::Impl::Impl(transport::Bus& robot_bus, transport::Bus& truth_bus, SimulationOptions options)
    : bus_{robot_bus},
      truth_bus_{truth_bus},
      options_{std::move(options)},
      world_{options_.world},
      rng_{Rng{options_.seed}.stream("simulator")},
      place_rng_{rng_.stream("places")},
      start_{bus_.now()},
      time_{start_},
      obstacles_{world_},
      body_{BodyParams{}, first_pose(), rng_.stream("body")},
      crowd_{make_crowd()},
      instruments_{robot_bus, world_, options_.hardware, rng_},
      visitors_{wish_params(), world_.exhibits, world_.tours, rng_.stream("visitors")},
      tactile_(kTactileSegments, 0),
      requests_{robot_bus.publisher(topics::kRequest)},
      office_orders_{robot_bus.publisher(topics::kOfficeOrder)},
      buttons_{robot_bus.publisher(topics::kButton)},
      choices_{robot_bus.publisher(topics::kChoice)},
      run_infos_{truth_bus.publisher(topics::kRunInfo)},
      states_{truth_bus.publisher(topics::kTrueState)},
      contacts_{truth_bus.publisher(topics::kTrueContact)},
      offers_{truth_bus.publisher(topics::kTrueOffer)} {
  battery_.set_charge(options_.battery);
  if (options_.cameras) cameras_.emplace(robot_bus, world_, *options_.cameras, rng_.stream("cameras"));
  docent_msgs::RunInfo info = options_.run_info;
  info.seed = options_.seed;
  info.crowd = options_.crowd;
  tell(run_infos_, std::move(info));
}

void SimulatedMuseum::Impl::command(const geometry_msgs::Twist& twist) {
  if (!steersman_) body_.command(bus_.now(), twist.linear.x, twist.angular.z);
}

void SimulatedMuseum::Impl::hear_speech(const docent_msgs::SpeechState& speech) {
  if (parse<SpeechStatus>(speech.state) != SpeechStatus::speaking) return crowd_.hear_speech(-1.0);
  if (speech.id.find("/please-") != std::string::npos)
    return crowd_.hear_request(run_seconds());  // no tale to gather for
  const Time end = from_message(speech.start) + seconds(speech.duration);
  crowd_.hear_speech(to_seconds(end - start_));
}

void SimulatedMuseum::Impl::start(const std::shared_ptr<Impl>& impl) {
  impl->start_ = impl->time_ = impl->bus_.now();
  keep_stepping(impl);
}

void SimulatedMuseum::Impl::keep_stepping(const std::weak_ptr<Impl>& weak) {
  const auto impl = weak.lock();
  if (!impl) return;
  const Duration behind = impl->bus_.now() - impl->time_;
  impl->bus_.after((behind / seconds(kWorldStep) + 1) * seconds(kWorldStep) - behind, [weak] {
    keep_stepping(weak);
    if (const auto living = weak.lock()) living->tick();
  });
}

void SimulatedMuseum::Impl::tick() {
  const Time now = bus_.now();
  if (now - time_ > seconds(0.5)) time_ = now - seconds(kWorldStep);  // too late to catch up: skip
  while (time_ + seconds(kWorldStep) <= now) {
    time_ = time_ + seconds(kWorldStep);
    step();
    ++steps_;
  }
}

Pose2 SimulatedMuseum::Impl::first_pose() {
  floor_.emplace(world_);
  if (options_.start) return *options_.start;
  Rng rng = rng_.stream("start");
  if (const auto start = random_start(world_, *floor_, rng)) return *start;
  return {world_.home.x, world_.home.y, Angle{}};
}

Crowd SimulatedMuseum::Impl::make_crowd() {
  const double density = crowd_density(options_.crowd).value_or(0.0);
  const auto count =
      options_.crowd_count.value_or(static_cast<std::size_t>(std::llround(density * floor_->free_area())));
  Crowd crowd{world_, std::move(*floor_), params_for(options_), count, rng_.stream("crowd"), view()};
  floor_.reset();
  return crowd;
}

WishParams SimulatedMuseum::Impl::wish_params() const {
  WishParams params;
  params.requests_per_hour = options_.requests_per_hour.value_or(world_.visitors_per_hour);
  const std::string& mode = options_.run_info.mode;
  if (mode == "closed") params.source = "staff";
  if (mode == "web") params.source = "web";
  return params;
}

RobotView SimulatedMuseum::Impl::view() const {
  const Pose2& pose = body_.pose();
  return {pose.position(), pose.theta.radians(), body_.linear() * unit(pose.theta), body_.angular(),
          body_.params().radius};
}

void SimulatedMuseum::Impl::step() {
  play_scenario();
  if (steersman_ && every(10)) steer();
  const Pose2 before = body_.pose();
  body_.step(time_, kWorldStep, !battery_.is_empty());
  if (has_fallen_) body_.carry_to(before);
  if (steps_ % 2 == 0) crowd_.step(run_seconds(), kPeopleStep, view());
  people_.clear();
  postures_.clear();
  beside_.clear();
  const Point2 centre = body_.pose().position();
  for (const Person& person : crowd_.people()) {
    constexpr double kBeside = 3.0;  // [m] more than any stopping distance
    const Point2 offset = person.position - centre;
    if (std::max(std::abs(offset.x), std::abs(offset.y)) <= kBeside) beside_.push_back(people_.size());
    people_.push_back({person.position, person.radius});
    postures_.push_back(person.posture());
  }
  touch();
  distance_ += distance(before.position(), body_.pose().position());
  charge();
  publish();
}

void SimulatedMuseum::Impl::charge() {
  if (charger_fault_ && run_seconds() >= charger_fault_until_) charger_fault_.reset();
  const bool is_in_reach = options_.contacts  ? options_.contacts->reach(body_.pose())
                           : options_.charger ? distance(*options_.charger, body_.pose().position()) < kChargerReach
                                              : false;
  const bool at_charger = is_in_reach && std::abs(body_.linear()) < 0.01;
  battery_.step(kWorldStep, body_.linear(), at_charger && !charger_fault_);
  const bool claims = at_charger && charger_fault_ == ChargerFault::Kind::claims;
  battery_.say(has_mute_battery_ ? Battery::Word::nothing : claims ? Battery::Word::charges : Battery::Word::truth);
}

void SimulatedMuseum::Impl::steer() {
  if (steered_until_ > 0.0 && run_seconds() >= steered_until_) return steersman_.reset();
  const auto command = steersman_->steer(run_seconds(), body_.pose(), body_.params().radius, people_, crowd_.floor());
  body_.command(time_, command.linear, command.angular);
}

void SimulatedMuseum::Impl::touch() {
  watch_people();
  const double radius = body_.params().radius;
  Point2 centre = body_.pose().position();
  std::fill(tactile_now_.begin(), tactile_now_.end(), 0);
  obstacles_.resolve(centre, radius, touches_);
  for (const Touch& touch : touches_) {
    const Solid& solid = world_.solids[touch.solid];
    log_.touch(time_, body_, {contact_kind(solid.kind), solid.id, touch.point, touch.towards, 0.0, std::nullopt});
    press(touch.towards);
  }
  for (const std::size_t i : beside_) {
    const double most = radius + postures_[i].physique->reach;
    const Point2 apart = postures_[i].at - centre;
    if (dot(apart, apart) > 1.1 * most * most) continue;  // no root for most
    const Disc part = nearest_part(postures_[i], centre, kRobotHeight);
    const double reach = radius + part.radius;
    const Point2 offset = part.centre - centre;
    const double away = norm(offset);
    if (away > reach + 0.001) continue;
    const Point2 towards = away > 1e-6 ? (1.0 / away) * offset : Point2{1.0, 0.0};
    const Person& person = crowd_.people()[i];
    log_.touch(time_, body_,
               {"people", "person-" + std::to_string(person.id), centre + radius * towards, towards,
                -dot(person.velocity, towards), person.id});
    press(towards);
    const double rest = crowd_.give_way(i, centre - (part.centre - postures_[i].at), reach);
    if (rest > 0.0) centre = centre - rest * towards;  // wedged in: it is the robot that stops
    people_[i].centre = postures_[i].at = crowd_.people()[i].position;
  }
  if (!touches_.empty()) obstacles_.resolve(centre, radius, touches_);
  body_.correct(centre);
  if (!has_fallen_ && obstacles_.has_fallen(centre)) {
    has_fallen_ = true;
    offer("fall", "stairs");
  }
  for (auto& contact : log_.finish_step(time_, kWorldStep, body_)) tell(contacts_, std::move(contact));
}

void SimulatedMuseum::Impl::press(Point2 towards) {
  const double bearing = (Angle::radians(std::atan2(towards.y, towards.x)) - body_.pose().theta).radians();
  const int segment = static_cast<int>(std::lround(bearing / (2.0 * std::numbers::pi) * kTactileSegments));
  tactile_now_[static_cast<std::size_t>((segment + kTactileSegments) % kTactileSegments)] = 1;
}

void SimulatedMuseum::Impl::watch_people() {
  samples_.clear();
  const Point2 centre = body_.pose().position();
  const Point2 ahead = unit(body_.pose().theta);
  for (const std::size_t i : beside_) {
    const Disc part = nearest_part(postures_[i], centre, kRobotHeight);
    const Point2 offset = part.centre - centre;
    const bool in_the_way = std::abs(cross(ahead, offset)) < body_.params().radius + part.radius + 0.1;
    ContactLog::PersonSample sample{crowd_.people()[i].id, offset, part.radius, false};
    sample.in_sight = in_the_way && std::abs(body_.linear()) > 0.01 && is_inside_stopping_distance(sample, body_) &&
                      instruments_.sees(body_.pose(), i, postures_);
    samples_.push_back(sample);
  }
  log_.watch(time_, body_, samples_);
}

void SimulatedMuseum::Impl::publish() {
  instruments_.publish_odometry(time_, steps_, body_);
  instruments_.publish_scans(time_, steps_, body_.pose(), postures_);
  if (cameras_) cameras_->step(time_, steps_, body_.pose(), body_.params().radius, crowd_.people());
  instruments_.publish_sonar(time_, steps_, body_.pose(), postures_);
  instruments_.publish_infrared(time_, steps_, body_.pose(), postures_);
  if (tactile_now_ != tactile_ || every(20)) {
    tactile_ = tactile_now_;
    instruments_.publish_tactile(time_, tactile_);
  }
  if (every(100)) instruments_.publish_battery(time_, battery_);
  if (every(10)) {
    publish_truth();
    constexpr double kTold = 0.17;  // [rad] ten degrees
    if (const bool leaves_out = instruments_.left_out() >= kTold; leaves_out != leaves_out_) {
      leaves_out_ = leaves_out;
      offer("left_out", leaves_out ? "begins" : "ends");
    }
    auto wishes = visitors_.step(time_, time_ - start_);
    for (const std::string& id : wishes.offered) offer("request", id);
    for (auto& request : wishes.requests) requests_.publish(std::move(request));
    for (auto& choice : wishes.choices) choices_.publish(std::move(choice));
    help_in_office();
  }
}

void SimulatedMuseum::Impl::publish_truth() {
  docent_msgs::TrueState state;
  state.header = {to_message(time_), "world"};
  const Pose2& pose = body_.pose();
  state.x = pose.x;
  state.y = pose.y;
  state.theta = pose.theta.radians();
  state.linear = body_.linear();
  state.angular = body_.angular();
  state.distance_m = distance_;
  state.inside_area = world_.operating_area.size() < 3 || contains(world_.operating_area, pose.position());
  state.battery = battery_.charge();
  state.blocked_beams = instruments_.blocked_share();
  state.contact_seconds = log_.seconds_wheels_turning();
  state.visitors = crowd_.visitors();
  state.nearest_solid_m = obstacles_.clearance(pose.position()) - body_.params().radius;
  state.nearest_person_m = 1e3;
  const auto people = crowd_.people();
  state.people.reserve(people.size());
  for (std::size_t i = 0; i < people.size(); ++i) {
    const Person& person = people[i];
    const double gap = gap_to(i, pose.position());
    state.nearest_person_m = std::min(state.nearest_person_m, gap);
    // As a disc that reaches as far towards the robot as they do.
    const double radius = distance(person.position, pose.position()) - body_.params().radius - gap;
    state.people.push_back({person.id, static_cast<float>(person.position.x), static_cast<float>(person.position.y),
                            static_cast<float>(person.velocity.x), static_cast<float>(person.velocity.y),
                            static_cast<float>(radius), instruments_.met(i) > 0});
    state.person_beams.push_back(static_cast<std::uint8_t>(std::min(instruments_.met(i), 255)));
  }
  tell(states_, std::move(state));
}

double SimulatedMuseum::Impl::gap_to(std::size_t person, Point2 centre) const {
  constexpr double kFar = 5.0;  // [m] where nobody asks for centimetres
  const double apart = distance(postures_[person].at, centre);
  const Disc part = apart > kFar ? people_[person] : nearest_part(postures_[person], centre, kRobotHeight);
  return distance(part.centre, centre) - part.radius - body_.params().radius;
}

void SimulatedMuseum::Impl::offer(std::string kind, std::string subject) {
  tell(offers_, docent_msgs::TrueOffer{{to_message(time_), "world"}, std::move(kind), std::move(subject)});
}

SimulatedMuseum::SimulatedMuseum(transport::Bus& robot_bus, transport::Bus& truth_bus, SimulationOptions options) {
  DOCENT_CHECK(validate(options));
  impl_ = std::make_shared<Impl>(robot_bus, truth_bus, std::move(options));
  const std::weak_ptr<Impl> weak = impl_;
  const auto listen = [&](const auto& topic, auto method) {
    using Message = typename std::decay_t<decltype(topic)>::Type;
    robot_bus.subscribe(topic, std::function<void(const Message&)>{[weak, method](const Message& message) {
                          if (const auto impl = weak.lock()) method(*impl, message);
                        }});
  };
  listen(topics::kCommandVelocity, [](Impl& impl, const geometry_msgs::Twist& twist) { impl.command(twist); });
  listen(topics::kHorn, [](Impl& impl, const docent_msgs::Horn&) { impl.hear_horn(); });
  listen(topics::kSpeechState, [](Impl& impl, const docent_msgs::SpeechState& speech) { impl.hear_speech(speech); });
  listen(topics::kExpression, [](Impl& impl, const docent_msgs::Expression& expression) { impl.see_face(expression); });
  listen(topics::kSceneCameraView, [](Impl& impl, const docent_msgs::CameraView& view) { impl.turn_camera(view); });
  listen(topics::kRequestBoard, [](Impl& impl, const docent_msgs::RequestBoard& board) { impl.see_board(board); });
  listen(topics::kMissionState,
         [](Impl& impl, const docent_msgs::MissionState& mission) { impl.see_mission(mission); });
  listen(topics::kOfficeState, [](Impl& impl, const docent_msgs::OfficeState& state) { impl.see_office(state); });
  Impl::start(impl_);
}

SimulatedMuseum::~SimulatedMuseum() = default;

Pose2 SimulatedMuseum::world_from_base() const { return impl_->body().pose(); }
std::size_t SimulatedMuseum::people() const { return impl_->crowd().people().size(); }
double SimulatedMuseum::free_area() const { return impl_->crowd().floor().free_area(); }

}  // namespace docent::simulator
