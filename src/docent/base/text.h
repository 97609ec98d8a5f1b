#pragma once

#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace docent {

/// ASCII in lower case; other characters stay.
[[nodiscard]] inline std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// "a, b, c"; `none` where there is nothing.
[[nodiscard]] inline std::string listed(const std::vector<std::string>& names, const char* none = "") {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? none : text;
}

/// "[1, 0.25]", as `read_yaml` reads it: numbers for a file of YAML, nine digits of each; they must be finite.
[[nodiscard]] inline std::string yaml_list(std::span<const double> values) {
  std::string text = "[";
  for (const double value : values) {
    char number[40];
    std::snprintf(number, sizeof number, "%s%.9g", text.size() > 1 ? ", " : "", value);
    text += number;
  }
  return text + "]";
}

/// Whether the file's first bytes are these. A file that cannot be read begins with nothing.
[[nodiscard]] inline bool begins_with(const std::filesystem::path& path, std::string_view bytes) {
  std::string head(bytes.size(), '\0');
  std::ifstream file{path, std::ios::binary};
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  return file.gcount() == static_cast<std::streamsize>(bytes.size()) && head == bytes;
}

}  // namespace docent
