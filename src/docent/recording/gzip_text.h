#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "docent/base/result.h"

namespace docent::recording {

/// What a gzip file holds, as far as it goes.
struct GzipText {
  std::string content;
  std::string fault;  ///< "FILE: why": it ends there because it is cut or damaged; empty: it is whole
};
/// Content of a gzip file, or of a plain one as it is. Error: "FILE: …": unreadable, or larger than 4 GiB.
[[nodiscard]] Result<GzipText> read_gzip_text(const std::filesystem::path& path);

/// What a text is that should be a log and begins as something else does, and what to do with it; empty: nobody knows.
[[nodiscard]] std::string other_kind_of(std::string_view content);

}  // namespace docent::recording
