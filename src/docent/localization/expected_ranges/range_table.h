#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "docent/base/result.h"
#include "docent/localization/expected_ranges/state_space.h"
#include "docent/sensor_models/proximity_model.h"

namespace docent::localization {

/// The expected range of every place in every direction, one byte each: the first of the two look-ups of [Markov1998]
/// 3.2. One table serves all beams: a beam at bearing b of a robot with heading h looks in direction h + b.
///
/// Places lie in tiles of 64 successive ones, and a tile is an array [directions][64]: what a beam at one heading needs
/// of a tile is one aligned line of a cache, and a whole tile fits into the first cache.
class RangeTable {
 public:
  static constexpr std::size_t kTile = 64;

  /// The expected ranges of one place.
  class Row {
   public:
    Row(const std::uint8_t* data, std::size_t directions) : data_{data}, directions_{directions} {}
    /// @pre direction < 2 * directions: a heading and a bearing need no modulo
    [[nodiscard]] std::uint8_t operator[](std::size_t direction) const {
      return data_[(direction < directions_ ? direction : direction - directions_) * kTile];
    }

   private:
    const std::uint8_t* data_;
    std::size_t directions_;
  };

  struct Building {
    unsigned threads = 1;                  ///< the table does not depend on it
    std::function<void(double)> progress;  ///< told the share that is done, from the calling thread; may be empty
  };

  /// Casts all rays. An occupied cell's surface is taken half a map cell behind its outline, where walls lie on
  /// average. O(places * directions * cells a ray crosses).
  [[nodiscard]] static RangeTable build(const StateSpace& space, const sensor_models::RayCaster& caster,
                                        const sensor_models::ProximityModel& model, const Building& how);
  [[nodiscard]] static RangeTable build(const StateSpace& space, const sensor_models::RayCaster& caster,
                                        const sensor_models::ProximityModel& model) {
    return build(space, caster, model, Building{});
  }
  /// What sensors with a cone of `opening` [rad] expect, who hear the nearest thing in it wherever it lies: the
  /// shortest range of `rays` over the directions of the cone. Ranges are cut into the bins of `model`, those of `rays`
  /// were by `rays_model`. O(places * directions * directions in the cone).
  [[nodiscard]] static RangeTable cones(const RangeTable& rays, const sensor_models::ProximityModel& rays_model,
                                        const StateSpace& space, const sensor_models::ProximityModel& model,
                                        double opening);
  /// Maps PATH into memory when it is whole, was made for `key` and holds what rays cast now say (a few places are
  /// asked); else builds the table there, beside the old one, and renames it. Processes and threads may do so at once.
  /// A file that cannot be written is not an error: the table is then kept in memory.
  [[nodiscard]] static RangeTable load_or_build(const std::filesystem::path& path, const std::string& key,
                                                const StateSpace& space, const sensor_models::RayCaster& caster,
                                                const sensor_models::ProximityModel& model, const Building& how);

  [[nodiscard]] Row row(std::size_t place) const {
    return {data_ + place / kTile * directions_ * kTile + place % kTile, directions_};
  }
  /// [directions][kTile] of the places from index * kTile on; beyond the last place kUnknownRange. Aligned to 64 bytes.
  [[nodiscard]] const std::uint8_t* tile(std::size_t index) const { return data_ + index * directions_ * kTile; }
  [[nodiscard]] std::size_t directions() const { return directions_; }
  /// How often each expected range occurs over all places and directions: a uniform position.
  [[nodiscard]] const std::array<double, sensor_models::kExpectedRanges>& frequency() const { return frequency_; }

 private:
  RangeTable() = default;
  [[nodiscard]] static Result<RangeTable> load(const std::filesystem::path& path, const std::string& key,
                                               const StateSpace& space);
  void count(std::size_t places);

  std::shared_ptr<const void> owner_;  ///< the memory or the mapping that data_ points into
  const std::uint8_t* data_ = nullptr;
  std::size_t directions_ = 0;
  std::array<double, sensor_models::kExpectedRanges> frequency_{};
};

}  // namespace docent::localization
