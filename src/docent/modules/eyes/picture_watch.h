#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "docent/base/time.h"

namespace docent::modules {

/// Whether a camera works: pictures that do not come, come late or are the same again and again.
class PictureWatch {
 public:
  /// A camera's pictures come at least so often, and are no older when they come.
  static constexpr Duration kSilent = std::chrono::milliseconds{1500};
  static constexpr Duration kLate = std::chrono::milliseconds{500};
  static constexpr Duration kFrozen = std::chrono::milliseconds{1000};  ///< no two pictures of a sensor are the same

  explicit PictureWatch(Time now) : begun_{now} {}

  /// @param taken  by the clock of `now`
  /// @returns whether the picture is worth looking at: no other than the last one is, nor an old one
  bool hear(Time now, Time taken, std::span<const std::uint8_t> bytes);
  /// "" while all is well.
  [[nodiscard]] std::string complaint(Time now) const;

 private:
  Time begun_;
  std::optional<Time> heard_;
  std::optional<std::uint64_t> last_;  ///< hash of the last picture
  Time changed_{};                     ///< when a picture came that was another than the one before
  Duration age_{};                     ///< of the last picture when it came
  bool is_plain_ = false;              ///< nothing is on the last picture
};

}  // namespace docent::modules
