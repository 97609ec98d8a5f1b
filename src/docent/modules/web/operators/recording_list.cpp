#include "docent/modules/web/operators/recording_list.h"

#include "docent/interaction/speech/repertoire.h"

namespace docent::modules {

telepresence::documents::MuseumRecordings recordings_of(const museum::Museum& museum) {
  const auto lines = interaction::repertoire(museum);
  const interaction::Recordings recordings{museum.folder, lines};
  telepresence::documents::MuseumRecordings document;
  document.lines = lines.size();
  for (const auto& [name, line] : lines) {
    const auto* file = recordings.find(line.language, line.text);
    const bool is_of_exhibit = name.ends_with(".short") || name.ends_with(".long");
    if (file == nullptr && !is_of_exhibit) continue;
    document.recordings.push_back(
        {"content/audio/" + line.language + "/" + name, line.language, line.text, file != nullptr});
  }
  for (const auto& stray : recordings.strays())
    document.strays.push_back(stray.lexically_relative(museum.folder).generic_string());
  return document;
}

}  // namespace docent::modules
