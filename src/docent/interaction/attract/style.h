#pragma once

#include <array>
#include <compare>

#include "docent/vocabulary/vocabulary.h"

namespace docent::interaction {

/// What the robot does in one attraction phase: how the head moves, which face it makes, what it says ([Minerva2000]
/// 6.3).
struct AttractionAction {
  GazeStrategy gaze = GazeStrategy::ahead;
  Mood face = Mood::neutral;
  SpeechAct speech = SpeechAct::silence;
  friend auto operator<=>(const AttractionAction&, const AttractionAction&) = default;
};

inline constexpr int kAttractionActions = 60;  ///< three gazes x four faces x five speech acts

/// @pre 0 <= index < kAttractionActions
[[nodiscard]] AttractionAction attraction_action(int index);
/// 0 .. kAttractionActions - 1; the inverse of attraction_action.
[[nodiscard]] int index_of(const AttractionAction& action);
/// In how many of gaze, face and speech the two differ, 0..3.
[[nodiscard]] int differences(const AttractionAction& a, const AttractionAction& b);

/// How friendly an action is, by face and words alone, as [Minerva2000] Fig. 15 orders them.
enum class Style { friendly, fairly_friendly, even, fairly_upset, upset };
constexpr auto words_of(Style) { return std::array{"friendly", "fairly friendly", "even", "fairly upset", "upset"}; }
inline constexpr int kStyles = 5;

/// A happy face, an invitation and a question are friendly; a sad or angry face, a demand and a complaint are upset.
/// Face and words together make the style: a happy face that complains is even.
[[nodiscard]] Style style_of(const AttractionAction& action);

/// The two categories of [Minerva2000] 6.3: +1 friendly, fairly or not; -1 upset, fairly or not; 0 even.
[[nodiscard]] constexpr int category_of(Style style) { return style < Style::even ? 1 : style > Style::even ? -1 : 0; }

/// How probably each style was to be drawn, [styles]; the sum is 1.
using StyleChances = std::array<double, kStyles>;

}  // namespace docent::interaction
