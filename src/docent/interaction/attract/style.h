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

/// 1 friendly, 1/2, 0 even, -1/2, -1 upset: the place in the order of Fig. 15. Those above 0 are the paper's category
/// of the friendly ones, those below 0 the unfriendly.
[[nodiscard]] constexpr double friendliness_of(Style style) {
  return 0.5 * (static_cast<int>(Style::even) - static_cast<int>(style));
}

/// How probably each style was to be drawn, [styles]; the sum is 1.
using StyleChances = std::array<double, kStyles>;

}  // namespace docent::interaction
