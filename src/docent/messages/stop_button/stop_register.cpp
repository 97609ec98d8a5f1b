#include "docent/messages/stop_button/stop_register.h"

#include <charconv>
#include <utility>

namespace docent {
namespace {

constexpr std::string_view kStopped = "stopped";
constexpr std::string_view kReleased = "released";

}  // namespace

bool overrules(const StopState& a, const StopState& b) {
  if (a.number != b.number) return a.number > b.number;
  if (a.is_stopped != b.is_stopped) return a.is_stopped;
  return a.by < b.by;
}

std::string to_line(const StopState& state) {
  return std::to_string(state.number) + " " + std::string{state.is_stopped ? kStopped : kReleased} + " " + state.by +
         "\n";
}

Result<StopState> stop_state_of(std::string_view line) {
  StopState state;
  const char* const end = line.data() + line.size();
  const auto [rest, error] = std::from_chars(line.data(), end, state.number);
  if (error != std::errc{} || rest == end || *rest != ' ') return fail("it does not begin with a number");
  line.remove_prefix(static_cast<std::size_t>(rest - line.data()) + 1);
  const std::string_view word = line.substr(0, line.find(' '));
  if (word != kStopped && word != kReleased) return fail("its second word is neither stopped nor released");
  if (word.size() == line.size() || line.back() != '\n') return fail("its end is missing");
  state.is_stopped = word == kStopped;
  line.remove_prefix(word.size() + 1);
  state.by = line.substr(0, line.size() - 1);
  return state;
}

StopRegister::StopRegister(std::string name, StopState kept, Time now, const Params& params)
    : name_{std::move(name)}, params_{params}, begun_{now}, state_{std::move(kept)} {}

bool StopRegister::hear(const std::string& keeper, const Word& word, Time now) {
  if (keeper == name_) return false;
  others_[keeper] = {word.state.number, now};
  is_answered_ = is_answered_ || word.is_sure;
  if (!overrules(word.state, state_)) return false;
  state_ = word.state;
  return true;
}

const StopState& StopRegister::press(std::string by) {
  state_ = {state_.number + 1, true, std::move(by)};
  return state_;
}

bool StopRegister::release(std::string by, std::uint64_t number) {
  if (number != state_.number || !state_.is_stopped) return false;
  state_ = {state_.number + 1, false, std::move(by)};
  return true;
}

bool StopRegister::is_sure(Time now) const { return is_answered_ || now - begun_ >= seconds(params_.asks_for); }

bool StopRegister::is_confirmed(std::uint64_t number, Time now) const {
  int copies = state_.number >= number ? 1 : 0;
  for (const auto& [keeper, other] : others_)
    copies += other.number >= number && now - other.heard <= seconds(params_.forgets) ? 1 : 0;
  return copies >= params_.copies;
}

std::optional<StopRegister::Word> StopRegister::say(Time now) {
  Word word{state_, is_sure(now)};
  const bool is_news = !said_ || word.state != last_said_.state || word.is_sure != last_said_.is_sure;
  if (!is_news && now - *said_ < seconds(params_.repeats)) return std::nullopt;
  said_ = now;
  last_said_ = word;
  return word;
}

}  // namespace docent
