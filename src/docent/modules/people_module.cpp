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

class PeopleModule final : public Module {
 public:
  PeopleModule(const ModuleContext& context, const PeopleParams& params)
      : bus_{context.bus}, params_{params}, tracker_{params.tracker}, people_{bus_.publisher(topics::kPeople)} {
    bus_.subscribe<docent_msgs::PersonBeams>(topics::kPersonBeams, [this](const auto& beams) { on_beams(beams); });
  }

  [[nodiscard]] ModuleHealth health() const override {
    if (bus_.now() - received_ > kStaleAfter) return {"degraded", "no docent/person_beams"};
    return {};
  }

 private:
  void on_beams(const docent_msgs::PersonBeams& beams) {
    received_ = bus_.now();
    if (!beams.localized) {
      tracker_.clear();  // nobody's place in the map is known
    } else {
      const Pose2 map_from_base{beams.map_from_base[0], beams.map_from_base[1], Angle::radians(beams.map_from_base[2])};
      std::vector<Point2> points;
      for (std::size_t i = 0; i < beams.x.size(); ++i)
        points.push_back(map_from_base * Point2{static_cast<double>(beams.x[i]), static_cast<double>(beams.y[i])});
      tracker_.update(find_people(points, map_from_base.position(), params_.clusters),
                      from_message(beams.header.stamp));
    }
    docent_msgs::People message;
    message.header = {beams.header.stamp, "map"};
    for (const TrackedPerson& person : tracker_.people())
      message.people.push_back({person.id, static_cast<float>(person.position.x), static_cast<float>(person.position.y),
                                static_cast<float>(person.velocity.x), static_cast<float>(person.velocity.y)});
    people_.publish(std::move(message));
  }

  Bus& bus_;
  PeopleParams params_;
  PeopleTracker tracker_;
  Publisher<docent_msgs::People> people_;
  Time received_{};
};

}  // namespace

Result<std::unique_ptr<Module>> make_people(const ModuleContext& context) {
  auto params = context.config.section<PeopleParams>("people");
  if (!params) return tl::unexpected<Error>(params.error());
  return std::make_unique<PeopleModule>(context, *params);
}

}  // namespace docent
