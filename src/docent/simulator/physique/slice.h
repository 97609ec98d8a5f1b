#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "docent/simulator/physique/physique.h"

namespace docent::simulator {

/// Somebody as they stand now. Their physique must outlive it.
struct Posture {
  Point2 at;                ///< [m], world: the middle of what they take up
  Point2 facing{1.0, 0.0};  ///< unit vector
  double swing = 0.0;       ///< [m] by which the left leg is ahead
  const Physique* physique = nullptr;

  /// Where a part of theirs is.
  [[nodiscard]] Disc place(const BodyPart& part) const {
    const double x = part.at.x + part.swing * swing;
    return {{at.x + x * facing.x - part.at.y * facing.y, at.y + x * facing.y + part.at.y * facing.x}, part.radius};
  }
};

/// The part of somebody, below `height` [m], that is nearest to a point: where a body that is so high touches them.
/// O(parts). Whose parts are all higher has none: their whole room counts.
[[nodiscard]] Disc nearest_part(const Posture& posture, Point2 from, double height);
/// How far [m] somebody reaches from their middle in the direction of the unit vector `towards`.
[[nodiscard]] double reach_towards(const Posture& posture, Point2 towards);

/// What of the people round a sensor it can meet.
class Slice {
 public:
  /// What is cut at a height [m] above the floor, of those within `reach` [m] of `from`. O(people + parts).
  void cut(std::span<const Posture> people, double height, Point2 from, double reach);
  /// What sound comes back from, whatever its height.
  void cut_trunks(std::span<const Posture> people, Point2 from, double reach);

  [[nodiscard]] std::span<const Disc> discs() const { return discs_; }
  /// [discs] indices of the people whose they are, rising.
  [[nodiscard]] std::span<const std::uint32_t> persons() const { return persons_; }

 private:
  template <class Takes>
  void gather(std::span<const Posture> people, Point2 from, double reach, const Takes& takes);

  std::vector<Disc> discs_;
  std::vector<std::uint32_t> persons_;
};

}  // namespace docent::simulator
