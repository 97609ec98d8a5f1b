#include "docent/simulator/cameras.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"
#include "docent/pictures/jpeg/jpeg.h"

namespace docent::simulator {
namespace {

constexpr double kStep = 0.01;         // [s]
constexpr double kRobotField = 1.2;    // [rad] of the camera on the robot
constexpr double kAheadOfNeck = 0.17;  // [m] of its glass

}  // namespace

Result<void> CameraOptions::validate() const {
  if (!(rate > 0.0 && rate <= 10.0)) return fail("the cameras' rate must be above 0 and at most 10");
  if (width < 16 || width > 1920 || height < 16 || height > 1200)
    return fail("pictures must be 16 to 1920 pixels wide");
  if (quality < 1 || quality > 100) return fail("the pictures' quality must be 1 to 100");
  return {};
}

Cameras::Cameras(transport::Bus& bus, const World& world, const CameraOptions& options, const Rng& rng)
    : options_{options},
      place_{world.scene_camera},
      eyes_{bus, options.eyes, rng},
      robot_{bus.publisher(topics::kCamera)},
      scene_{bus.publisher(topics::kSceneCamera)} {
  change_world(world);
}

Figure Cameras::figure_of(const Person& person, Time now) {
  constexpr double kWalks = 0.15;       // [m/s]
  constexpr double kStepLength = 0.65;  // [m]
  const double speed = norm(person.velocity);
  auto [heading, is_new] = headings_.try_emplace(person.id, Angle::radians(0.7 * person.id));
  if (speed > kWalks) heading->second = Angle::radians(std::atan2(person.velocity.y, person.velocity.x));
  Figure figure{person.id, {person.position.x, person.position.y, heading->second}, person.height};
  figure.walks = speed > kWalks;
  figure.stride = std::numbers::pi * speed / kStepLength * to_seconds(now - Time{}) + person.id;
  return figure;
}

void Cameras::show_people(Time now, std::span<const Person> people) {
  figures_.clear();
  constexpr std::size_t kForget = 4;  // times as many as there are
  if (headings_.size() > kForget * (people.size() + 10)) headings_.clear();
  for (const Person& person : people) add_figure(figures_, figure_of(person, now));
}

Cameras::Pictures Cameras::draw(Time now, const Pose2& world_from_base, double radius, std::span<const Person> people) {
  show_people(now, people);
  const RobotFigure robot{world_from_base, radius, face_.pan, face_.tilt, face_.valence};
  renderer_.set_figures(figures_);
  Lens lens{{}, 0.0, face_.tilt, kRobotField, options_.width, options_.height};
  const Angle gaze = world_from_base.theta + Angle::radians(face_.pan);
  lens.eye = lifted(world_from_base.position() + kAheadOfNeck * unit(gaze), kEyeHeight);
  lens.pan = gaze.radians();
  Pictures seen{renderer_.draw(lens), std::nullopt};
  if (place_) {
    add_robot(figures_, robot);  // which its own camera does not see
    renderer_.set_figures(figures_);
    const MountView& view = mount_.view();
    seen.scene = renderer_.draw({lifted(place_->position, place_->height), view.pan, view.tilt, view.field_of_view,
                                 options_.width, options_.height});
  }
  return seen;
}

void Cameras::step(Time now, std::uint64_t step, const Pose2& world_from_base, double radius,
                   std::span<const Person> people) {
  mount_.step(kStep);
  if (eyes_.is_due(step)) {
    show_people(now, people);
    renderer_.set_figures(figures_);
    eyes_.look(renderer_, now, step, world_from_base);
  }
  eyes_.send(now);
  if (!options_.for_people) return;
  const auto every = static_cast<std::uint64_t>(std::max(1L, std::lround(1.0 / (options_.rate * kStep))));
  if (step % every != 0) return;
  const Pictures seen = draw(now, world_from_base, radius, people);
  publish(robot_, now, "camera", seen.robot);
  if (seen.scene) publish(scene_, now, "scene_camera", *seen.scene);
}

void Cameras::publish(const transport::Publisher<sensor_msgs::CompressedImage>& publisher, Time now, const char* frame,
                      const pictures::Image& image) const {
  publisher.publish({{to_message(now), frame}, "jpeg", pictures::encode_jpeg(image, options_.quality)});
}

}  // namespace docent::simulator
