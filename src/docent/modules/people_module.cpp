#include "docent/modules/people_module.h"

#include "docent/messages/conversions.h"
#include "docent/people/people_tracker.h"

namespace docent {
namespace {

constexpr Duration kStaleAfter = std::chrono::seconds{2};

struct PeopleParams {
  ClusterParams clusters;
  PeopleTrackerParams tracker;
  template <class V>
  void visit(V& v) {
    v("clusters", clusters);
    v("tracker", tracker);
  }
  [[nodiscard]] Result<void> validate() const {
    if (auto valid = clusters.validate(); !valid) return valid;
    return tracker.validate();
  }
};

Pose2 pose_of(const std::array<double, 3>& fields) { return {fields[0], fields[1], Angle::radians(fields[2])}; }

class PeopleModule final : public Module {
 public:
  PeopleModule(const ModuleContext& context, const PeopleParams& params)
      : bus_{context.bus},
        params_{params},
        tracker_{params.tracker},
        people_{bus_.publisher(topics::kPeople)},
        people_odom_{bus_.publisher(topics::kPeopleInOdom)} {
    bus_.subscribe<docent_msgs::PersonBeams>(topics::kPersonBeams, [this](const auto& beams) { on_beams(beams); });
  }

  [[nodiscard]] ModuleHealth health() const override {
    if (bus_.now() - received_ > kStaleAfter) return {"degraded", "no docent/person_beams"};
    return {};
  }

 private:
  void on_beams(const docent_msgs::PersonBeams& beams) {
    received_ = bus_.now();
    const Pose2 map_from_base = pose_of(beams.map_from_base);
    const Pose2 odom_from_base = pose_of(beams.odom_from_base);
    std::vector<Point2> points;
    for (std::size_t i = 0; i < beams.x.size(); ++i)
      points.push_back(odom_from_base * Point2{static_cast<double>(beams.x[i]), static_cast<double>(beams.y[i])});
    tracker_.update(find_people(points, odom_from_base.position(), params_.clusters), from_message(beams.header.stamp));
    publish(people_odom_, beams, "odom", Pose2{}, odom_from_base);
    publish(people_, beams, "map", map_from_base * inverse(odom_from_base), map_from_base);
  }

  void publish(const Publisher<docent_msgs::People>& publisher, const docent_msgs::PersonBeams& beams,
               const char* frame, const Pose2& frame_from_odom, const Pose2& frame_from_base) const {
    docent_msgs::People message;
    message.header = {beams.header.stamp, frame};
    message.localized = beams.localized;
    message.frame_from_base = {frame_from_base.x, frame_from_base.y, frame_from_base.theta.radians()};
    for (const TrackedPerson& person : tracker_.people()) {
      const Point2 position = frame_from_odom * person.position;
      const Point2 velocity = frame_from_odom * person.velocity - frame_from_odom.position();
      message.people.push_back({person.id, static_cast<float>(position.x), static_cast<float>(position.y),
                                static_cast<float>(velocity.x), static_cast<float>(velocity.y)});
    }
    if (!beams.localized && frame != std::string_view{"odom"}) message.people.clear();
    publisher.publish(std::move(message));
  }

  Bus& bus_;
  PeopleParams params_;
  PeopleTracker tracker_;
  Publisher<docent_msgs::People> people_;
  Publisher<docent_msgs::People> people_odom_;
  Time received_{};
};

}  // namespace

Result<std::unique_ptr<Module>> make_people(const ModuleContext& context) {
  auto params = context.config.section<PeopleParams>("people");
  if (!params) return tl::unexpected<Error>(params.error());
  return std::make_unique<PeopleModule>(context, *params);
}

}  // namespace docent
