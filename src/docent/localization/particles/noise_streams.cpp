#include "docent/localization/particles/noise_streams.h"

#include "docent/base/random.h"

namespace docent::localization {

NoiseStreams::NoiseStreams(std::uint64_t seed) {
  Rng rng{seed};
  for (Word& word : state_)
    for (std::uint32_t& lane : word) lane = static_cast<std::uint32_t>(rng() >> 32U);
  for (std::uint32_t& lane : state_[0]) lane |= 1U;  // a state of zeros would stay there
}

NoiseStreams::Word NoiseStreams::next() {
  Word result;
  auto& [a, b, c, d] = state_;
  for (std::size_t i = 0; i < kLanes; ++i) {
    result[i] = a[i] + d[i];
    const std::uint32_t shifted = b[i] << 9U;
    c[i] ^= a[i];
    d[i] ^= b[i];
    b[i] ^= c[i];
    a[i] ^= d[i];
    c[i] ^= shifted;
    d[i] = (d[i] << 11U) | (d[i] >> 21U);
  }
  return result;
}

void NoiseStreams::fill_normal(std::span<float> out) {
  constexpr std::int32_t kMean = 2 * 65535;
  constexpr float kScale = 1.7320508F / 65536.0F;  // four uniforms of width w have the variance w^2 / 3
  for (std::size_t first = 0; first < out.size(); first += kLanes) {
    const Word u = next();
    const Word v = next();
    for (std::size_t i = 0; i < kLanes; ++i) {
      const std::uint32_t sum = (u[i] & 0xFFFFU) + (u[i] >> 16U) + (v[i] & 0xFFFFU) + (v[i] >> 16U);
      out[first + i] = static_cast<float>(static_cast<std::int32_t>(sum) - kMean) * kScale;
    }
  }
}

void NoiseStreams::fill_uniform(std::span<float> out) {
  for (std::size_t first = 0; first < out.size(); first += kLanes) {
    const Word u = next();
    for (std::size_t i = 0; i < kLanes; ++i)
      out[first + i] = static_cast<float>(static_cast<std::int32_t>(u[i] >> 8U)) * 0x1.0p-24F;
  }
}

}  // namespace docent::localization
