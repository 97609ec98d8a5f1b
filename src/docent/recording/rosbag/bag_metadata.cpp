#include "docent/recording/rosbag/bag_metadata.h"

#include <algorithm>

#include "docent/base/yaml.h"

namespace docent::recording {
namespace {

namespace fs = std::filesystem;

/// The names that metadata.yaml lists; other programs' keys do not matter.
Result<std::vector<std::string>> files_listed_in(const fs::path& metadata) {
  const auto file = YamlFile::load(metadata);
  if (!file) return tl::unexpected<Error>(file.error());
  const YAML::Node root = file->root();
  if (!root.IsMap()) return fail(metadata.string() + ":1: is no metadata of rosbag2");
  const YAML::Node about = root["rosbag2_bagfile_information"];
  const YAML::Node paths = about.IsDefined() && about.IsMap() ? about["relative_file_paths"] : YAML::Node{};
  if (!paths.IsDefined() || !paths.IsSequence()) return fail(metadata.string() + ":1: is no metadata of rosbag2");
  std::vector<std::string> names;
  for (const auto& path : paths)
    if (path.IsScalar()) names.push_back(path.Scalar());
  return names;
}

/// bag_2 comes before bag_10.
bool comes_before(const fs::path& a, const fs::path& b) {
  const std::string x = a.filename(), y = b.filename();
  return x.size() != y.size() ? x.size() < y.size() : x < y;
}

}  // namespace

bool is_part_of_bag(const fs::path& file) {
  const auto is_kind = [](const fs::path& name) { return name.extension() == ".mcap" || name.extension() == ".db3"; };
  return is_kind(file) || (file.extension() == ".zstd" && is_kind(file.stem()));
}

std::vector<fs::path> parts_of_bag(const fs::path& folder, std::vector<std::string>& notes) {
  std::vector<fs::path> there;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator{folder, error})
    if (is_part_of_bag(entry.path())) there.push_back(entry.path());
  std::sort(there.begin(), there.end(), comes_before);
  // Of a part that was unpacked beside its packed form one is enough.
  std::erase_if(there, [&](const fs::path& part) {
    return part.extension() == ".zstd" &&
           std::find(there.begin(), there.end(), fs::path{part}.replace_extension()) != there.end();
  });
  const fs::path metadata = folder / "metadata.yaml";
  if (!fs::exists(metadata, error)) return there;
  const auto names = files_listed_in(metadata);
  if (!names) {
    notes.push_back(names.error().message + ": all parts that are there are read");
    return there;
  }
  std::vector<fs::path> parts;
  for (const std::string& name : *names) {
    // Some versions name the folder, too, and an unpacked part has lost its ending.
    const fs::path file = folder / fs::path{name}.filename();
    const fs::path unpacked = file.extension() == ".zstd" ? fs::path{file}.replace_extension() : file;
    const auto found = std::find_if(there.begin(), there.end(),
                                    [&](const fs::path& part) { return part == file || part == unpacked; });
    if (found != there.end())
      parts.push_back(*found);
    else
      notes.push_back(metadata.string() + ": " + name + ", which it names, is not there");
  }
  for (const fs::path& part : there) {
    if (std::find(parts.begin(), parts.end(), part) != parts.end()) continue;
    notes.push_back(part.string() + ": not named by metadata.yaml, and read none the less");
    parts.push_back(part);
  }
  return parts;
}

}  // namespace docent::recording
