#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "docent/base/random.h"
#include "docent/simulator/physique/disc.h"

namespace docent::simulator {

/// What people are made of: legs, bodies and what they have with them, or one disc each from the floor to the head.
enum class Bodies { legs, discs };
/// "legs" or "discs"; nullopt for another word.
[[nodiscard]] std::optional<Bodies> bodies_of(std::string_view word);

/// What somebody has with them.
enum class Aid { none, bag, rucksack, cane, pram, wheelchair };

/// Shares of grown-ups; children carry nothing. Guesses of what a museum sees, not measurements.
struct PhysiqueParams {
  Bodies bodies = Bodies::legs;
  double bag_share = 0.20;         ///< in the hand or at the hip
  double rucksack_share = 0.10;    ///< on the back
  double cane_share = 0.03;        ///< thinner than a laser's beams lie apart from 1.5 m on
  double pram_share = 0.02;        ///< pushed ahead
  double wheelchair_share = 0.01;  ///< sits in one
};

/// A piece of somebody, upright and round.
struct BodyPart {
  Point2 at;              ///< [m] from the middle of what they take up, facing +x
  double radius = 0.25;   ///< [m]
  double bottom = 0.0;    ///< [m] above the floor
  double top = 2.0;       ///< [m]
  double swing = 0.0;     ///< how far it goes with the left leg: 1 wholly, -1 with the right one, 0 stays with the body
  bool is_trunk = false;  ///< large and soft: what sound comes back from
};

/// How somebody is built. Their parts move with them and, by their swing, with their legs.
struct Physique {
  std::vector<BodyPart> parts;
  double stance = 0.3;     ///< [m] between the feet of who walks, along the way
  double turn_rate = 4.0;  ///< [rad/s] with which they turn at most
  double reach = 0.25;     ///< [m] from their middle to the end of the farthest part, however they stand
  Aid aid = Aid::none;
};

/// One disc from the floor to above the robot's head.
[[nodiscard]] Physique one_disc(double radius);

/// What is known of somebody before they are drawn.
struct Stature {
  bool is_child = false;
  double height = 1.7;   ///< [m]
  double radius = 0.25;  ///< [m] half the breadth at the shoulders
};

/// Draws somebody. A laser at the legs' height sees of a grown-up who stands what ends about 12 cm before their body,
/// ahead and to the sides. @param params  with bodies `discs` nothing is drawn
[[nodiscard]] Physique draw_physique(const PhysiqueParams& params, const Stature& stature, Rng& rng);

/// [m] that others keep to the middle of somebody who has this with them: who pushes a pram, or sits, takes more room.
[[nodiscard]] double room_of(const Physique& physique, double radius);

/// How somebody holds themselves while they walk: where they face, and where their legs are. The leg that carries stays
/// where it is on the floor while the body passes over it, for a stance; the other one swings forward meanwhile.
class Gait {
 public:
  explicit Gait(Point2 facing = {1.0, 0.0}) : facing_{facing} {}
  /// They have moved for `dt` [s] with `velocity` [m/s]. Who stands draws their legs together and faces on as before.
  void walk(Point2 velocity, double dt, const Physique& physique);

  [[nodiscard]] Point2 facing() const { return facing_; }  ///< unit vector
  [[nodiscard]] double swing() const { return swing_; }    ///< [m] by which the left leg is ahead of the body

 private:
  Point2 facing_;
  double phase_ = 0.0;   ///< of two steps, 0..1
  double spread_ = 0.0;  ///< [m] half the stance now
  double swing_ = 0.0;
};

}  // namespace docent::simulator
