#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace docent::localization {

/// Sixteen xoshiro128+ generators side by side, so that plain loops over them become vectors. Element i of a call comes
/// from generator i modulo 16: every instruction set draws the same numbers.
class NoiseStreams {
 public:
  static constexpr std::size_t kLanes = 16;

  explicit NoiseStreams(std::uint64_t seed);

  /// Mean 0, variance 1: the sum of four uniform draws, which ends at 3.46 deviations. Motion has tails of its own.
  /// @pre out.size() is a multiple of kLanes
  void fill_normal(std::span<float> out);
  /// [0, 1). @pre out.size() is a multiple of kLanes
  void fill_uniform(std::span<float> out);

 private:
  using Word = std::array<std::uint32_t, kLanes>;
  Word next();
  std::array<Word, 4> state_{};
};

}  // namespace docent::localization
