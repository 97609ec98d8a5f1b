#include "docent/modules/office/listening.h"

#include <algorithm>
#include <span>
#include <utility>

namespace docent::modules {
namespace {

constexpr std::size_t kPart = interaction::kSampleRate / 20;  // samples whose level is looked at: 50 ms
constexpr double kDead = -95.0;                               // [dB] a microphone that works has noise above that
constexpr double kLoudest =
    -35.0;  // [dB] the quietest moment is taken for no louder: who speaks at once is a voice, too

}  // namespace

Result<void> ListeningParams::validate() const {
  if (!(longest_s > 0.0 && longest_s <= 30.0)) return fail("longest_s must be above 0 and at most 30");
  if (!(patience_s > 0.0 && pause_s > 0.0 && above_noise > 0.0))
    return fail("patience_s, pause_s and above_noise must be > 0");
  return {};
}

void Listening::press(Time now) {
  heard_.clear();
  measured_ = 0;
  quietest_ = kLoudest;
  spoke_at_.reset();
  begun_.reset();
  const auto open = microphone_->begin(now);
  fault_ = open ? "" : open.error().message;
  if (open) begun_ = now;
}

std::optional<interaction::Clip> Listening::end(bool is_heard) {
  begun_.reset();
  microphone_->end();
  return is_heard ? std::exchange(heard_, {}) : interaction::Clip{};
}

void Listening::hear(const interaction::Clip& sound, Time now) {
  heard_.insert(heard_.end(), sound.begin(), sound.end());
  for (; measured_ + kPart <= heard_.size(); measured_ += kPart) {
    const double level = interaction::level_db(std::span{heard_}.subspan(measured_, kPart));
    quietest_ = std::min(quietest_, std::max(level, kDead));
    if (level > quietest_ + params_.above_noise) spoke_at_ = now;
  }
}

std::optional<interaction::Clip> Listening::listen(Time now) {
  if (!begun_) return std::nullopt;
  const auto sound = microphone_->read(now);
  if (!sound) {
    fault_ = sound.error().message;
    return end(false);
  }
  hear(*sound, now);
  const double open_s = to_seconds(now - *begun_);
  if (!spoke_at_ && open_s < params_.patience_s) return std::nullopt;
  if (spoke_at_ && now - *spoke_at_ < seconds(params_.pause_s) && open_s < params_.longest_s) return std::nullopt;
  if (heard_.empty()) {
    fault_ = "microphone: nothing comes from it";
  } else if (interaction::level_db(std::span<const float>{heard_}) <= kDead) {
    fault_ = "microphone: not even noise comes from it: is it muted?";
  }
  return end(spoke_at_.has_value());
}

}  // namespace docent::modules
