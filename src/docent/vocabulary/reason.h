#pragma once

#include <string>
#include <utility>

#include "docent/vocabulary/vocabulary.h"

namespace docent {

/// Why something is as it is, as data: a word, and the one thing that it is about. It becomes a sentence where somebody
/// reads it, in their language. In messages and stores it is one text, "WORD" or "WORD ABOUT". A text that begins with
/// no word, such as a sentence of an older recording, is kept as it came and shown to nobody.
class Reason {
 public:
  Reason() = default;  ///< none; its text is empty
  // Each word is a reason.
  Reason(ReasonWord word, std::string about = {})  // NOLINT(google-explicit-constructor)
      : word_{word}, about_{std::move(about)} {}
  [[nodiscard]] static Reason from_text(const std::string& text) {
    const std::size_t end = text.find(' ');
    Word<ReasonWord> word{text.substr(0, end)};
    Reason reason;
    reason.word_ = word.value() ? std::move(word) : Word<ReasonWord>{text};
    if (reason.word() && end != std::string::npos) reason.about_ = text.substr(end + 1);
    return reason;
  }
  [[nodiscard]] bool is_none() const { return word_ == Word<ReasonWord>{}; }
  /// nullopt: there is none, or nobody knows it.
  [[nodiscard]] std::optional<ReasonWord> word() const { return word_.value(); }
  [[nodiscard]] const std::string& about() const { return about_; }
  [[nodiscard]] std::string text() const { return about_.empty() ? word_.text() : word_.text() + " " + about_; }
  friend bool operator==(const Reason&, const Reason&) = default;

 private:
  Word<ReasonWord> word_;
  std::string about_;
};

}  // namespace docent
