#include "docent/modules/perception/people_module.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "docent/messages/conversions.h"
#include "docent/people/people_finder.h"

namespace docent::modules {
namespace {

constexpr Duration kStaleBeams = std::chrono::seconds{2};
constexpr std::string_view kMapFrame = "map";

Pose2 pose_of(const std::array<double, 3>& fields) { return {fields[0], fields[1], Angle::radians(fields[2])}; }

sensor_models::BeamOrigin origin_of(std::uint8_t field) {
  return field <= static_cast<std::uint8_t>(sensor_models::BeamOrigin::not_map)
             ? static_cast<sensor_models::BeamOrigin>(field)
             : sensor_models::BeamOrigin::unknown;
}

class PeopleModule final : public Module {
 public:
  PeopleModule(const ModuleContext& context, const people::PeopleFinderParams& params)
      : bus_{context.bus},

        finder_{params},
        people_{bus_.publisher(topics::kPeople)},
        people_odom_{bus_.publisher(topics::kPeopleInOdom)} {
    bus_.subscribe<docent_msgs::PersonBeams>(topics::kPersonBeams, [this](const auto& beams) { on_beams(beams); });
  }

  [[nodiscard]] ModuleHealth health() const override {
    if (bus_.now() - received_ > kStaleBeams) return {"degraded", "no docent/person_beams"};
    return {};
  }

 private:
  void on_beams(const docent_msgs::PersonBeams& beams) {
    received_ = bus_.now();
    const Pose2 map_from_base = pose_of(beams.map_from_base);
    const Pose2 odom_from_base = pose_of(beams.odom_from_base);
    people::PeopleSweep sweep;
    sweep.odom_from_base = odom_from_base;
    const std::size_t count = std::min({beams.bearings.size(), beams.ranges.size(), beams.origins.size()});
    sweep.sweep.beams.reserve(count);
    sweep.origins.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto range = static_cast<double>(beams.ranges[i]);
      sweep.sweep.beams.push_back({static_cast<double>(beams.bearings[i]), std::abs(range), range < 0.0});
      sweep.origins.push_back(origin_of(beams.origins[i]));
    }
    std::optional<Pose2> map_from_odom;
    if (beams.localized) map_from_odom = map_from_base * inverse(odom_from_base);
    finder_.update(sweep, map_from_odom, from_message(beams.header.stamp));
    publish(people_odom_, beams, "odom", Pose2{}, odom_from_base);
    publish(people_, beams, kMapFrame, map_from_base * inverse(odom_from_base), map_from_base);
  }

  void publish(const transport::Publisher<docent_msgs::People>& publisher, const docent_msgs::PersonBeams& beams,
               std::string_view frame, const Pose2& frame_from_odom, const Pose2& frame_from_base) const {
    docent_msgs::People message;
    message.header = {beams.header.stamp, std::string{frame}};
    message.localized = beams.localized;
    message.frame_from_base = {frame_from_base.x, frame_from_base.y, frame_from_base.theta.radians()};
    message.groups = finder_.groups();
    for (const people::TrackedPerson& person : finder_.people()) {
      const Point2 position = frame_from_odom * person.position;
      const Point2 velocity = frame_from_odom * person.velocity - frame_from_odom.position();
      message.people.push_back({person.id, static_cast<float>(position.x), static_cast<float>(position.y),
                                static_cast<float>(velocity.x), static_cast<float>(velocity.y)});
    }
    if (!beams.localized && frame == kMapFrame) {  // nobody's place in the map is known
      message.people.clear();
      message.groups.clear();
    }
    publisher.publish(std::move(message));
  }

  transport::Bus& bus_;
  people::PeopleFinder finder_;
  transport::Publisher<docent_msgs::People> people_;
  transport::Publisher<docent_msgs::People> people_odom_;
  Time received_{};
};

}  // namespace

Result<std::unique_ptr<Module>> make_people(const ModuleContext& context) {
  auto params = context.config.section<people::PeopleFinderParams>("people");
  if (!params) return tl::unexpected<Error>(params.error());
  return std::make_unique<PeopleModule>(context, *params);
}

Result<robot::ParameterRows> parameters_of_people(const robot::RobotConfig& config) {
  return robot::list_parameters<people::PeopleFinderParams>(config, "people");
}

}  // namespace docent::modules
