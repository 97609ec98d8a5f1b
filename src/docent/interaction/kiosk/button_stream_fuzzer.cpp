#include "docent/interaction/kiosk/button_stream.h"

#include <linux/input.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

// Whatever a device sends, only the stop key and buttons 1 to 4 are pressed, and in pieces it says the same as at once.
// The first byte says how large the pieces are.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::size_t step = 1U + data[0];
  const std::string_view bytes{reinterpret_cast<const char*>(data + 1), size - 1};
  constexpr docent::interaction::ButtonCodes kCodes{{KEY_1, KEY_2, KEY_3, KEY_4}, KEY_ESC};
  docent::interaction::ButtonStream whole{kCodes, docent::seconds(0.05)};
  const auto expected = whole.take(bytes, docent::Time{});
  docent::interaction::ButtonStream pieces{kCodes, docent::seconds(0.05)};
  std::vector<int> pressed;
  for (std::size_t at = 0; at < bytes.size(); at += step)
    for (const int number : pieces.take(bytes.substr(at, step), docent::Time{})) pressed.push_back(number);
  if (pressed != expected) std::abort();
  for (const int number : pressed) {
    if (number < docent::interaction::kStopKey || number > docent::kButtons) std::abort();
  }
  return 0;
}
