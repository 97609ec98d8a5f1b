#include "docent/interaction/speech/spoken_text.h"

#include <algorithm>

#include "docent/interaction/speech/dictionary.h"

namespace docent::interaction {
namespace {

bool is_blank(char c) { return static_cast<unsigned char>(c) <= ' ' || c == '\x7f'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// What one line says, without the marks at its begin; `is_block` is set when the line stands for itself.
std::string_view without_line_marks(std::string_view line, bool& is_block) {
  line = trimmed(line);
  if (!line.empty() && line.front() == '#') {
    is_block = true;
    line.remove_prefix(std::min(line.find_first_not_of('#'), line.size()));
    return trimmed(line);
  }
  while (!line.empty() && line.front() == '>') line = trimmed(line.substr(1));
  if (line.size() >= 2 && (line[0] == '-' || line[0] == '*' || line[0] == '+') && line[1] == ' ') {
    is_block = true;
    return trimmed(line.substr(2));
  }
  if (line.size() >= 3 && line.find_first_not_of("-*_= ") == std::string_view::npos) {
    is_block = true;
    return {};
  }
  return line;
}

/// Emphasis, code, links and images reduced to their words.
std::string without_inline_marks(std::string_view line) {
  std::string text;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '\\' && i + 1 < line.size()) {
      text += line[++i];
      continue;
    }
    const bool is_image = c == '!' && i + 1 < line.size() && line[i + 1] == '[';
    if (is_image || c == '[') {
      const std::size_t begin = i + (is_image ? 2U : 1U);
      const std::size_t middle = line.find("](", begin);
      const std::size_t end = middle == std::string_view::npos ? middle : line.find(')', middle);
      if (end != std::string_view::npos) {
        if (!is_image) text += line.substr(begin, middle - begin);
        i = end;
        continue;
      }
    }
    if (c == '*' || c == '`' || c == '~') continue;
    if (c == '_') {  // inside a word it belongs to the word
      const bool opens = i == 0 || !(static_cast<unsigned char>(line[i - 1]) > 0x2f);
      const bool closes = i + 1 == line.size() || !(static_cast<unsigned char>(line[i + 1]) > 0x2f);
      if (opens || closes) continue;
    }
    text += c;
  }
  return text;
}

void end_block(std::string& text) {
  while (!text.empty() && is_blank(text.back())) text.pop_back();
  if (text.empty()) return;
  if (std::string_view{".!?:;"}.find(text.back()) == std::string_view::npos) text += '.';
}

}  // namespace

std::string spoken_text(std::string_view markdown) {
  std::string text;
  for (std::size_t begin = 0; begin <= markdown.size();) {
    const std::size_t end = std::min(markdown.find('\n', begin), markdown.size());
    const std::string_view raw = markdown.substr(begin, end - begin);
    begin = end + 1;
    bool is_block = false;
    const std::string line = without_inline_marks(without_line_marks(raw, is_block));
    if (is_block || trimmed(raw).empty()) end_block(text);
    if (!text.empty() && text.back() != ' ') text += ' ';
    for (const char c : trimmed(line)) {
      const char folded = is_blank(c) ? ' ' : c;
      if (folded == ' ' && (text.empty() || text.back() == ' ')) continue;
      text += folded;
    }
    if (is_block) end_block(text);
  }
  end_block(text);
  return text;
}

std::string introduction(std::string_view title, std::string_view short_text) {
  return spoken_text(title) + " " + spoken_text(short_text);
}

std::size_t count_code_points(std::string_view utf8) {
  return static_cast<std::size_t>(
      std::count_if(utf8.begin(), utf8.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; }));
}

Voice voice_of(Mood mood) {
  switch (mood) {
    case Mood::happy:
      return {170, 60};
    case Mood::sad:
      return {140, 35};
    case Mood::angry:
      return {175, 40};
    case Mood::neutral:
      break;
  }
  return {};
}

double speech_duration(std::string_view text, std::string_view language, Mood mood) {
  if (text.empty()) return 0.0;
  const Dictionary& dictionary = dictionary_of(language);
  const auto sentences =
      std::count_if(text.begin(), text.end(), [](char c) { return c == '.' || c == '!' || c == '?'; });
  const double at_175 = dictionary.per_character * static_cast<double>(count_code_points(text)) +
                        dictionary.per_sentence * static_cast<double>(std::max<std::ptrdiff_t>(sentences, 1));
  return at_175 * 175.0 / static_cast<double>(voice_of(mood).words_per_minute);
}

}  // namespace docent::interaction
