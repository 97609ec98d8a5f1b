#include "docent/interaction/speech/horn.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <system_error>

#include "docent/base/files.h"
#include "docent/base/random.h"

namespace docent::interaction {
namespace {

constexpr std::uint32_t kRate = 22050;                   ///< [Hz]
constexpr std::array<double, 2> kTones{349.23, 440.00};  ///< [Hz] F4 and A4, the major third of a car's horn
constexpr int kHarmonics = 6;                            ///< of each tone, the n-th with amplitude 1/n
constexpr double kBlast = 0.22;                          ///< [s]
constexpr double kGap = 0.10;                            ///< [s] between the two blasts
constexpr double kAttack = 0.012;                        ///< [s] so that no click is heard
constexpr double kRelease = 0.05;                        ///< [s]
constexpr double kLoudest = 0.5;  ///< of full scale: the horn is heard beside speech and startles nobody

/// 0..1 at `t` [s] after a blast begins.
double envelope(double t) {
  if (t < 0.0 || t > kBlast) return 0.0;
  return std::min({1.0, t / kAttack, (kBlast - t) / kRelease});
}

/// Tones and harmonics at time `t` [s], within -1..1.
double tone(double t) {
  double sum = 0.0, most = 0.0;
  for (const double pitch : kTones) {
    for (int n = 1; n <= kHarmonics; ++n) {
      sum += std::sin(2.0 * std::numbers::pi * pitch * n * t) / n;
      most += 1.0 / n;
    }
  }
  return sum / most;
}

std::string little_endian(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xFFU);
  return text;
}

}  // namespace

HornSound horn_sound(double volume) {
  const double loudness = kLoudest * std::round(std::clamp(volume, 0.0, 1.0) * 10.0) / 10.0;
  HornSound horn;
  horn.duration_s = 2.0 * kBlast + kGap;
  std::string samples;
  const auto count = static_cast<int>(horn.duration_s * kRate);
  for (int i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / kRate;
    const double value = loudness * (envelope(t) + envelope(t - kBlast - kGap)) * tone(t);
    samples += little_endian(static_cast<std::uint16_t>(std::lround(32767.0 * value)), 2);
  }
  const auto size = static_cast<std::uint32_t>(samples.size());
  horn.content = "RIFF" + little_endian(36 + size, 4) + "WAVEfmt " + little_endian(16, 4) + little_endian(1, 2) +
                 little_endian(1, 2) + little_endian(kRate, 4) + little_endian(2 * kRate, 4) + little_endian(2, 2) +
                 little_endian(16, 2) + "data" + little_endian(size, 4) + samples;
  char name[32];
  std::snprintf(name, sizeof name, "%016llx.wav", static_cast<unsigned long long>(hash_of(horn.content)));
  horn.file = name;
  return horn;
}

Result<void> write_horn_sound(const HornSound& horn, const std::filesystem::path& folder) {
  std::error_code error;
  if (std::filesystem::exists(folder / horn.file, error)) return {};
  std::filesystem::create_directories(folder, error);
  if (error) return fail(folder.string() + ": " + error.message());
  return write_file_atomically(folder / horn.file, horn.content);
}

}  // namespace docent::interaction
