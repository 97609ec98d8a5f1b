#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "docent/base/time.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::interaction {

/// The codes of evdev's keys.
struct ButtonCodes {
  std::array<std::uint16_t, kButtons> buttons{};  ///< 1 to 4
  std::optional<std::uint16_t> stop;              ///< stops the robot
};

/// As the number of a press: the key that stops the robot.
inline constexpr int kStopKey = 0;

/// Presses in the bytes of an evdev device, which are `struct input_event` one after the other; in whatever pieces they
/// come, and whatever else they hold. Knows neither files nor a clock.
class ButtonStream {
 public:
  /// @param debounce  a contact that closes so soon after its last change bounces
  ButtonStream(const ButtonCodes& codes, Duration debounce) : codes_{codes}, debounce_{debounce} {}

  /// The buttons that were pressed, in their order: numbers of 1 to 4, or kStopKey. O(size of `bytes`).
  [[nodiscard]] std::vector<int> take(std::string_view bytes, Time now);
  /// The device is another one, or begins anew: what came of an event is forgotten.
  void reset();

 private:
  [[nodiscard]] std::optional<int> number_of(std::uint16_t code) const;
  [[nodiscard]] bool is_press(int number, std::int32_t value, Time now);

  ButtonCodes codes_;
  Duration debounce_;
  std::string rest_;                                       ///< the beginning of an event whose end has not come
  std::array<std::optional<Time>, kButtons + 1> changed_;  ///< by number
};

}  // namespace docent::interaction
