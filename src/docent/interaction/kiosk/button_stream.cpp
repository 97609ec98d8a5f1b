#include "docent/interaction/kiosk/button_stream.h"

#include <linux/input.h>

#include <algorithm>
#include <cstring>

namespace docent::interaction {

std::vector<int> ButtonStream::take(std::string_view bytes, Time now) {
  rest_ += bytes;
  std::vector<int> pressed;
  std::size_t at = 0;
  for (; rest_.size() - at >= sizeof(input_event); at += sizeof(input_event)) {
    input_event event{};
    std::memcpy(&event, rest_.data() + at, sizeof event);
    if (event.type != EV_KEY) continue;
    const auto number = number_of(event.code);
    if (number && is_press(*number, event.value, now)) pressed.push_back(*number);
  }
  rest_.erase(0, at);
  return pressed;
}

std::optional<int> ButtonStream::number_of(std::uint16_t code) const {
  if (codes_.stop == code) return kStopKey;
  const auto place = std::find(codes_.buttons.begin(), codes_.buttons.end(), code);
  if (place == codes_.buttons.end()) return std::nullopt;
  return static_cast<int>(place - codes_.buttons.begin()) + 1;
}

bool ButtonStream::is_press(int number, std::int32_t value, Time now) {
  constexpr std::int32_t kReleased = 0;
  constexpr std::int32_t kPressed = 1;  // 2: held, and the keyboard repeats it
  if (value != kReleased && value != kPressed) return false;
  const auto at = static_cast<std::size_t>(number);
  const bool bounces = changed_[at] && now - *changed_[at] < debounce_;
  changed_[at] = now;
  return value == kPressed && !bounces;
}

void ButtonStream::reset() {
  rest_.clear();
  changed_ = {};
}

}  // namespace docent::interaction
