#include "docent/apps/shared/cache_folder.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "docent/apps/shared/log.h"

namespace docent::apps {

std::string default_cache() {
  if (const char* own = std::getenv("DOCENT_CACHE"); own != nullptr) return own;
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && *cache != '\0') return std::string{cache} + "/docent";
  const char* home = std::getenv("HOME");
  return home != nullptr && *home != '\0' ? std::string{home} + "/.cache/docent" : "";
}

void add_cache_options(CLI::App& command, std::string& folder) {
  folder = default_cache();
  CLI::Option* const where =
      command
          .add_option(
              "--cache", folder,
              "Folder for what can be made anew, above all the ranges that the lasers expect in a map; any number "
              "of programs may share it")
          ->capture_default_str();
  command
      .add_flag_callback(
          "--no-cache", [&folder] { folder.clear(); }, "Keep nothing, and use nothing that was kept")
      ->excludes(where);
}

void prepare_cache(const std::string& folder) {
  if (folder.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  std::string why;
  if (error) {
    why = error.message();
  } else if (!std::filesystem::is_directory(folder, error)) {
    why = "is not a folder";
  } else if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    why = std::strerror(errno);
  }
  if (!why.empty()) log_to_stderr(LogLevel::warning, "docent", "--cache " + folder + ": " + why + "; nothing is kept");
}

}  // namespace docent::apps
