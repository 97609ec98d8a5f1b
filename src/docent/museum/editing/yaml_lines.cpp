#include "docent/museum/editing/yaml_lines.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace docent::museum {
namespace {

std::size_t line_of(const YAML::Node& node) { return static_cast<std::size_t>(std::max(0, node.Mark().line)); }

}  // namespace

YamlLines::YamlLines(const std::string& text) {
  std::istringstream stream{text};
  for (std::string line; std::getline(stream, line);) lines_.push_back(line);
}

bool YamlLines::is_in_lines(const YAML::Node& map) {
  return (map.IsMap() || map.IsSequence()) && map.size() > 0 && map.Style() == YAML::EmitterStyle::Block;
}

YamlLines::Range YamlLines::without_end_of_comments(Range range) const {
  while (range.end > range.begin + 1) {
    const std::string& last = lines_[range.end - 1];
    const auto first = last.find_first_not_of(" \t\r");
    if (first != std::string::npos && last[first] != '#') break;
    --range.end;
  }
  return range;
}

YamlLines::Range YamlLines::of_key(const YAML::Node& map, Range of_map, const std::string& key) const {
  Range range{0, std::min(of_map.end, lines_.size())};
  for (const auto& entry : map) {
    if (entry.first.Scalar() == key) range.begin = line_of(entry.first);
  }
  for (const auto& entry : map) {
    const std::size_t line = line_of(entry.first);
    if (line > range.begin) range.end = std::min(range.end, line);
  }
  return without_end_of_comments(range);
}

std::vector<YamlLines::Range> YamlLines::of_items(const YAML::Node& list, Range of_list) const {
  std::vector<Range> ranges;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::size_t end = i + 1 < list.size() ? line_of(list[i + 1]) : of_list.end;
    ranges.push_back(without_end_of_comments({line_of(list[i]), std::min(end, lines_.size())}));
  }
  return ranges;
}

std::string YamlLines::prefix(Range range, std::size_t column) const {
  return range.begin < lines_.size() ? lines_[range.begin].substr(0, column) : std::string(column, ' ');
}

void YamlLines::replace(Range range, std::vector<std::string> lines) { changes_.push_back({range, std::move(lines)}); }

void YamlLines::insert(std::size_t before, std::vector<std::string> lines) {
  changes_.push_back({{before, before}, std::move(lines)});
}

std::string YamlLines::text() const {
  auto changes = changes_;
  std::stable_sort(changes.begin(), changes.end(),
                   [](const Change& a, const Change& b) { return a.range.begin < b.range.begin; });
  std::string text;
  std::size_t next = 0;
  const auto copy_until = [&](std::size_t end) {
    for (; next < std::min(end, lines_.size()); ++next) text += lines_[next] + '\n';
  };
  for (const Change& change : changes) {
    copy_until(change.range.begin);
    for (const std::string& line : change.lines) text += line + '\n';
    next = std::max(next, change.range.end);
  }
  copy_until(lines_.size());
  return text;
}

}  // namespace docent::museum
