#pragma once

#include <filesystem>

namespace docent {

/// The program that is running.
[[nodiscard]] std::filesystem::path program_path();

/// Where something lies that comes with the program; `name` is its path in the tree of the sources ("museums/bonn").
/// The program is installed as PREFIX/bin/docent: PREFIX/share/docent/NAME where that exists, so that the whole prefix
/// may be moved; else the tree of the sources from which the program was built.
[[nodiscard]] std::filesystem::path shipped_path(const std::filesystem::path& name);
/// The same for any program and any tree of sources.
[[nodiscard]] std::filesystem::path shipped_path(const std::filesystem::path& name,
                                                 const std::filesystem::path& program,
                                                 const std::filesystem::path& sources);

}  // namespace docent
