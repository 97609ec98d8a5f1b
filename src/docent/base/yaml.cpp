#include "docent/base/yaml.h"

#include <algorithm>
#include <cmath>

#include "docent/base/files.h"
#include "docent/base/suggestion.h"

namespace docent {
namespace {

template <class T>
T scalar(const YamlFile& file, const YAML::Node& node, const char* wanted) {
  if (!node.IsScalar()) throw YamlFault{file.fault(node, std::string{"expected "} + wanted)};
  try {
    return node.as<T>();
  } catch (const YAML::Exception&) {
    throw YamlFault{file.fault(node, std::string{"expected "} + wanted + ", found '" + node.Scalar() + "'")};
  }
}

/// A file's own words may come into a fault: they stay on one line, and short.
std::string on_one_line(std::string text) {
  constexpr std::size_t kLongest = 300;
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text;
}

/// What was parsed from an option of the command line, named after it, has no lines that its reader could look up.
bool is_option(const std::string& name) { return name.starts_with("--"); }

/// Where a second document has its first line with anything in it; 0: there is none. A line that begins with three
/// dashes or dots ends a document wherever it stands. The parser's own way to all documents never ends on some inputs.
int line_of_second_document(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  bool has_content = false, is_second = false;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const bool is_mark = (line.starts_with("---") || line.starts_with("...")) &&
                         (line.size() == 3 || line[3] == ' ' || line[3] == '\t' || line[3] == '\r');
    if (is_mark) {
      is_second = is_second || has_content;
      line.remove_prefix(3);
    }
    const std::size_t at = line.find_first_not_of(" \t\r");
    if (at == std::string_view::npos || line[at] == '#' || (!has_content && line[0] == '%')) continue;
    if (is_second) return number;
    has_content = true;
  }
  return 0;
}

}  // namespace

Result<YamlFile> YamlFile::load(const std::filesystem::path& path) {
  auto text = read_file(path);
  if (!text) return tl::unexpected<Error>(text.error());
  return parse(*text, path.string());
}

Result<YamlFile> YamlFile::parse(const std::string& text, std::string name) {
  if (const std::size_t at = text.find('\0'); at != std::string::npos) {
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    return fail(name + ":" + std::to_string(line) + ": is no text file, and so no YAML file");
  }
  // Deep nesting overflows the parser's stack: refuse what no file of ours needs.
  int depth = 0;
  for (const char c : text) {
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > 64) return fail(name + ":1: nested more than 64 deep");
  }
  try {
    const YAML::Node first = YAML::Load(text);
    if (const int line = line_of_second_document(text); line > 0)  // the parser would pass over it without a word
      return fail(name + (is_option(name) ? "" : ":" + std::to_string(line)) +
                  ": another YAML document begins here: one alone is read");
    return YamlFile{first, std::move(name)};
  } catch (const YAML::Exception& exception) {
    const std::string line = is_option(name) ? "" : ":" + std::to_string(exception.mark.line + 1);
    return fail(name + line + ": not valid YAML: " + on_one_line(exception.msg));
  }
}

Error YamlFile::fault(const YAML::Node& at, const std::string& what) const {
  if (is_option(name_)) return Error{name_ + ": " + on_one_line(what)};
  const int line = at.IsDefined() ? at.Mark().line : -1;
  return Error{name_ + ":" + std::to_string(line < 0 ? 1 : line + 1) + ": " + on_one_line(what)};
}

YamlReader::YamlReader(const YamlFile& file, const YAML::Node& node) : file_{file}, node_{node} {
  if (!node.IsDefined() || node.IsNull()) {
    node_ = YAML::Node{YAML::NodeType::Map};
  } else if (!node.IsMap()) {
    throw YamlFault{file.fault(node, "expected a mapping (key: value)")};
  }
  std::set<std::string> seen;
  for (const auto& entry : node_) {
    if (!entry.first.IsScalar()) throw YamlFault{file.fault(entry.first, "expected a plain key")};
    if (!seen.insert(entry.first.Scalar()).second) {
      throw YamlFault{file.fault(entry.first, "key '" + entry.first.Scalar() + "' stands twice")};
    }
  }
}

YAML::Node YamlReader::node(const char* key) {
  known_.insert(key);
  const YAML::Node& parent = node_;  // operator[] of a non-const node would insert
  return parent[key];
}

std::vector<std::string> YamlReader::unknown() const {
  if (!missing_.empty()) throw YamlFault{file_.fault(node_, "missing key '" + missing_.front() + "'")};
  std::vector<std::string> keys;
  for (const auto& entry : node_)
    if (!known_.contains(entry.first.Scalar())) keys.push_back(entry.first.Scalar());
  return keys;
}

void YamlReader::finish() const {
  for (const auto& entry : node_) {
    const auto& key = entry.first.Scalar();
    if (known_.contains(key)) continue;
    std::string names;
    for (const auto& name : known_) names += (names.empty() ? "" : ", ") + name;
    const std::string meant = did_you_mean(key, {known_.begin(), known_.end()});
    throw YamlFault{file_.fault(entry.first, "unknown key '" + key + "'" + meant + " (known: " + names + ")")};
  }
  if (!missing_.empty()) throw YamlFault{file_.fault(node_, "missing key '" + missing_.front() + "'")};
}

void YamlReader::read_value(const YAML::Node& node, double& field) {
  field = scalar<double>(file_, node, "a number");
  if (!std::isfinite(field)) throw YamlFault{file_.fault(node, "expected a finite number")};
}
void YamlReader::read_value(const YAML::Node& node, float& field) {
  double value = 0.0;
  read_value(node, value);
  field = static_cast<float>(value);
}
void YamlReader::read_value(const YAML::Node& node, int& field) { field = scalar<int>(file_, node, "a whole number"); }
void YamlReader::read_value(const YAML::Node& node, std::int64_t& field) {
  field = scalar<std::int64_t>(file_, node, "a whole number");
}
void YamlReader::read_value(const YAML::Node& node, std::uint64_t& field) {
  field = scalar<std::uint64_t>(file_, node, "a whole number");
}
void YamlReader::read_value(const YAML::Node& node, bool& field) { field = scalar<bool>(file_, node, "true or false"); }
void YamlReader::read_value(const YAML::Node& node, std::string& field) {
  field = scalar<std::string>(file_, node, "a text");
}

}  // namespace docent
