#include "docent/interaction/speech/spoken_text.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

// Texts come from museum folders: whatever they hold, what is spoken has no control characters and no marks at its
// ends, and speaking it again gives the same.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view markdown{reinterpret_cast<const char*>(data), size};
  const std::string text = docent::interaction::spoken_text(markdown);
  if (text.size() > 2 * size + 1) std::abort();
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') std::abort();
  }
  if (!text.empty() && (text.front() == ' ' || text.back() == ' ')) std::abort();
  if (!(docent::interaction::speech_duration(text, "de", docent::Mood::happy) >= 0.0)) std::abort();
  return 0;
}
