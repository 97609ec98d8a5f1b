#include "docent/vocabulary/uuid.h"

#include <cstdint>

namespace docent {

std::string make_uuid_v7(Time time, Rng& rng) {
  const auto milliseconds = static_cast<std::uint64_t>(time.nanoseconds / 1000000) & 0xFFFFFFFFFFFFULL;
  const std::uint64_t high = (milliseconds << 16U) | 0x7000ULL | (rng() >> 52U);
  const std::uint64_t low = (rng() >> 2U) | 0x8000000000000000ULL;
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text;
  for (int i = 0; i < 32; ++i) {
    if (i == 8 || i == 12 || i == 16 || i == 20) text += '-';
    const std::uint64_t word = i < 16 ? high : low;
    text += kDigits[(word >> static_cast<unsigned>(60 - 4 * (i % 16))) & 0xFU];
  }
  return text;
}

}  // namespace docent
