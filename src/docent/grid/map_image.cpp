#include "docent/grid/map_image.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>

namespace docent {
namespace {

struct Kind {
  std::string_view begins;
  std::string_view name;
};
using namespace std::string_view_literals;
constexpr Kind kOthers[] = {
    {"BM"sv, "a BMP image"},           {"\xff\xd8\xff"sv, "a JPEG image"},
    {"II*\0"sv, "a TIFF image"},       {"MM\0*"sv, "a TIFF image"},
    {"GIF8"sv, "a GIF image"},         {"RIFF"sv, "a WebP image"},
    {"P1"sv, "a bitmap (P1)"},         {"P3"sv, "a PPM image (P3)"},
    {"P4"sv, "a bitmap (P4)"},         {"P6"sv, "a PPM image (P6)"},
    {"P7"sv, "a PAM image"},           {"%PDF"sv, "a PDF document"},
    {"<svg"sv, "an SVG drawing"},      {"<?xml"sv, "an XML document"},
    {"PK\x03\x04"sv, "a ZIP archive"}, {"\x1f\x8b"sv, "a gzipped file"},
};

/// What a file of this name should begin with; empty: the name says nothing.
std::string promise_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  if (extension == ".pgm") return "a PGM image begins with P5 or P2";
  if (extension == ".png") return "a PNG image begins with the byte 137 and PNG";
  return {};
}

}  // namespace

Result<std::unique_ptr<MapImage>> open_map_image(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto type = std::filesystem::status(path, ignored).type();
  if (type == std::filesystem::file_type::fifo || type == std::filesystem::file_type::character)  // could wait for ever
    return fail(path.string() + ": cannot be read: it is a pipe or a device, and no file");
  std::ifstream file{path, std::ios::binary};
  std::array<char, 8> bytes{};
  if (!file || std::filesystem::is_directory(path))
    return fail(path.string() + ": cannot be read: " + std::strerror(file ? EISDIR : errno));
  file.read(bytes.data(), bytes.size());
  const std::string_view begin{bytes.data(), static_cast<std::size_t>(file.gcount())};
  const std::string name = path.string() + ":1: ";
  if (begin.empty()) return fail(name + "the file is empty");
  if (begin.starts_with("P5") || begin.starts_with("P2")) return open_pgm(path);
  if (begin.starts_with("\x89PNG")) return open_png(path);
  for (const Kind& kind : kOthers)
    if (begin.starts_with(kind.begins))
      return fail(name + "this is " + std::string{kind.name} +
                  ": a map's image is PGM (P2, P5) or PNG; any program that edits pictures writes those, without loss");
  if (const std::string promise = promise_of(path); !promise.empty())
    return fail(name + promise + ", and this file does not: it is damaged, or something else");
  return fail(name + "neither a PGM (P2, P5) nor a PNG image");
}

}  // namespace docent
