#include "docent/telepresence/client_message.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

namespace docent::telepresence {
namespace {

using Json = nlohmann::json;

bool is_hex(char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); }

std::string text_of(const Json& object, const char* key) {
  const auto place = object.find(key);
  return place != object.end() && place->is_string() ? place->get<std::string>() : std::string{};
}

/// The code point at `at`, which moves behind it. Invalid bytes count as U+FFFD.
std::uint32_t next_code_point(std::string_view text, std::size_t& at) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t first = byte(at);
  const std::size_t length = first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  if (length > text.size() - at || (first >= 0x80 && first < 0xC2)) {
    ++at;
    return 0xFFFD;
  }
  std::uint32_t value = length == 1 ? first : first & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) value = (value << 6U) | (byte(at + i) & 0x3FU);
  at += length;
  return value;
}

bool is_printed(std::uint32_t c) {
  if (c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0xAD || c == 0xFFFD || c == 0xFEFF) return false;
  if (c >= 0x200B && c <= 0x200F) return false;                                    // zero width, marks of direction
  if ((c >= 0x2028 && c <= 0x202E) || (c >= 0x2060 && c <= 0x206F)) return false;  // lines, overrides, isolates
  return c < 0xE0000;                                                              // tags, private planes
}

bool is_language(std::string_view text) {
  return text.size() == 2 && std::all_of(text.begin(), text.end(), [](char c) { return c >= 'a' && c <= 'z'; });
}

/// "x,y" [m], map
bool is_point(const std::string& text) {
  double x = 0.0;
  double y = 0.0;
  int used = 0;
  constexpr std::size_t kMost = 24;
  constexpr double kFarthest = 10'000.0;  // [m]
  if (text.size() > kMost || text.find_first_not_of("0123456789.,-") != std::string::npos) return false;
  return std::sscanf(text.c_str(), "%lf,%lf%n", &x, &y, &used) == 2 && static_cast<std::size_t>(used) == text.size() &&
         std::abs(x) < kFarthest && std::abs(y) < kFarthest;
}

Result<ClientMessage> parse_request(const Json& object, std::string id) {
  RequestMessage message;
  message.id = std::move(id);
  const auto kind = parse<RequestKind>(text_of(object, "kind"));
  if (!kind || kind == RequestKind::cancel || kind == RequestKind::skip)
    return fail("request: kind must be exhibit, tour, point or room");
  message.kind = *kind;
  message.target = text_of(object, "target");
  if (kind == RequestKind::point) {
    if (!is_point(message.target)) return fail("request: target is no point x,y");
  } else if (!is_identifier(message.target)) {
    return fail("request: target is not an id");
  }
  if (const auto place = object.find("viewpoint"); place != object.end() && !place->is_null()) {
    if (!place->is_number_integer()) return fail("request: viewpoint must be a whole number");
    const bool is_huge = place->is_number_unsigned() && place->get<std::uint64_t>() > 255;
    const auto value = place->get<std::int64_t>();
    if (is_huge || value < -1 || value > 255) return fail("request: no such viewpoint");
    message.viewpoint = static_cast<int>(value);
  }
  message.name = clean_name(text_of(object, "name"));
  message.language = text_of(object, "language");
  if (!message.language.empty() && !is_language(message.language)) return fail("request: language must be two letters");
  return message;
}

Result<ClientMessage> parse_lamps(const Json& object) {
  LampsMessage message;
  const auto lit = object.find("lit");
  if (lit == object.end() || !lit->is_array() || lit->size() > static_cast<std::size_t>(kButtons))
    return fail("lamps: lit must be a list of buttons");
  for (const Json& number : *lit) {
    const int least = message.lit.empty() ? 1 : message.lit.back() + 1;
    if (!number.is_number_unsigned() || number < least || number > kButtons)
      return fail("lamps: lit must hold rising numbers of 1 to 4");
    message.lit.push_back(number.get<int>());
  }
  return message;
}

Result<ClientMessage> parse_answer(const Json& object, std::string id) {
  const auto question = parse<PollQuestion>(text_of(object, "question"));
  const auto answer = parse<PollAnswer>(text_of(object, "answer"));
  if (!question) return fail("answer: no such question");
  if (!answer || !answers(*answer, *question)) return fail("answer: none that fits the question");
  AnswerMessage message{std::move(id), *question, *answer, text_of(object, "language")};
  if (!is_language(message.language)) return fail("answer: language must be two letters");
  return message;
}

bool is_set(const Json& object, const char* key) {
  const auto place = object.find(key);
  return place != object.end() && place->is_boolean() && place->get<bool>();
}

Result<ClientMessage> parse_steer(const Json& object) {
  SteerMessage message;
  message.pressed = is_set(object, "pressed");
  for (const auto& [key, share] : {std::pair{"forward", &message.forward}, std::pair{"turn", &message.turn}}) {
    const auto place = object.find(key);
    if (place == object.end() || !place->is_number() || !(std::abs(place->get<double>()) <= 1.0))
      return fail(std::string{"steer: "} + key + " must be a number from -1 to 1");
    *share = place->get<double>();
  }
  return message;
}

