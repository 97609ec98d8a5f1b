#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>

#include "docent/messages/docent_messages.h"
#include "docent/simulator/crowd/person.h"
#include "docent/simulator/eye_drivers.h"
#include "docent/simulator/sensing/camera/figures.h"
#include "docent/simulator/sensing/camera/mount.h"
#include "docent/simulator/sensing/camera/renderer.h"
#include "docent/transport/bus.h"

namespace docent::simulator {

/// The cameras of a simulation.
struct CameraOptions {
  double rate = 2.0;       ///< [Hz] of each, at most 10
  int width = 320;         ///< [pixels]
  int height = 240;        ///< [pixels]
  int quality = 75;        ///< of the JPEG files, 1 to 100
  bool for_people = true;  ///< the pictures that people look at
  EyeOptions eyes{};       ///< and what the robot sees by itself
  [[nodiscard]] Result<void> validate() const;
};

/// The robot's camera, between its eyes, and the one in the hall if the museum has one, and the eyes by which the robot
/// finds its way: draws what they see and publishes it as drivers of real cameras would. They draw from nobody's chance
/// and change nothing in the museum.
class Cameras {
 public:
  /// The bus must outlive this.
  Cameras(transport::Bus& bus, const World& world, const CameraOptions& options, const Rng& rng);

  void change_world(const World& world) { renderer_.set_furnishing(furnish(world)); }
  /// The head turns with it, and its face changes.
  void see_face(const docent_msgs::Expression& expression) { face_ = expression; }
  void turn_mount(const docent_msgs::CameraView& view) { mount_.command({view.pan, view.tilt, view.field_of_view}); }

  void set_fault(const EyeFault& fault, Time now) { eyes_.set_fault(fault, now); }

  /// Every 10 ms. Both pictures for people are of the same moment.
  /// @param step  counts steps
  void step(Time now, std::uint64_t step, const Pose2& world_from_base, double radius, std::span<const Person> people);

  /// What both see at once; the hall's is empty where there is no such camera.
  struct Pictures {
    pictures::Image robot;
    std::optional<pictures::Image> scene;
  };
  [[nodiscard]] Pictures draw(Time now, const Pose2& world_from_base, double radius, std::span<const Person> people);

 private:
  [[nodiscard]] Figure figure_of(const Person& person, Time now);
  void show_people(Time now, std::span<const Person> people);
  void publish(const transport::Publisher<sensor_msgs::CompressedImage>& publisher, Time now, const char* frame,
               const pictures::Image& image) const;

  CameraOptions options_;
  std::optional<CameraPlace> place_;
  Renderer renderer_;
  Mount mount_;
  EyeDrivers eyes_;
  docent_msgs::Expression face_;
  std::map<std::uint32_t, Angle> headings_;  ///< of people, as they walked last
  Mesh figures_;
  transport::Publisher<sensor_msgs::CompressedImage> robot_;
  transport::Publisher<sensor_msgs::CompressedImage> scene_;
};

}  // namespace docent::simulator
