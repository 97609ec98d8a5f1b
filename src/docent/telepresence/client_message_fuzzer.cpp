#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "docent/telepresence/client_message.h"

// Whatever a browser sends, the parser neither fails nor lets through what later parts may not see.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text{reinterpret_cast<const char*>(data), size};
  const auto message = docent::telepresence::parse_client_message(text);
  if (!message) {
    if (message.error().message.empty() || message.error().message.size() > 120) std::abort();
    return 0;
  }
  if (const auto* request = std::get_if<docent::telepresence::RequestMessage>(&*message)) {
    if (!docent::telepresence::is_uuid7(request->id) || !docent::telepresence::is_identifier(request->target))
      std::abort();
    if (request->viewpoint < -1 || request->name.size() > 160) std::abort();
    for (const char c : request->name) {
      if (static_cast<unsigned char>(c) < 0x20) std::abort();
    }
  }
  if (const auto* choice = std::get_if<docent::telepresence::ChoiceMessage>(&*message)) {
    if (choice->prompt.empty() || choice->prompt.size() > 64) std::abort();
  }
  if (const auto* lamps = std::get_if<docent::telepresence::LampsMessage>(&*message)) {
    if (lamps->lit.size() > 4) std::abort();
    for (const int number : lamps->lit) {
      if (number < 1 || number > 4) std::abort();
    }
  }
  if (const auto* answer = std::get_if<docent::telepresence::AnswerMessage>(&*message)) {
    if (!docent::answers(answer->answer, answer->question)) std::abort();
  }
  return 0;
}
