#include "docent/base/shipped_files.h"

#include <system_error>

namespace docent {

std::filesystem::path program_path() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error);
}

std::filesystem::path shipped_path(const std::filesystem::path& name) {
  return shipped_path(name, program_path(), DOCENT_SOURCES);
}

std::filesystem::path shipped_path(const std::filesystem::path& name, const std::filesystem::path& program,
                                   const std::filesystem::path& sources) {
  std::error_code error;
  auto installed = program.parent_path().parent_path() / "share/docent" / name;
  return std::filesystem::exists(installed, error) ? installed : sources / name;
}

}  // namespace docent
