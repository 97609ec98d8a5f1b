#include "docent/telepresence/server/screen_key.h"

#include <fcntl.h>
#include <sys/random.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <system_error>

#include "docent/base/files.h"

namespace docent::telepresence {
namespace {

constexpr std::size_t kBytes = 16;

bool is_key(const std::string& text) {
  return text.size() == 2 * kBytes &&
         std::all_of(text.begin(), text.end(), [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

tl::unexpected<Error> fault(const std::filesystem::path& file) {
  return fail(file.string() + ": " + std::generic_category().message(errno));
}

}  // namespace

Result<std::string> screen_key(const std::filesystem::path& file) {
  if (auto kept = read_file(file)) {
    kept->erase(std::find(kept->begin(), kept->end(), '\n'), kept->end());
    if (is_key(*kept)) return *kept;
  }
  std::array<std::uint8_t, kBytes> chance{};
  if (::getrandom(chance.data(), chance.size(), 0) != static_cast<ssize_t>(chance.size())) return fault(file);
  constexpr const char* kDigits = "0123456789abcdef";
  std::string key;
  for (const std::uint8_t byte : chance) {
    key += kDigits[byte >> 4U];
    key += kDigits[byte & 15U];
  }
  std::error_code ignored;
  std::filesystem::remove(file, ignored);  // so that its permissions are ours
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0) return fault(file);
  const std::string line = key + "\n";
  const bool is_written = ::write(descriptor, line.data(), line.size()) == static_cast<ssize_t>(line.size());
  if (::close(descriptor) != 0 || !is_written) return fault(file);
  return key;
}

}  // namespace docent::telepresence
