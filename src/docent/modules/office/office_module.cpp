#include "docent/modules/office/office_module.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "docent/base/random.h"
#include "docent/interaction/speech/sentences.h"
#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"
#include "docent/modules/office/office_wishes.h"
#include "docent/modules/shared/pose_tracker.h"
#include "docent/modules/shared/room_names.h"
#include "docent/task_control/mission_service/museum_programme.h"
#include "docent/task_control/office/office_mission.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::modules {
namespace {

using interaction::Sentence;
using task_control::OfficeLine;
using task_control::OfficePhase;

constexpr Duration kOfficePeriod = std::chrono::milliseconds{250};
constexpr Duration kBlind = std::chrono::seconds{60};  // without a picture: then nobody looks for things

/// Section `office`: deliveries and tidying up.
struct OfficeModuleParams : task_control::OfficeParams {
  bool enabled = false;  ///< the robot takes orders to deliver and to tidy up
  int button = 3;        ///< 0..4: the coloured button that says "done"; 0: none does
  template <class V>
  void visit(V& v) {
    v("enabled", enabled);
    task_control::OfficeParams::visit(v);
    v("button", button);
  }
  [[nodiscard]] Result<void> validate() const {
    if (button < 0 || button > kButtons) return fail("office.button must be 0..4");
    return task_control::OfficeParams::validate();
  }
};

Sentence sentence_for(OfficeLine line) {
  switch (line) {
    case OfficeLine::delivery:
      return Sentence::office_delivery;
    case OfficeLine::please_put_in:
      return Sentence::office_put_in;
    case OfficeLine::thanks:
      return Sentence::office_thanks;
    case OfficeLine::please_empty:
      return Sentence::office_empty;
    case OfficeLine::all_tidy:
      return Sentence::office_tidy;
    case OfficeLine::bin_stays_full:
      return Sentence::office_bin_full;
    case OfficeLine::cannot_get_there:
      break;
  }
  return Sentence::office_no_way;
}

class OfficeModule final : public Module {
 public:
  OfficeModule(const ModuleContext& context, const OfficeModuleParams& params)
      : bus_{context.bus},
        museum_{context.museum},
        params_{params},
        ways_{task_control::ways_in(context.museum, context.config.body().radius)},
        mission_{params, [this](const std::string& room, Point2 robot) { return plan_of(room, robot); },
                 context.museum.home},
        pose_{reach_of(context.config.body())},
        wishes_{bus_, Rng{context.seed}.stream("office"),
                [this](bool is_fulfilled, const std::string& reason) {
                  mission_.wish_over(is_fulfilled, reason, bus_.now());
                  act();
                }},
        state_{bus_.publisher(topics::kOfficeState)},
        say_{bus_.publisher(topics::kSay)} {
    bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry, [this](const auto& odom) { pose_.on_odometry(odom); });
    bus_.subscribe<docent_msgs::Belief>(topics::kBelief, [this](const auto& belief) { pose_.on_belief(belief); });
    bus_.subscribe<docent_msgs::OfficeOrder>(topics::kOfficeOrder, [this](const auto& order) { obey(order); });
    bus_.subscribe<docent_msgs::Button>(topics::kButton, [this](const auto& button) {
      if (params_.button > 0 && button.number == params_.button) mission_.confirm(bus_.now());
      act();
    });
    bus_.subscribe<docent_msgs::SeenThings>(topics::kSeenThings, [this](const auto& seen) { see(seen); });
    bus_.every(kOfficePeriod, [this] { tick(); });
    publish();
  }

  [[nodiscard]] ModuleHealth health() const override {
    return fault_.empty() ? ModuleHealth{} : ModuleHealth{"degraded", fault_};
  }

 private:
  void obey(const docent_msgs::OfficeOrder& order) {
    const auto kind = parse<task_control::OfficeOrderKind>(order.kind);
    fault_ = kind ? "" : "an order that it does not know: " + order.kind;
    if (!kind) return;
    seen_at_ = bus_.now();
    mission_.order({order.id, *kind, order.room}, bus_.now());
    act();
  }

  const mapping::RoomGraph& rooms() {
    if (!graph_) graph_ = mapping::room_graph(museum_);
    return *graph_;
  }

