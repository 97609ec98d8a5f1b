#pragma once

#include <yaml-cpp/yaml.h>

#include <cstddef>
#include <string>
#include <vector>

namespace docent::museum {

/// A YAML file as lines of which some are replaced. A value is known by the lines from its key, or its dash, to the
/// next one beside it; empty lines and comments at their end belong to what follows.
class YamlLines {
 public:
  explicit YamlLines(const std::string& text);

  struct Range {
    std::size_t begin = 0, end = 0;  ///< numbers of lines, from 0; `end` is the first behind it
  };
  [[nodiscard]] Range all() const { return {0, lines_.size()}; }
  /// Each value is written on lines of its own below its key: no value shares a line with another.
  [[nodiscard]] static bool is_in_lines(const YAML::Node& map);
  /// The lines of `key` and its value. @pre is_in_lines(map), which has it and lies within `of_map`
  [[nodiscard]] Range of_key(const YAML::Node& map, Range of_map, const std::string& key) const;
  /// The lines of each item. @pre is_in_lines(list)
  [[nodiscard]] std::vector<Range> of_items(const YAML::Node& list, Range of_list) const;

  /// The beginning of the first line of `range`, up to `column`.
  [[nodiscard]] std::string prefix(Range range, std::size_t column) const;
  void replace(Range range, std::vector<std::string> lines);
  void insert(std::size_t before, std::vector<std::string> lines);

  /// With all replacements, which must not overlap.
  [[nodiscard]] std::string text() const;

 private:
  [[nodiscard]] Range without_end_of_comments(Range range) const;

  struct Change {
    Range range;
    std::vector<std::string> lines;
  };
  std::vector<std::string> lines_;
  std::vector<Change> changes_;
};

}  // namespace docent::museum
