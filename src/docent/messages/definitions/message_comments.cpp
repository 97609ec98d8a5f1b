#include "docent/messages/definitions/message_comments.h"

#include <regex>
#include <sstream>

namespace docent {
namespace {

void append(std::string& text, const std::string& more) { text += (text.empty() || more.empty() ? "" : " ") + more; }

}  // namespace

void add_message_comments(const std::string& header, MessageComments& comments) {
  static const std::regex kBefore{R"(\s*///(?!<)\s*(.*))"};
  static const std::regex kStruct{R"(struct (\w+) \{)"};
  static const std::regex kBehind{R"((.*?)\s*///<\s*(.*))"};
  static const std::regex kField{R"(\s+(?!static|template)[\w:]+(?:<.*>)?\s+(\w+)\s*(?:[={;].*)?)"};
  std::string name;     // of the struct
  std::string field;    // the last one
  std::string pending;  // what stands before the next declaration
  std::istringstream lines{header};
  for (std::string line; std::getline(lines, line);) {
    std::smatch found;
    if (std::regex_match(line, found, kBefore)) {
      append(pending, found[1]);
      continue;
    }
    std::string behind;
    if (std::regex_match(line, found, kBehind)) {
      behind = found[2];
      line = std::string{found[1]};
    }
    if (std::regex_match(line, found, kStruct)) {
      name = found[1];
      comments[name] = pending;
    } else if (line == "};") {
      name.clear();
      field.clear();
    } else if (!name.empty() && std::regex_match(line, found, kField)) {
      field = name + "." + std::string{found[1]};
      comments[field] = pending;
    }
    // A comment behind may go on in lines of its own, and a declaration in the next line.
    if (!name.empty() && !field.empty() && !behind.empty()) append(comments[field], behind);
    pending.clear();
  }
}

std::string commented_msg(const std::string& msg, const std::string& name, const MessageComments& comments) {
  const auto comment_of = [&](const std::string& key) {
    const auto found = comments.find(key);
    return found == comments.end() || found->second.empty() ? std::string{} : "# " + found->second;
  };
  std::string text = comment_of(name);
  if (!text.empty()) text += "\n\n";
  std::istringstream lines{msg};
  for (std::string line; std::getline(lines, line);) {
    const std::string comment = comment_of(name + "." + line.substr(line.rfind(' ') + 1));
    text += line + (comment.empty() ? "" : "  " + comment) + "\n";
  }
  return text;
}

}  // namespace docent
