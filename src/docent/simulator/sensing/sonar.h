#pragma once

#include <span>
#include <vector>

#include "docent/base/random.h"
#include "docent/simulator/sensing/laser.h"
#include "docent/simulator/sensing/ray_caster.h"

namespace docent::simulator {

/// The true sonar ring. The robot knows none of this but what a data sheet says: count, place, nominal cone, limits.
/// Strengths are of the received signal; 1 is a plate that faces the sonar at `reach`.
struct SonarParams {
  int count = 24;                           ///< evenly round the body, the first at the front, counter-clockwise
  int together = 3;                         ///< fired at once, evenly round the body; divides `count`
  double ring_radius = 0.25;                ///< [m] from the body's centre
  double field_of_view = 0.26179938779915;  ///< [rad] nominal cone
  double min_range = 0.05;                  ///< [m]
  double max_range = 5.0;                   ///< [m]; no echo reads so
  double quantum = 0.01;                    ///< [m]
  double beam = 0.2;                        ///< [rad] off the axis the strength has fallen to 1 / e
  double lobe = 0.42;                       ///< [rad] beyond that nothing is sent
  double mirror = 0.06;                     ///< [rad] how far off perpendicular a smooth surface still answers
  double edge = 0.25;                       ///< strength of a corner's diffraction, whatever the angle
  double clothes = 0.45;                    ///< strength of a person
  double reach = 2.0;                       ///< [m]
  double strongest = 3.0;                   ///< near echoes do not grow beyond
  double threshold = 0.1;                   ///< strength that the receiver needs
  double flutter = 0.3;                     ///< of the strength's logarithm, from ping to ping
  double noise_near = 0.006;                ///< [m] standard deviation at 0 m
  double noise_far = 0.025;                 ///< [m] at max_range
  double sound_error = 0.006;               ///< largest relative error of the assumed speed of sound
  double cross_talk = 0.03;                 ///< chance that a sonar hears the echo of another one of its group
  double detour = 0.3;                      ///< [m] mean that such an echo travels more
  double lost = 0.01;                       ///< chance that an echo is missed
};

enum class EchoKind {
  none,       ///< reads max_range
  direct,     ///< from what stands in the cone
  bounced,    ///< after one or two mirrors: too long, or the inside of a corner
  cross_talk  ///< another sonar's echo: too short
};

struct Ping {
  int index = 0;
  double range = 0.0;  ///< [m], from the sonar's place on the ring
  EchoKind kind = EchoKind::none;
};

/// Sound is traced as rays: smooth surfaces answer only where they are met nearly perpendicularly and mirror the rest
/// away, rough ones, edges and people answer always. All randomness from a stream of its own.
class SonarRing {
 public:
  SonarRing(const SonarParams& params, Rng rng);

  [[nodiscard]] int groups() const { return params_.count / params_.together; }
  /// Fires the sonars `group`, `group` + groups(), … at once. The span lives until the next call.
  /// @param walls  of sonar_surfaces; O(rays * (cells + people))
  [[nodiscard]] std::span<const Ping> fire(int group, const RayCaster& walls, std::span<const Disc> people,
                                           const Pose2& world_from_base);
  [[nodiscard]] const SonarParams& params() const { return params_; }

 private:
  struct Echo {
    double way = 0.0;  ///< [m] to what answered, along the sound's path
    Point2 source;     ///< [m], world: where the echo comes from
    EchoKind kind = EchoKind::none;
  };
  [[nodiscard]] Pose2 place(int index, const Pose2& world_from_base) const;
  [[nodiscard]] Echo listen(const Pose2& world_from_sonar, const RayCaster& walls);
  void trace(const Pose2& world_from_sonar, double off, double gain, const RayCaster& walls, Echo& nearest) const;
  [[nodiscard]] double measured(double way);

  SonarParams params_;
  Rng rng_;
  double sound_ = 1.0;        ///< measured over true distance
  std::vector<Disc> near_;    ///< people within reach of the ring
  std::vector<Disc> ahead_;   ///< of these, whom the sonar that listens may meet without a bounce
  std::vector<Echo> echoes_;  ///< [together]
  std::vector<Ping> pings_;   ///< [together]
};

}  // namespace docent::simulator
