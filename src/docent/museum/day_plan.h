#pragma once

#include <optional>
#include <string>

#include "docent/museum/museum.h"

namespace docent::museum {

/// A mode that begins by itself.
struct NextMode {
  std::string mode;       ///< open, web, closed
  int minute_of_day = 0;  ///< at which it begins, 0..1439
  friend bool operator==(const NextMode&, const NextMode&) = default;
};

/// What comes after the mode that the museum's hours say now; nullopt: they say the same all day.
/// @param minute_of_day  0..1439
[[nodiscard]] std::optional<NextMode> next_mode(const Museum& museum, int minute_of_day);

/// A tour that begins by itself.
struct DailyTour {
  std::string tour;       ///< id
  int minute_of_day = 0;  ///< at which it begins, 0..1439
  friend bool operator==(const DailyTour&, const DailyTour&) = default;
};

/// The first daily tour that begins at this minute or within so many after it, while the museum's hours say open;
/// nullopt: none does.
/// @param minute_of_day  0..1439 @param within  [min], less than a day
[[nodiscard]] std::optional<DailyTour> next_daily_tour(const Museum& museum, int minute_of_day, int within);

/// "; did you mean 'open'?" for a misspelt mode or `hours`; "": for any other word.
[[nodiscard]] std::string mode_meant(const std::string& word);

/// "HH:MM".
[[nodiscard]] std::string clock_text(int minute_of_day);

}  // namespace docent::museum
