#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "docent/interaction/speech/renderer.h"
#include "docent/museum/museum.h"

namespace docent::interaction {

/// Something that the robot can say in a museum.
struct RepertoireLine {
  /// Of its recording, without the ending: EXHIBIT.short and EXHIBIT.long for what it tells of an exhibit, else
  /// SENTENCE.MOOD.NUMBER, and SENTENCE.MOOD.NUMBER.EXHIBIT where a title stands in it. NUMBER counts from 1.
  std::string name;
  SpokenLine line;
};

/// All that it can say there, in each of the museum's languages, the museum's own one first: the sentences of its
/// dictionary, then each exhibit's announcements and texts.
[[nodiscard]] std::vector<RepertoireLine> repertoire(const museum::Museum& museum);

/// Lines that somebody recorded for the museum: FOLDER/content/audio/LANGUAGE/NAME.wav, .ogg or .flac, NAME as in its
/// repertoire. To say such a line is to play its recording.
class Recordings {
 public:
  Recordings() = default;
  Recordings(const std::filesystem::path& museum_folder, const std::vector<RepertoireLine>& lines);

  /// The recording of a text; null: there is none.
  [[nodiscard]] const std::filesystem::path* find(const std::string& language, const std::string& text) const;
  [[nodiscard]] std::size_t count() const { return files_.size(); }
  /// Sound files of that folder that are recordings of nothing: the line has changed its name, or the name is misspelt.
  [[nodiscard]] const std::vector<std::filesystem::path>& strays() const { return strays_; }
  /// Why a recording cannot be played, with its file: empty when all can.
  [[nodiscard]] std::vector<Error> faults() const;

 private:
  std::map<std::pair<std::string, std::string>, std::filesystem::path> files_;  ///< by language and text
  std::vector<std::filesystem::path> strays_;
};

}  // namespace docent::interaction
