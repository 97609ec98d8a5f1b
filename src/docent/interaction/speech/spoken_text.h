#pragma once

#include <string>
#include <string_view>

#include "docent/vocabulary/vocabulary.h"

namespace docent::interaction {

/// Markdown as it is read aloud: headings, emphasis, links, images, list marks, code marks and rules removed; every
/// heading, list item and paragraph ends in a full stop; white space and control characters become single blanks.
/// UTF-8 in, UTF-8 out. O(bytes).
[[nodiscard]] std::string spoken_text(std::string_view markdown);

/// What the robot says first at an exhibit: its title and its short text, both Markdown.
[[nodiscard]] std::string introduction(std::string_view title, std::string_view short_text);

/// Letters, digits, signs and blanks as a reader counts them: UTF-8 code points.
[[nodiscard]] std::size_t count_code_points(std::string_view utf8);

/// How a voice speaks in a mood.
struct Voice {
  int words_per_minute = 160;
  int pitch = 50;  ///< 0..99
};
[[nodiscard]] Voice voice_of(Mood mood);

/// How long it takes to say `text` [s], from its length, its sentences and its clauses. Fitted to espeak-ng 1.51 and
/// within 15 % of it for a text of several sentences (renderer_test).
[[nodiscard]] double speech_duration(std::string_view text, std::string_view language, Mood mood);

}  // namespace docent::interaction
