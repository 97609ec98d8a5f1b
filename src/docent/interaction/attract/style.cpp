#include "docent/interaction/attract/style.h"

namespace docent::interaction {
namespace {

constexpr int kFaces = static_cast<int>(words_of(Mood{}).size());
constexpr int kSpeechActs = static_cast<int>(words_of(SpeechAct{}).size());
static_assert(static_cast<int>(words_of(GazeStrategy{}).size()) * kFaces * kSpeechActs == kAttractionActions);

int tone_of(Mood face) {
  if (face == Mood::happy) return 1;
  return face == Mood::neutral ? 0 : -1;
}
int tone_of(SpeechAct speech) {
  if (speech == SpeechAct::invite || speech == SpeechAct::ask) return 1;
  return speech == SpeechAct::silence ? 0 : -1;
}

}  // namespace

AttractionAction attraction_action(int index) {
  return {static_cast<GazeStrategy>(index / (kFaces * kSpeechActs)), static_cast<Mood>(index / kSpeechActs % kFaces),
          static_cast<SpeechAct>(index % kSpeechActs)};
}

int index_of(const AttractionAction& action) {
  return (static_cast<int>(action.gaze) * kFaces + static_cast<int>(action.face)) * kSpeechActs +
         static_cast<int>(action.speech);
}

int differences(const AttractionAction& a, const AttractionAction& b) {
  return static_cast<int>(a.gaze != b.gaze) + static_cast<int>(a.face != b.face) +
         static_cast<int>(a.speech != b.speech);
}

Style style_of(const AttractionAction& action) {
  return static_cast<Style>(static_cast<int>(Style::even) - tone_of(action.face) - tone_of(action.speech));
}

}  // namespace docent::interaction
