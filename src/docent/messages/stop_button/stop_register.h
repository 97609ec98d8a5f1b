#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "docent/base/result.h"
#include "docent/base/time.h"

namespace docent {

/// What is known of the stop button.
struct StopState {
  std::uint64_t number = 0;  ///< of all presses and releases that ever were; it only grows
  bool is_stopped = false;
  std::string by;  ///< the name of whoever pressed or released
  friend bool operator==(const StopState&, const StopState&) = default;
};

/// Whether `a` is what holds, of the two: the one with the greater number, and of equal numbers the stop. So keepers
/// that heard the same states, in any order and any number of times, hold the same.
[[nodiscard]] bool overrules(const StopState& a, const StopState& b);

/// As a line of a file. Error: that is none.
[[nodiscard]] std::string to_line(const StopState& state);
[[nodiscard]] Result<StopState> stop_state_of(std::string_view line);

/// One keeper's copy of the stop button. Several processes keep one each and tell each other, so that what was
/// acknowledged outlives the death of any two of them and a disk that takes nothing. Whoever starts asks first: until
/// a keeper that is sure has answered, or nobody has for a while, it holds the robot. No clock but the keeper's own is
/// used. Not for several threads.
class StopRegister {
 public:
  struct Params {
    double asks_for = 2.0;  ///< [s] after the start; whoever is alive repeats ten times meanwhile
    double repeats = 0.2;   ///< [s] between two words of this keeper, as long as nothing changes
    double forgets = 1.0;   ///< [s] after its last word a keeper counts as dead
    int copies = 3;         ///< an order is confirmed when so many keepers hold it: two may die
  };
  /// What this keeper tells the others.
  struct Word {
    StopState state;
    bool is_sure = false;  ///< it has asked already
  };

  /// @param name  no other keeper's
  /// @param kept  what its file said
  StopRegister(std::string name, const StopState& kept, Time now)
      : StopRegister(std::move(name), kept, now, Params{}) {}
  StopRegister(std::string name, StopState kept, Time now, const Params& params);

  /// What another keeper said. @returns whether that is news
  bool hear(const std::string& keeper, const Word& word, Time now);
  /// The button: always a new number.
  const StopState& press(std::string by);
  /// Of the stop of that number, and of no later one. @returns whether it was that one
  bool release(std::string by, std::uint64_t number);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const StopState& state() const { return state_; }
  [[nodiscard]] bool is_sure(Time now) const;
  /// The robot must not move: it is stopped, or might be.
  [[nodiscard]] bool holds(Time now) const { return state_.is_stopped || !is_sure(now); }
  /// Enough keepers hold that order, or a later one.
  [[nodiscard]] bool is_confirmed(std::uint64_t number, Time now) const;
  /// What is to be told now; nullopt: nothing yet.
  [[nodiscard]] std::optional<Word> say(Time now);

 private:
  struct Other {
    std::uint64_t number = 0;  ///< that it holds
    Time heard{};
  };

  const std::string name_;
  const Params params_;
  const Time begun_;
  StopState state_;
  bool is_answered_ = false;  ///< by a keeper that was sure
  std::map<std::string, Other> others_;
  std::optional<Time> said_;
  Word last_said_;
};

}  // namespace docent
