#pragma once

#include <string>
#include <string_view>

namespace docent::museum {

/// True for a two-letter code of ISO 639-1, such as "en".
[[nodiscard]] bool is_language(std::string_view code);

/// True when the bytes are well-formed UTF-8 (overlong forms and surrogates are not looked for).
[[nodiscard]] bool is_utf8(std::string_view text);

}  // namespace docent::museum
