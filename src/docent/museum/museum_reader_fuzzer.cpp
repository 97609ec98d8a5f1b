#include <cstdint>
#include <cstdlib>
#include <string>

#include "docent/museum/museum_reader.h"

/// Whatever museum.yaml holds: faults, never a crash; and a museum without a fault keeps the reader's promises.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text{reinterpret_cast<const char*>(data), size};
  const auto file = docent::YamlFile::parse(text, "museum.yaml");
  if (!file) return 0;
  const auto source = docent::museum::read_museum(
      *file, [](const std::filesystem::path&) -> docent::Result<std::string> { return std::string{"A text."}; });
  if (!source.faults.empty()) return 0;
  if (source.museum.area.size() < 3 || source.museum.exhibits.empty()) std::abort();
  if (source.exhibits.size() != source.museum.exhibits.size()) std::abort();
  if (docent::museum::sensible_pairs(source.museum) > source.museum.exhibits.size() * source.museum.exhibits.size()) {
    std::abort();
  }
  return 0;
}
