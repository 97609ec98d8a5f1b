#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "docent/base/result.h"
#include "docent/localization/markov/state_space.h"
#include "docent/sensor_models/proximity_model.h"

namespace docent {

/// The expected range of every place in every direction, one byte each: the first of the two look-ups of [Markov1998]
/// 3.2. One table serves all beams: a beam at bearing b of a robot with heading h looks in direction h + b.
///
/// A row holds the directions twice, and a little more, so that `row[h + b]` needs no modulo and vectors may read on.
class RangeTable {
 public:
  static constexpr std::size_t kReadAhead = 64;

  /// Casts all rays. An occupied cell's surface is taken half a map cell behind its outline, where walls lie on
  /// average. O(places * directions * cells a ray crosses).
  [[nodiscard]] static RangeTable build(const StateSpace& space, const RayCaster& caster, const ProximityModel& model);
  /// Maps PATH into memory when it is whole and was made for `key`; else builds the table and writes it there
  /// atomically. A file that cannot be written is not an error: the table is then kept in memory.
  [[nodiscard]] static RangeTable load_or_build(const std::filesystem::path& path, const std::string& key,
                                                const StateSpace& space, const RayCaster& caster,
                                                const ProximityModel& model);

  [[nodiscard]] const std::uint8_t* row(std::size_t place) const { return data_ + place * stride_; }
  [[nodiscard]] std::size_t stride() const { return stride_; }
  /// How often each expected range occurs over all places and directions: a uniform position.
  [[nodiscard]] const std::array<double, kExpectedRanges>& frequency() const { return frequency_; }

 private:
  RangeTable() = default;
  [[nodiscard]] static Result<RangeTable> load(const std::filesystem::path& path, const std::string& key,
                                               const StateSpace& space);
  void count(std::size_t places, int headings);

  std::shared_ptr<const void> owner_;  ///< the memory or the mapping that data_ points into
  const std::uint8_t* data_ = nullptr;
  std::size_t stride_ = 0;
  std::array<double, kExpectedRanges> frequency_{};
};

}  // namespace docent
