#pragma once

#include <memory>
#include <optional>
#include <string>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/interaction/sound/microphone.h"

namespace docent::modules {

struct ListeningParams {
  double longest_s = 6.0;    ///< [s] > 0 after the press; what is said later is not heard
  double patience_s = 2.5;   ///< [s] > 0 until somebody begins to speak
  double pause_s = 0.9;      ///< [s] > 0 of silence, that end what is said
  double above_noise = 9.0;  ///< [dB] > 0 that a voice is above the quietest moments
  template <class V>
  void visit(V& v) {
    v("longest_s", longest_s);
    v("patience_s", patience_s);
    v("pause_s", pause_s);
    v("above_noise", above_noise);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Press to talk: from a press of the button until whoever speaks pauses, or for so long at most. At no other time is
/// the microphone open. Deterministic for what it hears.
class Listening {
 public:
  Listening(const ListeningParams& params, std::unique_ptr<interaction::Microphone> microphone)
      : params_{params}, microphone_{std::move(microphone)} {}

  /// Somebody has pressed the button.
  void press(Time now);
  /// Some ten times a second. @returns what was said, once it is over; empty: nothing
  [[nodiscard]] std::optional<interaction::Clip> listen(Time now);
  [[nodiscard]] bool is_open() const { return begun_.has_value(); }
  /// What is wrong with the microphone, since the last press; empty: nothing.
  [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
  [[nodiscard]] std::optional<interaction::Clip> end(bool is_heard);
  void hear(const interaction::Clip& sound, Time now);

  ListeningParams params_;
  std::unique_ptr<interaction::Microphone> microphone_;
  std::optional<Time> begun_;
  interaction::Clip heard_;
  std::size_t measured_ = 0;      ///< samples whose level is known
  double quietest_ = 0.0;         ///< [dB]
  std::optional<Time> spoke_at_;  ///< last
  std::string fault_;
};

}  // namespace docent::modules
