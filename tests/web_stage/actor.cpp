#include "actor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "docent/interaction/speech/sentences.h"
#include "docent/messages/conversions.h"

namespace docent::stage {
namespace {
constexpr double kStep = 0.05;
constexpr double kExplainPerCharacter = 0.065;

bool is_open(const docent_msgs::RequestState& entry) { return entry.state == "queued" || entry.state == "active"; }
}  // namespace

Actor::Actor(transport::Bus& bus, const museum::Museum& museum, Scenery& scenery, Rng rng, Options options)
    : bus_{bus},
      museum_{museum},
      scenery_{scenery},
      rng_{rng},
      options_{options},
      map_from_base_{museum.home},
      map_from_odom_{3.0, -2.0, Angle::degrees(40)},
      odometry_{bus.publisher(topics::kOdometry)},
      front_{bus.publisher(topics::kScanFront)},
      rear_{bus.publisher(topics::kScanRear)},
      battery_{bus.publisher(topics::kBattery)},
      belief_{bus.publisher(topics::kBelief)},
      people_{bus.publisher(topics::kPeople)},
      avoid_{bus.publisher(topics::kAvoidState)},
      path_{bus.publisher(topics::kPath)},
      goal_{bus.publisher(topics::kGoalState)},
      mission_{bus.publisher(topics::kMissionState)},
      board_publisher_{bus.publisher(topics::kRequestBoard)},
      speech_{bus.publisher(topics::kSpeechState)},
      health_{bus.publisher(topics::kHealth)},
      horn_{bus.publisher(topics::kHorn)},
      sound_{bus.publisher(topics::kSoundState)},
      expression_{bus.publisher(topics::kExpression)} {
  const Point2 start = scenery_.any_place();
  map_from_base_ = {start.x, start.y, Angle::radians(rng_.uniform(-3.0, 3.0))};
  for (int i = 0; i < 5; ++i) {
    const Point2 place = scenery_.any_place();
    guesses_.push_back({place.x, place.y, Angle::radians(rng_.uniform(-3.0, 3.0))});
  }
  bus_.subscribe<docent_msgs::Request>(topics::kRequest, [this](const auto& request) { receive(request); });
  bus_.subscribe<docent_msgs::Choice>(topics::kChoice, [this](const auto& choice) {
    if (phase_ != Phase::asking || choice.prompt_id != prompt_.id) return;
    const auto* exhibit = museum_.find_exhibit(exhibit_);
    prompt_ = {};
    if (choice.choice != "more" || exhibit == nullptr) return close_active("fulfilled"), next_target();
    took_long_ = true;
    set_phase(Phase::explaining);
    speak(museum::translated(exhibit->long_text.empty() ? exhibit->short_text : exhibit->long_text, language_), "long");
  });
  bus_.subscribe<docent_msgs::Say>(topics::kSay, [this](const auto& say) {
    language_ = say.language;
    speak(say.text, "help");
  });
  bus_.every(seconds(kStep), [this] { step(); });
  bus_.every(seconds(0.2), [this] { think(); });
  bus_.every(seconds(0.5), [this] { publish_health(); });
  if (options_.horn_s > 0.0) bus_.every(seconds(options_.horn_s), [this] { horn_.publish({}); });
  publish_board();
  publish_mission();
  publish_belief();
  publish_health();
}

void Actor::set_phase(Phase phase) {
  phase_ = phase;
  phase_since_ = bus_.now();
  const bool has_music = phase_ == Phase::driving;
  sound_.publish({{}, 1.0, has_music ? options_.music : "", has_music ? 0.3 : 0.0, to_message(phase_since_)});
  publish_mission();
  publish_path();
}

void Actor::receive(const docent_msgs::Request& request) {
  if (request.kind == "cancel") {
    for (auto& entry : board_.requests) {
      if (entry.request.id != request.target || !is_open(entry)) continue;
      entry.state = "cancelled";
      entry.changed = to_message(bus_.now());
    }
    return publish_board();
  }
  if (request.kind == "skip") {
    if (exhibit_ != request.target || (phase_ != Phase::driving && phase_ != Phase::explaining)) return;
    return agenda_.empty() ? close_active("fulfilled") : void(), next_target();
  }
  for (const auto& entry : board_.requests) {
    if (entry.request.id == request.id) return publish_board();
  }
  docent_msgs::RequestState entry;
  entry.request = request;
  entry.state = "queued";
  entry.created = entry.changed = to_message(bus_.now());
  board_.requests.push_back(entry);
  publish_board();
  if (phase_ == Phase::idle || phase_ == Phase::going_home) next_target();
}

void Actor::wish(const std::string& kind, const std::string& target, const std::string& visitor) {
  docent_msgs::Request request;
  char id[37];
  std::snprintf(id, sizeof id, "018f3a6c-5b2e-7c3d-9a4b-%012d", ++count_);
  request.id = id;
  request.stamp = to_message(bus_.now());
  request.source = "visitor";
  request.visitor = visitor;
  request.kind = kind;
  request.target = target;
  receive(request);
}

void Actor::close_active(const std::string& state) {
  for (auto& entry : board_.requests) {
    if (entry.state != "active") continue;
    if (entry.request.kind == "tour" && !agenda_.empty()) continue;
    entry.state = state;
    entry.changed = to_message(bus_.now());
    ++served_;
    if (entry.request.kind == "tour") ++tours_;
  }
  publish_board();
}

void Actor::next_target() {
  speech_.publish({});
  if (agenda_.empty()) {
    tour_.clear();
    for (auto& entry : board_.requests) {
      if (entry.state != "queued") continue;
      entry.state = "active";
      entry.changed = to_message(bus_.now());
      language_ = entry.request.language.empty() ? "en" : entry.request.language;
      if (const auto* tour = museum_.find_tour(entry.request.target); entry.request.kind == "tour" && tour != nullptr) {
        tour_ = tour->id;
        agenda_ = tour->exhibits;
        if (agenda_.empty()) agenda_ = {museum_.exhibits.front().id, museum_.exhibits.back().id};
      } else {
        agenda_ = {entry.request.target};
      }
      break;
    }
  }
  publish_board();
  took_long_ = false;
  if (agenda_.empty()) {
    exhibit_.clear();
    way_ = scenery_.way(map_from_base_.position(), museum_.home.position());
    return set_phase(Phase::going_home);
  }
  exhibit_ = agenda_.front();
  agenda_.erase(agenda_.begin());
  const auto* exhibit = museum_.find_exhibit(exhibit_);
  way_ = scenery_.way(map_from_base_.position(), exhibit->pose.position());
  if (way_.empty()) way_ = {exhibit->pose.position()};
  set_phase(Phase::driving);
}

void Actor::speak(const std::string& text, const std::string& name) {
  docent_msgs::SpeechState speech;
  speech.header.stamp = to_message(bus_.now());
  speech.id = "say-" + std::to_string(++count_) + "/" + name;
  speech.state = "speaking";
  speech.text = text;
  speech.language = language_;
  speech.start = to_message(bus_.now());
  speech.duration = speech_s_ = 1.0 + options_.talk * kExplainPerCharacter * static_cast<double>(text.size());
  speech.audio = "5a5a5a5a";
  speech_.publish(speech);
}

void Actor::think() {
  const double since = to_seconds(bus_.now() - phase_since_);
  if (options_.is_busy && rng_.chance(0.012) && phase_ != Phase::lost) {
    static const char* const kNames[] = {"Ada", "Kurt", "Rosalind", "Konrad", "Lise", "Emmy", "", "Otto"};
    const auto& any = museum_.exhibits[static_cast<std::size_t>(
        rng_.integer(0, static_cast<std::int64_t>(museum_.exhibits.size()) - 1))];
    const auto open = std::count_if(board_.requests.begin(), board_.requests.end(), is_open);
    if (open < 5) wish("exhibit", any.id, kNames[rng_.integer(0, 7)]);
  }
  switch (phase_) {
    case Phase::lost:
      if (since > options_.lost_s) next_target();
      break;
    case Phase::driving:
    case Phase::going_home:
      if (!way_.empty()) break;
      if (phase_ == Phase::going_home) {
        set_phase(Phase::idle);
        break;
      }
      set_phase(Phase::explaining);
      ++explained_;
      speak(museum::translated(museum_.find_exhibit(exhibit_)->short_text, language_), "short");
      break;
    case Phase::explaining:
      if (since < speech_s_) break;
      speech_.publish({});
      if (took_long_) {
        close_active("fulfilled");
        next_target();
        break;
      }
      ask();
      set_phase(Phase::asking);
      break;
    case Phase::asking:
      if (bus_.now() < from_message(prompt_.deadline)) break;
      prompt_ = {};
      close_active("fulfilled");
      next_target();
      break;
    case Phase::idle:
      break;
  }
  if (phase_ != Phase::idle) publish_belief();
  publish_path();
}

void Actor::step() {
  move(kStep);
  scenery_.step(kStep, map_from_base_.position());
  const Time now = bus_.now();
  nav_msgs::Odometry odometry;
  odometry.header.stamp = to_message(now);
  odometry.pose.pose = to_message(inverse(map_from_odom_) * map_from_base_);
  odometry.twist.twist.linear.x = speed_;
  odometry.twist.twist.angular.z = turn_;
  odometry_.publish(odometry);
  if (++count_ % 2 == 0) return;
  front_.publish(scenery_.scan(map_from_base_, now));
  rear_.publish(scenery_.scan(map_from_base_ * Pose2{0, 0, Angle::degrees(180)}, now));
  docent_msgs::People people;
  people.header.stamp = to_message(now);
  for (const auto& walker : scenery_.walkers()) {
    if (phase_ == Phase::lost || !scenery_.sees(map_from_base_.position(), walker.at)) continue;
    people.people.push_back({walker.id, static_cast<float>(walker.at.x), static_cast<float>(walker.at.y),
                             static_cast<float>(walker.velocity.x), static_cast<float>(walker.velocity.y)});
  }
  people_.publish(people);
  docent_msgs::AvoidState avoid;
  avoid.header.stamp = to_message(now);
  avoid.state = speed_ > 0.02 ? "driving" : "stopped";
  avoid.speed_cap = 0.7;
  avoid.linear = speed_;
  avoid.angular = turn_;
  avoid.path_blocked = !way_.empty() && std::abs(speed_) < 0.02 && std::abs(turn_) < 0.1;
  avoid.unmapped_obstacle = avoid.path_blocked;
  if (avoid.path_blocked) avoid.reason = "person_in_way";
  avoid.nearest_real_m = 0.6 + 0.2 * std::sin(to_seconds(now));
  avoid.nearest_virtual_m = 1.4;
  for (int i = 0; i <= 8; ++i) {
    for (int k = -8; k <= 8; ++k) {
      const double v = std::max(0.0, speed_ + (i - 4) * 0.04);
      const double w = turn_ + k * 0.06;
      const double value = v > 0.65 ? -1.0 : v + 0.3 * std::cos(2.0 * (w - turn_));
      avoid.window.push_back({static_cast<float>(v), static_cast<float>(w), static_cast<float>(value)});
    }
  }
  avoid_.publish(avoid);
  publish_expression(avoid.path_blocked);
  sensor_msgs::BatteryState battery;
  battery.percentage = 0.83F;
  battery_.publish(battery);
}

/// Glad when the way is free, angry when somebody stands in it for long; it looks where it turns.
void Actor::publish_expression(bool is_blocked) {
  const double goal = phase_ == Phase::lost ? 0.0 : is_blocked ? -1.0 : 0.8;
  valence_ += std::clamp(goal - valence_, -0.05, 0.05);
  docent_msgs::Expression expression;
  expression.header.stamp = to_message(bus_.now());
  expression.valence = valence_;
  expression.mood = valence_ > 0.3 ? "happy" : valence_ < -0.3 ? "angry" : "neutral";
  expression.is_speaking = phase_ == Phase::explaining;
  expression.gaze = way_.empty() ? "visitor" : "goal";
  expression.pan = std::clamp(turn_, -0.8, 0.8);
  expression_.publish(expression);
}

void Actor::publish_belief() {
  docent_msgs::Belief belief;
  const Time now = bus_.now();
  belief.header.stamp = to_message(now);
  belief.cell_size = 0.15F;
  belief.odom_pose = to_message(inverse(map_from_odom_) * map_from_base_);
  const double part = phase_ == Phase::lost ? to_seconds(now - phase_since_) / options_.lost_s : 1.0;
  belief.localized = phase_ != Phase::lost;
  belief.p_lost = belief.localized ? 0.004 : 1.0 - 0.6 * part;
  belief.entropy = 13.0 * (1.0 - part) + 1.0;
  belief.beams_used = 58;
  belief.beams_filtered = 14;
  // Everywhere at first, then several places, then one.
  const double everywhere = part < 0.4 ? 1.0 - 2.0 * part : 0.0;
  if (everywhere > 0.0) {
    auto& rest = belief.rest;
    const auto& frame = museum_.map.frame;
    rest.cell_size = 0.75F;
    rest.origin_x = static_cast<float>(frame.origin.x);
    rest.origin_y = static_cast<float>(frame.origin.y);
    rest.columns = static_cast<std::uint32_t>(frame.columns * frame.resolution / 0.75) + 1;
    rest.rows = static_cast<std::uint32_t>(frame.rows * frame.resolution / 0.75) + 1;
    Rng texture{7};
    for (std::uint32_t i = 0; i < rest.columns * rest.rows; ++i) {
      rest.mass.push_back(static_cast<float>(everywhere * (0.4 + texture.uniform()) / (rest.columns * rest.rows)));
    }
  }
  const auto add = [&](const Pose2& centre, double mass, double spread) {
    docent_msgs::Hypothesis hypothesis;
    hypothesis.x = centre.x;
    hypothesis.y = centre.y;
    hypothesis.theta = centre.theta.radians();
    hypothesis.mass = mass;
    hypothesis.covariance[0] = hypothesis.covariance[4] = spread * spread;
    belief.hypotheses.push_back(hypothesis);
    for (int i = 0; i < 120; ++i) {
      belief.cells.push_back({static_cast<float>(centre.x + rng_.normal(0.0, spread)),
                              static_cast<float>(centre.y + rng_.normal(0.0, spread)), 0.0F,
                              static_cast<float>(mass / 120.0)});
    }
  };
  const double rest = 1.0 - everywhere;
  const double wrong = belief.localized ? 0.0 : (1.0 - part) * rest;
  add(map_from_base_, rest - wrong, belief.localized ? 0.1 : 0.5 * (1.0 - part) + 0.2);
  if (wrong > 0.02) {
    for (const auto& guess : guesses_)
      add(guess, wrong / static_cast<double>(guesses_.size()), 0.7 * (1.0 - part) + 0.3);
  }
  std::stable_sort(belief.hypotheses.begin(), belief.hypotheses.end(),
                   [](const auto& a, const auto& b) { return a.mass > b.mass; });
  belief_.publish(belief);
}

void Actor::publish_path() {
  nav_msgs::Path path;
  Point2 last = map_from_base_.position();
  double remaining = 0.0;
  for (const Point2 point : way_) {
    geometry_msgs::PoseStamped pose;
    pose.pose = to_message(Pose2{point.x, point.y, Angle{}});
    path.poses.push_back(pose);
    remaining += distance(last, point);
    last = point;
  }
  path_.publish(path);
  docent_msgs::GoalState goal;
  goal.id = exhibit_;
  goal.state = way_.empty() ? "idle" : "driving";
  goal.remaining_m = remaining;
  goal_.publish(goal);
}

void Actor::ask() {
  prompt_ = {
      "task-" + std::to_string(++count_) + "/more",    language_, museum_.languages, {}, {"more", "next"}, "next",
      to_message(bus_.now() + seconds(options_.ask_s))};
  for (const std::string& language : museum_.languages)
    prompt_.texts.push_back(interaction::sentence(interaction::Sentence::offer_more, language, Mood::neutral, 0));
}

void Actor::publish_mission() {
  docent_msgs::MissionState mission;
  mission.header.stamp = to_message(bus_.now());
  const auto* exhibit = museum_.find_exhibit(exhibit_);
  mission.tour_id = tour_;
  mission.exhibit_id = exhibit_;
  mission.agenda = agenda_;
  mission.exhibits_explained = explained_;
  mission.tours_completed = tours_;
  mission.requests_served = served_;
  mission.prompt = prompt_;
  auto what = interaction::Sentence::idle;
  switch (phase_) {
    case Phase::lost:
      mission.phase = "relocalizing";
      what = interaction::Sentence::relocalizing;
      break;
    case Phase::idle:
      mission.phase = "idle";
      break;
    case Phase::driving:
      mission.phase = "driving";
      what = interaction::Sentence::driving;
      break;
    case Phase::explaining:
      mission.phase = "explaining";
      what = interaction::Sentence::explaining;
      break;
    case Phase::asking:
      mission.phase = "asking";
      what = interaction::Sentence::asking;
      break;
    case Phase::going_home:
      mission.phase = "going_home";
      what = interaction::Sentence::going_home;
      break;
  }
  const museum::Translations title = exhibit != nullptr ? exhibit->title : museum::Translations{};
  mission.languages = museum_.languages;
  for (const std::string& language : mission.languages)
    mission.texts.push_back(
        interaction::sentence(what, language, Mood::neutral, 0, museum::translated(title, language)));
  mission_.publish(mission);
}

void Actor::publish_board() {
  board_.header.stamp = to_message(bus_.now());
  ++board_.revision;
  board_publisher_.publish(board_);
}

void Actor::publish_health() {
  for (const char* name :
       {"robot", "localize", "people", "map", "plan", "avoid", "hazards", "executive", "mission", "sound", "web"}) {
    docent_msgs::Health health;
    health.header.stamp = to_message(bus_.now());
    health.module = name;
    health.state = "ready";
    health_.publish(health);
  }
}

}  // namespace docent::stage
