// Reads the doc comments of parameter structs out of the sources and writes them as rows of C++:
// `{"Struct", "field", "meaning"}`, `{"Struct", "", "meaning of the struct"}`, and `{"Struct", "<", "Other"}` where the
// struct's `visit` lists the keys of another one as its own. So `docent config` says what the structs say, and no
// meaning is written twice.
//
//   docent_parameter_meanings_generator OUT FILE…
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace {

struct Row {
  std::string owner;
  std::string field;
  std::string meaning;
};

std::string joined(const std::string& before, const std::string& after) {
  return before.empty() || after.empty() ? before + after : before + " " + after;
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// The names that a declaration declares: x and y of "double x = 0.0, y = f(1, 2);".
std::vector<std::string> declared_names(const std::string& declaration) {
  std::vector<std::string> pieces{""};
  int nesting = 0;
  bool in_quotes = false;
  bool in_initializer = false;
  for (const char c : declaration) {
    if (c == '"') in_quotes = !in_quotes;
    if (in_quotes) continue;
    if (nesting == 0 && (c == '=' || c == '{' || c == ';')) in_initializer = true;
    if (c == '<' || c == '(' || c == '{') ++nesting;
    if (c == '>' || c == ')' || c == '}') --nesting;
    if (nesting == 0 && c == ',') {
      pieces.emplace_back();
      in_initializer = false;
    } else if (!in_initializer) {
      pieces.back() += c;
    }
  }
  static const std::regex kName{R"(([A-Za-z_]\w*)\s*$)"};
  std::vector<std::string> names;
  for (const std::string& piece : pieces) {
    std::smatch found;
    if (std::regex_search(piece, found, kName)) names.push_back(found[1]);
  }
  return names;
}

/// One file: a scan by lines, which clang-format has laid out.
class Scan {
 public:
  explicit Scan(std::vector<Row>& rows) : rows_{rows} {}

  void line(const std::string& raw) {
    const std::string text = trimmed(raw);
    if (text.starts_with("///<")) {  // goes on with what stands behind the declaration above
      for (Row* row : last_rows()) row->meaning = joined(row->meaning, trimmed(text.substr(4)));
      return;
    }
    if (text.starts_with("///")) {
      last_count_ = 0;
      before_ = joined(before_, trimmed(text.substr(3)));
      return;
    }
    const auto comment = text.find("//");
    const std::string code = trimmed(text.substr(0, comment));
    const auto behind = text.find("///<");
    read_code(code, behind == std::string::npos ? "" : trimmed(text.substr(behind + 4)));
  }

 private:
  struct Open {
    std::string name;
    int depth;
    std::map<std::string, std::string> types;  ///< of its fields
  };

  std::vector<Row*> last_rows() {
    std::vector<Row*> result;
    for (std::size_t i = rows_.size() - last_count_; i < rows_.size(); ++i) result.push_back(&rows_[i]);
    return result;
  }

  void read_code(const std::string& code, const std::string& behind) {
    static const std::regex kStruct{R"(^struct (\w+)(?: final)?(?: : (?:public )?([\w:]+))? \{)"};
    static const std::regex kField{R"(^(?:std::\w+<)?(?:\w+::)*(\w+)[\w:<>, ]*[ >]\w+ ?(=|\{|;|,))"};
    static const std::regex kListsOther{R"(^(?:\w+::)*(\w+)(?:\.|::)visit\(v\);)"};
    std::smatch found;
    const bool in_struct = !open_.empty() && depth_ == open_.back().depth + 1;
    if (std::regex_search(code, found, kStruct)) {
      open_.push_back({found[1], depth_, {}});
      rows_.push_back({found[1], "", before_});
    } else if (in_struct && std::regex_search(code, found, kField) && !code.starts_with("template") &&
               !code.starts_with("static") && !code.starts_with("[[") && !code.starts_with("using") &&
               !code.starts_with("enum") && !code.starts_with("friend")) {
      last_count_ = 0;
      for (const std::string& name : declared_names(code)) {
        rows_.push_back({open_.back().name, name, joined(before_, behind)});
        open_.back().types[name] = found[1];
        ++last_count_;
      }
    } else if (!open_.empty() && std::regex_search(code, found, kListsOther)) {
      const auto type = open_.back().types.find(found[1]);
      rows_.push_back(
          {open_.back().name, "<", type == open_.back().types.end() ? std::string{found[1]} : type->second});
      last_count_ = 0;
    } else {
      last_count_ = 0;
    }
    before_.clear();
    bool in_quotes = false;
    for (const char c : code) {
      if (c == '"') in_quotes = !in_quotes;
      if (in_quotes) continue;
      if (c == '{') ++depth_;
      if (c == '}' && --depth_ == (open_.empty() ? -1 : open_.back().depth)) open_.pop_back();
    }
  }

  std::vector<Row>& rows_;
  std::vector<Open> open_;
  int depth_ = 0;
  std::string before_;          ///< doc comment above
  std::size_t last_count_ = 0;  ///< rows of the declaration just read
};

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: %s OUT FILE...\n", argv[0]);
    return 2;
  }
  std::vector<Row> rows;
  for (int i = 2; i < argc; ++i) {
    std::ifstream file{argv[i]};
    if (!file) {
      std::fprintf(stderr, "%s: cannot be read\n", argv[i]);
      return 1;
    }
    Scan scan{rows};
    for (std::string line; std::getline(file, line);) scan.line(line);
  }
  std::ofstream out{argv[1]};
  for (const Row& row : rows)
    out << "{" << quoted(row.owner) << ", " << quoted(row.field) << ", " << quoted(row.meaning) << "},\n";
  return out ? 0 : 1;
}
