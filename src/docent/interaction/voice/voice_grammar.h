#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "docent/museum/museum.h"

namespace docent::interaction {

/// What somebody wants by voice.
struct VoiceCommand {
  enum class Kind { exhibit, tour, room, more, next, end_tour, deliver, tidy, confirm };
  Kind kind = Kind::exhibit;
  std::string target;  ///< id of the exhibit, tour or room; else empty
  friend bool operator==(const VoiceCommand&, const VoiceCommand&) = default;
};
[[nodiscard]] const char* to_text(VoiceCommand::Kind kind);

/// Words as they are said: small letters and digits, everything else parts them. UTF-8 letters beyond ASCII stay.
[[nodiscard]] std::vector<std::string> said_words(std::string_view title);

/// The commands that visitors, and people in an office, may speak ([Buhmann1995] 4: a robot that was told by voice), in
/// English.
class VoiceGrammar {
 public:
  /// Exhibits that the robot drives to, tours and rooms by their English names. O(names).
  /// @param has_orders  deliveries and tidying up, too: the more commands, the less well each is understood
  explicit VoiceGrammar(const museum::Museum& museum, bool has_orders = false);

  /// All words of all commands, each once, in alphabetical order.
  [[nodiscard]] std::vector<std::string> words() const;
  /// A JSGF grammar of all commands. @param token_of  what stands for a word in the recognizer's dictionary
  [[nodiscard]] std::string jsgf(const std::map<std::string, std::string>& token_of) const;
  /// nullopt: the words are none of the commands.
  [[nodiscard]] std::optional<VoiceCommand> command_of(const std::vector<std::string>& said) const;
  [[nodiscard]] std::size_t size() const { return commands_.size(); }  ///< things that may be wanted

 private:
  struct Spoken {
    std::vector<std::vector<std::string>> beginnings;  ///< any of them
    std::vector<std::string> name;
    VoiceCommand command;
  };
  void add(const std::vector<std::string>& beginnings, const std::string& name, VoiceCommand command);

  std::vector<Spoken> commands_;
  std::map<std::string, VoiceCommand> meanings_;  ///< by the words that count, with blanks between them
};

}  // namespace docent::interaction