/// Those of operators that have an id.
Result<ClientMessage> parse_order(const Json& object, const std::string& type, std::string id) {
  const auto need = [&](const char* key) { return object.contains(key) && object[key].is_boolean(); };
  if (type == "lease") {
    if (!need("wants")) return fail("lease: wants must be true or false");
    return LeaseMessage{std::move(id), is_set(object, "wants")};
  }
  if (type == "stop") {
    if (!need("stopped")) return fail("stop: stopped must be true or false");
    StopMessage message{std::move(id), is_set(object, "stopped")};
    const auto number = object.find("number");
    if (message.stopped) return message;
    if (number == object.end() || !number->is_number_unsigned() || *number > std::numeric_limits<int>::max())
      return fail("stop: a release needs the number of its stop");
    message.number = number->get<int>();
    return message;
  }
  const auto mode = parse<OperatingMode>(text_of(object, "mode"));
  if (!mode) return fail("set_hours: no such mode");
  return SetHoursMessage{std::move(id), *mode};
}

}  // namespace

bool is_uuid7(std::string_view text) {
  if (text.size() != 36) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_dash = i == 8 || i == 13 || i == 18 || i == 23;
    if (is_dash ? text[i] != '-' : !is_hex(text[i])) return false;
  }
  return text[14] == '7' && (text[19] == '8' || text[19] == '9' || text[19] == 'a' || text[19] == 'b');
}

bool is_identifier(std::string_view text) {
  if (text.empty() || text.size() > 64) return false;
  return std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
  });
}

bool is_prompt_id(std::string_view text) {
  if (text.size() > 64) return false;
  for (std::size_t slash = 0; (slash = text.find('/')) != std::string_view::npos; text.remove_prefix(slash + 1))
    if (!is_identifier(text.substr(0, slash))) return false;
  return is_identifier(text);
}

std::string clean_name(std::string_view text, std::size_t limit) {
  std::string clean;
  std::size_t count = 0;
  bool is_blank_due = false;
  for (std::size_t at = 0; at < text.size() && count < limit;) {
    const std::size_t begin = at;
    const std::uint32_t c = next_code_point(text, at);
    if (c == ' ' || c == '\t' || c == '\n' || c == 0xA0 || c == 0x3000) {
      is_blank_due = !clean.empty();
      continue;
    }
    if (!is_printed(c)) continue;
    if (is_blank_due && ++count < limit) clean += ' ';
    if (count >= limit) break;
    is_blank_due = false;
    clean += text.substr(begin, at - begin);
    ++count;
  }
  return clean;
}

std::string clean_text(std::string_view text, std::size_t limit) {
  std::string clean;
  int breaks = 0;
  for (std::size_t left = limit; !text.empty() && left > 0;) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const auto used = static_cast<std::size_t>(
        std::count_if(clean.begin(), clean.end(), [](char c) { return (static_cast<unsigned>(c) & 0xC0U) != 0x80U; }));
    left = limit - std::min(limit, used + static_cast<std::size_t>(std::min(breaks, 2)));
    const std::string line = clean_name(text.substr(0, end), left);
    if (!line.empty()) {
      if (!clean.empty()) clean.append(static_cast<std::size_t>(std::min(breaks, 2)), '\n');
      clean += line;
      breaks = 0;
    }
    ++breaks;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return clean;
}

Result<ClientMessage> parse_client_message(std::string_view text) {
  const Json object = Json::parse(text.begin(), text.end(), nullptr, false);
  if (object.is_discarded()) return fail("not JSON");
  if (!object.is_object()) return fail("not a JSON object");
  const std::string type = text_of(object, "type");
  if (type == "watch") return WatchMessage{is_set(object, "details"), is_set(object, "thin")};
  if (type == "steer") return parse_steer(object);
  if (type == "lamps") return parse_lamps(object);
  constexpr std::array kWithId{"request", "cancel", "choice", "vote", "help",
                               "skip",    "answer", "lease",  "stop", "set_hours"};
  if (std::find(kWithId.begin(), kWithId.end(), type) == kWithId.end()) return fail("unknown type of message");
  std::string id = text_of(object, "id");
  if (!is_uuid7(id)) return fail(type + ": id must be a UUID of version 7");
  if (type == "request") return parse_request(object, std::move(id));
  if (type == "answer") return parse_answer(object, std::move(id));
  if (type == "lease" || type == "stop" || type == "set_hours") return parse_order(object, type, std::move(id));
  if (type == "help") {
    HelpMessage message{std::move(id), text_of(object, "language")};
    if (!is_language(message.language)) return fail("help: language must be two letters");
    return message;
  }
  if (type == "skip") {
    SkipMessage message{std::move(id), text_of(object, "exhibit")};
    if (!is_identifier(message.exhibit)) return fail("skip: exhibit is not an id");
    return message;
  }
  if (type == "vote") {
    VoteMessage message{std::move(id), text_of(object, "voter"), text_of(object, "tour")};
    if (!is_uuid7(message.voter)) return fail("vote: voter must be a UUID of version 7");
    if (!is_identifier(message.tour)) return fail("vote: tour is not an id");
    return message;
  }
  if (type == "cancel") {
    CancelMessage message{std::move(id), text_of(object, "request")};
    if (!is_uuid7(message.request)) return fail("cancel: request must be a UUID of version 7");
    return message;
  }
  ChoiceMessage message{std::move(id), text_of(object, "prompt"), text_of(object, "choice")};
  if (!is_prompt_id(message.prompt)) return fail("choice: prompt is not an id");
  if (!is_identifier(message.choice)) return fail("choice: choice is not an id");
  return message;
}

}  // namespace docent::telepresence
