#include "docent/simulator/sensing/camera/optics/picture_sensor.h"

#include <algorithm>
#include <cmath>

namespace docent::simulator {
namespace {

constexpr int kLevels = 4096;  // of the table of gamma

/// Nearly normal, mean 0, variance 1: the sum of eight bytes, a third of the time of Rng::normal.
float noise(Rng& rng) {
  std::uint64_t bits = rng();
  std::uint64_t sum = 0;
  for (int i = 0; i < 8; ++i, bits >>= 8U) sum += bits & 0xFFU;
  constexpr float kMean = 8.0F * 127.5F;
  constexpr float kDeviation = 209.02F;  // sqrt(8 (256² - 1) / 12)
  return (static_cast<float>(sum) - kMean) / kDeviation;
}

class Developer {
 public:
  explicit Developer(const PictureSensor& sensor) : sensor_{sensor}, levels_(kLevels + 1) {
    for (int i = 0; i <= kLevels; ++i)
      levels_[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(
          std::lround(255.0 * std::pow(static_cast<double>(i) / kLevels, 1.0 / sensor.gamma)));
  }
  /// Light that reaches the sensor along a ray, as a share of what comes along the axis.
  [[nodiscard]] float passed(Vec3 ray) const {
    const float aside = std::sqrt(ray.x * ray.x + ray.y * ray.y);
    const float angle = std::atan2(aside, ray.z) * (4.0F / 3.14159265F);  // 1 at 45 degrees
    return static_cast<float>(sensor_.gain) *
           std::max(0.02F, 1.0F - static_cast<float>(sensor_.vignetting) * angle * angle);
  }
  [[nodiscard]] std::uint8_t level(float light, Rng& rng) const {
    const float clipped = std::clamp(light, 0.0F, 1.0F);
    const auto read = static_cast<float>(sensor_.read_noise), shot = static_cast<float>(sensor_.shot_noise);
    const float noisy = clipped + noise(rng) * std::sqrt(read * read + shot * shot * clipped);
    return levels_[static_cast<std::size_t>(std::lround(std::clamp(noisy, 0.0F, 1.0F) * kLevels))];
  }

 private:
  const PictureSensor& sensor_;
  std::vector<std::uint8_t> levels_;
};

bool is_dark(Vec3 ray) { return dot(ray, ray) == 0.0F; }

}  // namespace

std::vector<std::uint8_t> develop_grey(const RawPicture& raw, const PictureSensor& sensor, Rng& rng) {
  const Developer developer{sensor};
  std::vector<std::uint8_t> grey(raw.light.size());
  for (std::size_t i = 0; i < grey.size(); ++i) {
    const Rgb c = raw.light[i];
    const float luminance = 0.30F * c.red + 0.59F * c.green + 0.11F * c.blue;
    grey[i] = developer.level(is_dark(raw.where[i]) ? 0.0F : developer.passed(raw.where[i]) * luminance, rng);
  }
  return grey;
}

pictures::Image develop(const RawPicture& raw, const PictureSensor& sensor, Rng& rng) {
  const Developer developer{sensor};
  pictures::Image image{raw.width, raw.height, pictures::colors::kBlack};
  const auto bytes = image.writable_bytes();
  const auto cast = static_cast<float>(sensor.colour_cast);
  for (std::size_t i = 0; i < raw.light.size(); ++i) {
    const float passed = is_dark(raw.where[i]) ? 0.0F : developer.passed(raw.where[i]);
    bytes[4 * i] = developer.level((1.0F + cast) * passed * raw.light[i].red, rng);
    bytes[4 * i + 1] = developer.level(passed * raw.light[i].green, rng);
    bytes[4 * i + 2] = developer.level((1.0F - cast) * passed * raw.light[i].blue, rng);
  }
  return image;
}

std::vector<double> stepped_gains(std::size_t pictures, double steps_per_picture, double range, Rng rng) {
  std::vector<double> gains(pictures, 1.0);
  double now = 1.0;
  for (double& gain : gains) {
    if (rng.chance(steps_per_picture)) now = std::exp2(rng.uniform(-range, range));
    gain = now;
  }
  return gains;
}

}  // namespace docent::simulator
