#include "docent/museum/museum_file.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

#include "docent/base/files.h"
#include "docent/base/shipped_files.h"
#include "docent/base/suggestion.h"

namespace docent::museum {
namespace {

namespace fs = std::filesystem;

/// The names of the museums in `folder`, sorted.
std::vector<std::string> museums_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code code;
  for (fs::directory_iterator entry{folder, code}, end; !code && entry != end; entry.increment(code)) {
    std::error_code ignored;
    if (fs::is_regular_file(entry->path() / "museum.yaml", ignored)) names.push_back(entry->path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string no_museum(const fs::path& given) {
  const fs::path folder = given.has_filename() ? given : given.parent_path();
  fs::path beside = folder.has_parent_path() ? folder.parent_path() : fs::path{"."};
  std::vector<std::string> names = museums_in(beside);
  if (names.empty()) names = museums_in(beside = shipped_path("museums"));
  const std::string name = folder.filename().string();
  const bool is_elsewhere = std::find(names.begin(), names.end(), name) != names.end();
  std::string text = folder.string() + ": there is no such folder";
  text += is_elsewhere ? "; did you mean '" + (beside / name).string() + "'?" : did_you_mean(name, names);
  if (names.empty()) return text;
  text += " (museums in " + beside.string() + ": ";
  for (const std::string& each : names) text += (each == names.front() ? "" : ", ") + each;
  return text + ")";
}

/// A folder that holds museums, or none.
std::string no_museum_in(const fs::path& folder, const std::vector<std::string>& inside) {
  std::string text = folder.string() + ": this folder has no museum.yaml";
  if (inside.size() == 1) return text + "; did you mean '" + (folder / inside.front()).string() + "'?";
  text += "; did you mean one of the museums in it? (";
  for (const std::string& each : inside) text += (each == inside.front() ? "" : ", ") + (folder / each).string();
  return text + ")";
}

}  // namespace

Result<YamlFile> load_museum_file(const fs::path& folder) {
  std::error_code code;
  if (!fs::exists(folder, code)) return fail(no_museum(folder));
  if (fs::is_directory(folder, code) && !fs::exists(folder / "museum.yaml", code)) {
    if (const auto inside = museums_in(folder); !inside.empty()) return fail(no_museum_in(folder, inside));
  }
  return YamlFile::load(folder / "museum.yaml");
}

MuseumSource read_museum_file(const YamlFile& file, const fs::path& folder, Stage stage) {
  MuseumSource source = read_museum(file, [&](const fs::path& relative) { return read_file(folder / relative); });
  const YAML::Node& root = file.root();
  if (stage == Stage::being_set_up || !root.IsMap()) return source;
  const YAML::Node exhibits = root["exhibits"];
  if (exhibits.IsDefined() && exhibits.IsSequence() && exhibits.size() == 0) {
    for (auto follows = source.of_no_exhibits.rbegin(); follows != source.of_no_exhibits.rend(); ++follows)
      source.faults.erase(source.faults.begin() + static_cast<std::ptrdiff_t>(*follows));
    source.of_no_exhibits.clear();
    source.faults.insert(source.faults.begin(), file.fault(exhibits, "needs at least one exhibit"));
  }
  return source;
}

}  // namespace docent::museum
