#include "docent/base/files.h"

#include <unistd.h>
#include <zlib.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>

#include "docent/base/destination.h"

namespace docent {

Result<std::string> read_file(const std::filesystem::path& path) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code)) return fail(path.string() + ": cannot be read: it is a directory");
  std::ifstream stream{path, std::ios::binary};
  if (!stream) return fail(path.string() + ": cannot be read: " + std::strerror(errno));
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

Result<void> write_file_atomically(const std::filesystem::path& path, std::string_view content, Survives survives) {
  const auto to = destination_of(path);
  if (!to) return tl::unexpected<Error>(to.error());
  const std::string beside = to->path.string() + ".part" + std::to_string(::getpid());
  const int file = open_destination(*to, beside);
  if (file < 0) return fail(path.string() + ": cannot be written: " + std::strerror(errno));
  std::string reason;
  while (!content.empty() && reason.empty()) {
    const ::ssize_t written = ::write(file, content.data(), content.size());
    if (written < 0 && errno != EINTR) reason = std::strerror(errno);
    if (written > 0) content.remove_prefix(static_cast<std::size_t>(written));
  }
  const bool is_synced = survives == Survives::power_failure && !to->is_stream;
  if (reason.empty() && is_synced && ::fsync(file) != 0) reason = std::strerror(errno);
  ::close(file);
  if (reason.empty() && !to->is_stream && ::rename(beside.c_str(), to->path.c_str()) != 0)
    reason = std::strerror(errno);
  if (reason.empty()) return {};
  if (!to->is_stream) ::unlink(beside.c_str());
  return fail(path.string() + ": cannot be written: " + reason);
}

Result<std::string> read_maybe_gzipped(const std::filesystem::path& path, std::size_t limit) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code)) return fail(path.string() + ": cannot be read: it is a directory");
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file{gzopen(path.c_str(), "rb"), &gzclose};
  if (!file) return fail(path.string() + ": cannot be read: " + std::strerror(errno));
  std::string content;
  std::array<char, 1U << 16U> buffer{};
  while (true) {
    const int count = gzread(file.get(), buffer.data(), static_cast<unsigned>(buffer.size()));
    if (count < 0) {
      int number = 0;
      return fail(path.string() + ": damaged gzip stream: " + gzerror(file.get(), &number));
    }
    if (count == 0) break;
    content.append(buffer.data(), static_cast<std::size_t>(count));
    if (content.size() > limit) return fail(path.string() + ": larger than " + std::to_string(limit) + " bytes");
  }
  int number = Z_OK;
  const char* message = gzerror(file.get(), &number);
  if (number != Z_OK && number != Z_STREAM_END) return fail(path.string() + ": damaged gzip stream: " + message);
  return content;
}

}  // namespace docent
