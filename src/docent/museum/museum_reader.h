#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/yaml.h"
#include "docent/museum/museum.h"

namespace docent::museum {

/// The content of a file of the museum's folder, named relative to it.
using ReadText = std::function<Result<std::string>(const std::filesystem::path& relative)>;

/// museum.yaml as written: all that could be read, and every fault of form found on the way, in the file's order.
struct MuseumSource {
  Museum museum;  ///< without its map
  std::vector<Error> faults;
  std::vector<std::size_t> of_no_exhibits;  ///< those faults that follow from there being no exhibit, rising
  /// Where things stand, for later faults: parallel to museum.exhibits, .hazards, .tours, .rooms.
  std::vector<YAML::Node> exhibits;
  std::vector<YAML::Node> hazards;
  std::vector<YAML::Node> tours;
  std::vector<YAML::Node> rooms;
};

/// Reads the parsed museum.yaml; texts come through `read_text`. Never throws, whatever the file holds.
[[nodiscard]] MuseumSource read_museum(const YamlFile& file, const ReadText& read_text);

}  // namespace docent::museum
