#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "docent/grid/occupancy_grid.h"

// The input is the map's YAML up to the first zero byte, then its image. Both go through files, as maps do.

namespace {

struct Folder {
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "docent-fuzz-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) std::abort();
    path = name;
  }
  ~Folder() { std::filesystem::remove_all(path); }
  std::filesystem::path path;
};

void write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream{path, std::ios::binary}.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  const std::string input{reinterpret_cast<const char*>(data), size};
  const std::size_t end = std::min(input.find('\0'), input.size());
  const auto yaml = folder.path / "map.yaml";
  write(yaml, input.substr(0, end));
  // Whatever it is: the reader goes by the content.
  for (const char* name : {"map.pgm", "map.png"})
    write(folder.path / name, input.substr(std::min(end + 1, input.size())));
  const auto map = docent::load_map(yaml);
  if (!map) {
    const std::string& message = map.error().message;
    if (message.rfind(folder.path.string(), 0) != 0 || message.find('\n') != std::string::npos) std::abort();
    return 0;
  }
  if (map->cells.size() != map->frame.size() || !(map->frame.resolution > 0.0)) std::abort();
  return 0;
}
