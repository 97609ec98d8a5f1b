#include "operator_line.h"

#include <cstdio>
#include <random>
#include <thread>

namespace docent {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Json = nlohmann::json;

constexpr auto kAnswered = 8s;  // a stop that is not confirmed is refused after two

std::string new_id() {
  static std::mt19937 random{std::random_device{}()};
  char text[40];
  std::snprintf(text, sizeof text, "01900000-0000-7%03x-8000-%04x%08x", static_cast<unsigned>(random() & 0xfffU),
                static_cast<unsigned>(random() & 0xffffU), static_cast<unsigned>(random()));
  return text;
}

Json parsed(const std::string& text) { return Json::parse(text, nullptr, false); }

}  // namespace

bool OperatorLine::log_in() {
  telepresence::TestClient client{port_};
  const std::string body = Json{{"name", kName}, {"password", kPassword}}.dump();
  client.send("POST /api/v1/login HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: " +
              std::to_string(body.size()) + "\r\nConnection: close\r\n\r\n" + body);
  const auto [head, answer] = client.receive_reply();
  constexpr std::string_view kCookie = "docent_login=";
  const auto at = head.find(kCookie);
  if (!head.starts_with("HTTP/1.1 200") || at == std::string::npos) return false;
  cookie_ = head.substr(at, head.find(';', at) - at);
  return true;
}

bool OperatorLine::open_once() {
  if (cookie_.empty() && !log_in()) return false;
  line_ = std::make_unique<telepresence::TestClient>(port_);
  operation_ = {};
  if (line_->is_connected() && line_->upgrade("Cookie: " + cookie_ + "\r\n", "/operate")) return true;
  const bool is_there = line_->is_connected();
  line_.reset();
  return is_there && log_in() && false;  // perhaps the login is over; on a full disk there is no new one
}

bool OperatorLine::opens(Seconds patience) {
  const auto end = Clock::now() + patience;
  do {
    if (line_) static_cast<void>(hear("", 0ms));
    if (line_ || open_once()) return true;
    std::this_thread::sleep_for(50ms);
  } while (Clock::now() < end);
  return false;
}

std::optional<Json> OperatorLine::hear(const std::string& id, std::chrono::milliseconds patience) {
  while (line_) {
    const auto frame = line_->receive_frame(patience);
    if (frame.opcode == 8 || (frame.opcode < 0 && !line_->is_alive())) line_.reset();
    if (frame.opcode < 0 || !line_) return std::nullopt;
    if (frame.opcode == 9) line_->send_frame(frame.payload, 10);
    const Json message = frame.opcode == 1 ? parsed(frame.payload) : Json{};
    if (!message.is_object()) continue;
    if (message.value("type", "") == "operation") operation_ = message;
    if (!id.empty() && message.value("id", "") == id) return message;
  }
  return std::nullopt;
}

OperatorLine::Answer OperatorLine::ask(Json message) {
  const auto begun = Clock::now();
  const std::string id = new_id();
  message["id"] = id;
  Answer answer;
  for (bool is_said = false; Clock::now() - begun < kAnswered;) {
    if (!opens(1s)) continue;
    if (!is_said) line_->send_frame(message.dump());
    is_said = true;
    const auto heard = hear(id, 20ms);
    if (!line_) is_said = false;  // the gateway died: said again on the next line, with the same id
    if (!heard) continue;
    answer.after_s = Seconds{Clock::now() - begun}.count();
    answer.is_acknowledged = heard->value("type", "") == "ack";
    if (!answer.is_acknowledged) answer.why_not = (*heard)["reason"].value("word", "refused");
    return answer;
  }
  answer.why_not = "no answer";
  answer.after_s = Seconds{Clock::now() - begun}.count();
  return answer;
}

OperatorLine::Answer OperatorLine::press() { return ask({{"type", "stop"}, {"stopped", true}}); }

OperatorLine::Answer OperatorLine::release() {
  const int number = operation().value("stop_number", 0);
  return ask({{"type", "stop"}, {"stopped", false}, {"number", number}});
}

Json OperatorLine::operation() {
  const auto end = Clock::now() + 5s;
  while (Clock::now() < end) {
    if (!opens(1s)) continue;
    static_cast<void>(hear("", 0ms));
    if (!operation_.is_null()) return operation_;
    static_cast<void>(hear("", 50ms));
  }
  return Json::object();
}

std::string OperatorLine::hours() const {
  telepresence::TestClient client{port_};
  if (!client.is_connected() || !client.upgrade("", "/live?thin")) return "";
  for (const auto end = Clock::now() + 3s; Clock::now() < end;) {
    const auto frame = client.receive_frame(500ms);
    const Json message = frame.opcode == 1 ? parsed(frame.payload) : Json{};
    if (message.is_object() && message.value("type", "") == "hours") return message.value("mode", "");
  }
  return "";
}

}  // namespace docent
