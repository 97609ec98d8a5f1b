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
    const auto* const code = std::find(codes_.begin(), codes_.end(), event.code);
    if (code == codes_.end()) continue;
    const auto button = static_cast<std::size_t>(code - codes_.begin());
    if (is_press(button, event.value, now)) pressed.push_back(static_cast<int>(button) + 1);
  }
  rest_.erase(0, at);
  return pressed;
}

bool ButtonStream::is_press(std::size_t button, std::int32_t value, Time now) {
  constexpr std::int32_t kReleased = 0;
  constexpr std::int32_t kPressed = 1;  // 2: held, and the keyboard repeats it
  if (value != kReleased && value != kPressed) return false;
  const bool bounces = changed_[button] && now - *changed_[button] < debounce_;
  changed_[button] = now;
  return value == kPressed && !bounces;
}

void ButtonStream::reset() {
  rest_.clear();
  changed_ = {};
}

}  // namespace docent::interaction
