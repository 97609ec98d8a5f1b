#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

namespace docent {

/// xoshiro256++ with distributions of our own, so that a seed gives the same draws with every standard library.
/// Satisfies std::uniform_random_bit_generator.
class Rng {
 public:
  using result_type = std::uint64_t;  ///< what a draw gives

  explicit Rng(std::uint64_t seed);  ///< the same seed, the same draws

  [[nodiscard]] static constexpr result_type min() { return 0; }  ///< the least draw
  /// The greatest.
  [[nodiscard]] static constexpr result_type max() { return std::numeric_limits<result_type>::max(); }
  result_type operator()();  ///< the next 64 random bits

  [[nodiscard]] double uniform();                                           ///< [0, 1)
  [[nodiscard]] double uniform(double low, double high);                    ///< [low, high)
  [[nodiscard]] std::int64_t integer(std::int64_t low, std::int64_t high);  ///< low..high, both included
  [[nodiscard]] double normal();  ///< mean 0, variance 1; stateless (no cached second value)
  /// Mean and standard deviation.
  [[nodiscard]] double normal(double mean, double deviation) { return mean + deviation * normal(); }
  [[nodiscard]] double exponential(double mean);                                     ///< > 0, with this mean
  [[nodiscard]] bool chance(double probability) { return uniform() < probability; }  ///< true with this probability

  /// An independent stream with a name: adding a consumer does not change what the others draw.
  [[nodiscard]] Rng stream(std::string_view name) const;

 private:
  std::uint64_t seed_;
  std::uint64_t state_[4];
};

/// FNV-1a, 64 bits: for names of streams and hashes of configurations; not for secrets.
[[nodiscard]] std::uint64_t hash_of(std::string_view bytes, std::uint64_t start = 14695981039346656037ULL);

}  // namespace docent