  std::optional<task_control::ViewPlan> plan_of(const std::string& room, Point2 robot) {
    const mapping::RoomGraph& graph = rooms();
    const auto& rooms = graph.rooms();
    const auto wanted = std::find_if(rooms.begin(), rooms.end(), [&](const auto& one) { return one.id == room; });
    if (!room.empty() && wanted == rooms.end()) return std::nullopt;
    const int index = room.empty() ? mapping::RoomGraph::kNone : static_cast<int>(wanted - rooms.begin());
    const auto is_wanted = [&](Point2 at) {
      if (!museum_.area.empty() && !contains(museum_.area, at)) return false;
      const int there = graph.room_at(at);
      return index == mapping::RoomGraph::kNone ? there != mapping::RoomGraph::kNone : there == index;
    };
    const auto may_stand = [this](Point2 at) { return ways_ == nullptr || !ways_->is_closed(at); };
    return task_control::ViewPlan{museum_.map, is_wanted, may_stand, robot, params_.view};
  }

  void see(const docent_msgs::SeenThings& seen) {
    std::vector<task_control::KnownThing> things;
    for (const docent_msgs::SeenThing& thing : seen.things)
      things.push_back({thing.id, thing.object, {thing.x, thing.y}});
    mission_.see_things(std::move(things));
    const Time looked = from_message(seen.header.stamp);
    if (looked == last_look_) return;
    last_look_ = looked;
    seen_at_ = bus_.now();
    const auto pose = pose_.map_from_base_at(looked);
    if (pose && pose_.localized()) mission_.stand(*pose, true, bus_.now());
  }

  void tick() {
    const Time now = bus_.now();
    const auto pose = pose_.map_from_base();
    if (pose && pose_.localized()) mission_.stand(*pose, false, now);
    const bool looks =
        mission_.status().order.kind == task_control::OfficeOrderKind::tidy &&
        (mission_.status().phase == OfficePhase::looking || mission_.status().phase == OfficePhase::checking);
    if (looks && now - seen_at_ > kBlind) mission_.fail("no picture comes: see the modules sight and things", now);
    mission_.tick(now);
    act();
    wishes_.tick();
  }

  void act() {
    auto actions = mission_.take_actions();
    if (actions.withdraws) wishes_.withdraw();
    if (actions.wish) wishes_.make(actions.wish->kind, actions.wish->target);
    for (const auto& [line, about] : actions.lines) say(line, about);
    publish();
  }

  void say(OfficeLine line, const std::string& about) {
    const std::string language = museum_.languages.empty() ? "en" : museum_.languages.front();
    const bool is_room = line == OfficeLine::delivery || line == OfficeLine::cannot_get_there;
    const mapping::Room* room = is_room ? rooms().find(about) : nullptr;
    const std::string name = room != nullptr ? museum::translated(name_of(*room, museum_.languages), language) : "";
    const Mood mood = Mood::neutral;
    say_.publish({"office-" + std::to_string(++lines_) + "-" + to_text(line),
                  interaction::sentence(sentence_for(line), language, mood, 0, name.empty() ? about : name), language,
                  to_text(mood)});
  }

  void publish() {
    const task_control::OfficeStatus& status = mission_.status();
    if (published_ && *published_ == status) return;
    published_ = status;
    docent_msgs::OfficeState message;
    message.header = {to_message(bus_.now()), "map"};
    message.order = status.order.id;
    message.kind = status.order.id.empty() ? "" : to_text(status.order.kind);
    message.phase = to_text(status.phase);
    message.room = status.order.room;
    message.reason = status.reason;
    message.points = status.points.has_value();
    if (status.points) message.x = status.points->x, message.y = status.points->y;
    message.found = status.found, message.picked_up = status.picked_up;
    message.left = status.left, message.in_bin = status.in_bin;
    state_.publish(std::move(message));
  }

  transport::Bus& bus_;
  const museum::Museum& museum_;
  OfficeModuleParams params_;
  std::shared_ptr<const planning::RoutePlanner> ways_;
  std::optional<mapping::RoomGraph> graph_;  ///< made when it is needed first
  task_control::OfficeMission mission_;
  PoseTracker pose_;
  OfficeWishes wishes_;
  transport::Publisher<docent_msgs::OfficeState> state_;
  transport::Publisher<docent_msgs::Say> say_;
  std::optional<task_control::OfficeStatus> published_;
  Time last_look_{}, seen_at_{};
  std::string fault_;
  int lines_ = 0;
};

/// A robot that takes no such orders.
class NoOffice final : public Module {};

}  // namespace

Result<std::unique_ptr<Module>> make_office(const ModuleContext& context) {
  auto params = context.config.section<OfficeModuleParams>("office");
  if (!params) return tl::unexpected<Error>(params.error());
  if (!params->enabled) return std::make_unique<NoOffice>();
  return std::make_unique<OfficeModule>(context, *params);
}

Result<robot::ParameterRows> parameters_of_office(const robot::RobotConfig& config) {
  return robot::list_parameters<OfficeModuleParams>(config, "office");
}

}  // namespace docent::modules
