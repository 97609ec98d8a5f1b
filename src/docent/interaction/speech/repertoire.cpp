#include "docent/interaction/speech/repertoire.h"

#include <algorithm>
#include <system_error>

#include "docent/interaction/sound/sound_file.h"
#include "docent/interaction/speech/dictionary.h"
#include "docent/interaction/speech/sentences.h"
#include "docent/interaction/speech/spoken_text.h"

namespace docent::interaction {
namespace {

bool has_title(const Phrasing& phrasing) {
  return std::any_of(phrasing.by_mood.begin(), phrasing.by_mood.end(), [](const auto& variants) {
    return !variants.empty() && variants.front().find("{}") != std::string::npos;
  });
}

/// All ways to say the sentence, for the exhibit where a title stands in it.
void add_sentence(std::vector<RepertoireLine>& lines, Sentence which, const std::string& language,
                  const museum::Exhibit* exhibit) {
  const Phrasing& phrasing = dictionary_of(language).sentences.at(static_cast<std::size_t>(which));
  for (std::size_t i = 0; i < phrasing.by_mood.size(); ++i) {
    const auto mood = static_cast<Mood>(i);
    for (std::size_t variant = 0; variant < phrasing.by_mood[i].size(); ++variant) {
      std::string name = std::string{to_text(which)} + "." + to_text(mood) + "." + std::to_string(variant + 1);
      std::string title;
      if (exhibit != nullptr) {
        name += "." + exhibit->id;
        title = museum::translated(exhibit->title, language);
      }
      const std::string text = sentence(which, language, mood, static_cast<int>(variant), title);
      lines.push_back({std::move(name), {spoken_text(text), language, mood}});
    }
  }
}

void add_exhibit(std::vector<RepertoireLine>& lines, const std::string& language, const museum::Exhibit& exhibit) {
  const std::string short_text =
      introduction(museum::translated(exhibit.title, language), museum::translated(exhibit.short_text, language));
  lines.push_back({exhibit.id + ".short", {short_text, language, Mood::neutral}});
  const std::string long_text = spoken_text(museum::translated(exhibit.long_text, language));
  if (!long_text.empty()) lines.push_back({exhibit.id + ".long", {long_text, language, Mood::neutral}});
}

}  // namespace

std::vector<RepertoireLine> repertoire(const museum::Museum& museum) {
  std::vector<RepertoireLine> lines;
  for (const std::string& language : museum.languages) {
    std::vector<Sentence> with_title;
    for (int i = 0; i < kSentences; ++i) {
      const auto which = static_cast<Sentence>(i);
      if (!is_spoken(which) || which == Sentence::tour_announced) continue;  // that one has a tour and its time
      if (has_title(dictionary_of(language).sentences.at(static_cast<std::size_t>(i)))) {
        with_title.push_back(which);
      } else {
        add_sentence(lines, which, language, nullptr);
      }
    }
    for (const museum::Exhibit& exhibit : museum.exhibits) {
      for (const Sentence which : with_title) add_sentence(lines, which, language, &exhibit);
      add_exhibit(lines, language, exhibit);
    }
  }
  return lines;
}

Recordings::Recordings(const std::filesystem::path& museum_folder, const std::vector<RepertoireLine>& lines) {
  std::map<std::pair<std::string, std::string>, const SpokenLine*> by_name;  // by language and name
  for (const RepertoireLine& line : lines) by_name[{line.line.language, line.name}] = &line.line;
  std::error_code error;
  std::vector<std::filesystem::path> found;
  for (auto entry = std::filesystem::recursive_directory_iterator{museum_folder / "content" / "audio", error};
       !error && entry != std::filesystem::recursive_directory_iterator{}; entry.increment(error)) {
    if (entry->is_regular_file(error) && is_sound_file(entry->path())) found.push_back(entry->path());
  }
  std::sort(found.begin(), found.end());  // a folder's order is nobody's
  for (const std::filesystem::path& file : found) {
    const auto line = by_name.find({file.parent_path().filename().string(), file.stem().string()});
    if (line == by_name.end()) {
      strays_.push_back(file);
    } else {
      files_.emplace(std::pair{line->second->language, line->second->text}, file);
    }
  }
}

const std::filesystem::path* Recordings::find(const std::string& language, const std::string& text) const {
  const auto found = files_.find({language, text});
  return found == files_.end() ? nullptr : &found->second;
}

std::vector<Error> Recordings::faults() const {
  std::vector<Error> faults;
  for (const auto& [line, file] : files_) {
    if (const auto duration = sound_duration(file); !duration) faults.push_back(duration.error());
  }
  return faults;
}

}  // namespace docent::interaction
