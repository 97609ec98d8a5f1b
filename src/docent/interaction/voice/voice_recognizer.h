#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/interaction/sound/clip.h"
#include "docent/interaction/voice/voice_grammar.h"

namespace docent::interaction {

struct VoiceParams {
  std::string model = "/usr/share/pocketsphinx/model/en-us";  ///< folder of Debian's pocketsphinx-en-us
  double acts_above = -3.5;     ///< of the confidence: surely meant; fewer than one in a hundred is another command
  double asks_above = -6.0;     ///< likewise: it asks back; less was no command
  double grammar_weight = 3.0;  ///< of the grammar against the sound; 1 hears short commands in long ones
  double longest_s = 30.0;      ///< [s] of an utterance; what is longer is no command
  double shortest_s = 0.3;      ///< [s] likewise
  template <class V>
  void visit(V& v) {
    v("model", model);
    v("acts_above", acts_above);
    v("asks_above", asks_above);
    v("grammar_weight", grammar_weight);
    v("longest_s", longest_s);
    v("shortest_s", shortest_s);
  }
};

/// One utterance, as it was heard.
struct HeardVoice {
  enum class Verdict { nothing, perhaps, understood };
  Verdict verdict = Verdict::nothing;     ///< perhaps: ask back before anything is done
  std::optional<VoiceCommand> command{};  ///< the likeliest one
  std::string words;                      ///< of it, with blanks between them
  /// How much worse the command explains the sound than any phonemes at all would, a frame of 10 ms, in units of the
  /// recognizer's logarithm; above 0: better.
  double confidence = 0.0;
};
[[nodiscard]] const char* to_text(HeardVoice::Verdict verdict);

/// Hears commands by PocketSphinx: the best path through the grammar beside the best one through any phonemes, so that
/// what is no command is not taken for one. Deterministic. About a tenth of the time that the utterance lasted.
class VoiceRecognizer {
 public:
  /// Error: the model is not installed, or a name has no pronunciation.
  [[nodiscard]] static Result<VoiceRecognizer> create(VoiceGrammar grammar, const VoiceParams& params = {});
  VoiceRecognizer(VoiceRecognizer&&) noexcept;
  VoiceRecognizer& operator=(VoiceRecognizer&&) noexcept;
  ~VoiceRecognizer();

  [[nodiscard]] Result<HeardVoice> hear(const Clip& utterance);
  [[nodiscard]] const VoiceGrammar& grammar() const { return grammar_; }

 private:
  struct Decoder;
  VoiceRecognizer(VoiceGrammar grammar, const VoiceParams& params, std::unique_ptr<Decoder> decoder);

  VoiceGrammar grammar_;
  VoiceParams params_;
  std::unique_ptr<Decoder> decoder_;
};

}  // namespace docent::interaction
