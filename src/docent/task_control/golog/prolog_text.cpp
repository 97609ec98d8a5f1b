#include "docent/task_control/golog/prolog_text.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <utility>

#include "docent/base/check.h"

namespace docent::task_control {
namespace {

constexpr int kDeepest = 8;  // lists within lists: more is no answer of host.pl

std::string quoted(const std::string& text, char quote) {
  std::string result{quote};
  for (const char c : text) {
    if (c == quote || c == '\\') {
      result += '\\';
      result += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      char code[8];
      std::snprintf(code, sizeof code, "\\x%x\\", static_cast<unsigned>(c));
      result += code;
    } else {
      result += c;
    }
  }
  return result + quote;
}

template <class Values, class Text>
std::string list_of(const Values& values, const Text& text) {
  std::string result{"["};
  for (const auto& value : values) {
    if (result.size() > 1) result += ',';
    result += text(value);
  }
  return result + ']';
}

/// Bytes of so many characters of UTF-8 from there on; nullopt: they have not all come.
std::optional<std::size_t> bytes_of(const std::string& text, std::size_t from, std::size_t characters) {
  std::size_t at = from;
  for (; characters > 0; --characters) {
    if (at >= text.size()) return std::nullopt;
    ++at;
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U) ++at;
  }
  // The last one may go on in what comes next.
  if (at > from && at == text.size()) {
    std::size_t first = at - 1;
    while (first > from && (static_cast<unsigned char>(text[first]) & 0xC0U) == 0x80U) --first;
    const auto lead = static_cast<unsigned char>(text[first]);
    const std::size_t length = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    if (first + length > at) return std::nullopt;
  }
  return at - from;
}

Error no_value() { return {"Prolog: what it says is no value"}; }

class Reader {
 public:
  explicit Reader(const std::string& text) : text_{&text} {}

  [[nodiscard]] std::size_t position() const { return at_; }

  [[nodiscard]] Result<std::optional<PrologValue>> value(int depth = 0) {
    if (at_ >= text_->size()) return std::nullopt;
    const char kind = (*text_)[at_++];
    if (kind == 'n') return number();
    if ((kind != 's' && kind != 'l') || depth > kDeepest) return tl::unexpected(no_value());
    const auto size = count();
    if (!size) return tl::unexpected(size.error());
    if (!*size) return std::nullopt;
    return kind == 's' ? string(**size) : list(**size, depth);
  }

 private:
  /// What stands before this mark; nullopt: the mark has not come yet.
  std::optional<std::string> before(char mark) {
    const auto end = text_->find(mark, at_);
    if (end == std::string::npos) return std::nullopt;
    std::string found = text_->substr(at_, end - at_);
    at_ = end + 1;
    return found;
  }
  Result<std::optional<std::size_t>> count() {
    constexpr std::size_t kMostDigits = 9;
    const auto digits = before(':');
    if (!digits && text_->size() - at_ > kMostDigits) return tl::unexpected(no_value());
    if (!digits) return std::nullopt;
    std::size_t found = 0;
    const char* end = digits->data() + digits->size();
    const auto read = std::from_chars(digits->data(), end, found);
    if (digits->size() > kMostDigits || read.ec != std::errc{} || read.ptr != end) return tl::unexpected(no_value());
    return found;
  }
  Result<std::optional<PrologValue>> number() {
    constexpr std::size_t kMostDigits = 400;
    const auto digits = before(';');
    if (!digits && text_->size() - at_ > kMostDigits) return tl::unexpected(no_value());
    if (!digits) return std::nullopt;
    double found = 0.0;
    const char* end = digits->data() + digits->size();
    const auto read = std::from_chars(digits->data(), end, found);
    if (read.ec != std::errc{} || read.ptr != end || !std::isfinite(found)) return tl::unexpected(no_value());
    return PrologValue{found};
  }
  Result<std::optional<PrologValue>> string(std::size_t characters) {
    const auto bytes = bytes_of(*text_, at_, characters);
    if (!bytes) return std::nullopt;
    std::string found = text_->substr(at_, *bytes);
    at_ += *bytes;
    return PrologValue{std::move(found)};
  }
  Result<std::optional<PrologValue>> list(std::size_t count, int depth) {
    std::vector<PrologValue> values;
    for (std::size_t i = 0; i < count; ++i) {
      auto next = value(depth + 1);
      if (!next) return tl::unexpected(next.error());
      if (!*next) return std::nullopt;
      values.push_back(std::move(**next));
    }
    return PrologValue{std::move(values)};
  }

  const std::string* text_;
  std::size_t at_ = 0;
};

std::string number_text(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

}  // namespace

std::string prolog_atom(const std::string& text) { return quoted(text, '\''); }

std::string prolog_string(const std::string& text) { return quoted(text, '"'); }

std::string prolog_number(double value) {
  DOCENT_CHECK(std::isfinite(value));
  std::string text = number_text(value);
  // Prolog wants a point before an exponent, and takes what has none for an integer.
  if (text.find('.') == std::string::npos) text.insert(std::min(text.find('e'), text.size()), ".0");
  return text;
}

std::string prolog_term(const GologTerm& term) {
  std::string text = prolog_atom(term.name);
  if (term.arguments.empty()) return text;
  for (std::size_t i = 0; i < term.arguments.size(); ++i) {
    const auto* word = std::get_if<std::string>(&term.arguments[i]);
    text += (i == 0 ? "(" : ",") +
            (word != nullptr ? prolog_atom(*word) : prolog_number(std::get<double>(term.arguments[i])));
  }
  return text + ")";
}

std::string prolog_atoms(std::span<const std::string> texts) { return list_of(texts, prolog_atom); }

std::string prolog_terms(std::span<const GologTerm> terms) { return list_of(terms, prolog_term); }

const PrologValue* PrologValue::at(std::size_t index) const {
  const auto* values = list();
  return values != nullptr && index < values->size() ? &(*values)[index] : nullptr;
}

Result<std::optional<PrologValue>> take_value(std::string& read) {
  Reader reader{read};
  auto value = reader.value();
  if (value && *value) read.erase(0, reader.position());
  return value;
}

std::vector<std::string> texts_of(const PrologValue& value) {
  std::vector<std::string> texts;
  if (value.list() == nullptr) return texts;
  for (const PrologValue& item : *value.list()) {
    if (item.text() != nullptr) texts.push_back(*item.text());
    if (item.number() != nullptr) texts.push_back(number_text(*item.number()));
  }
  return texts;
}

Result<GologTerm> term_of(const PrologValue& value) {
  const PrologValue* name = value.at(0);
  if (name == nullptr || name->text() == nullptr) return fail("an action has no name");
  GologTerm term{*name->text()};
  for (std::size_t i = 1; i < value.list()->size(); ++i) {
    const PrologValue& argument = *value.at(i);
    if (argument.number() != nullptr) {
      term.arguments.emplace_back(*argument.number());
    } else if (argument.text() != nullptr) {
      term.arguments.emplace_back(*argument.text());
    } else {
      return fail(term.name + ": argument " + std::to_string(i) + " is neither a name nor a number");
    }
  }
  return term;
}

Result<std::vector<GologTerm>> terms_of(const PrologValue& value) {
  std::vector<GologTerm> terms;
  if (value.list() == nullptr) return fail("Prolog: a list is missing");
  for (const PrologValue& item : *value.list()) {
    auto term = term_of(item);
    if (!term) return tl::unexpected(term.error());
    terms.push_back(std::move(*term));
  }
  return terms;
}

}  // namespace docent::task_control
