#include "docent/recording/gzip_text.h"

#include <zlib.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <initializer_list>
#include <memory>
#include <utility>

namespace docent::recording {

Result<GzipText> read_gzip_text(const std::filesystem::path& path) {
  constexpr std::size_t kMost = std::size_t{4} << 30U;
  std::error_code code;
  if (std::filesystem::is_directory(path, code)) return fail(path.string() + ": cannot be read: it is a directory");
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file{gzopen(path.c_str(), "rb"), &gzclose};
  if (!file) return fail(path.string() + ": cannot be read: " + std::strerror(errno));
  GzipText text;
  std::array<char, 1U << 14U> buffer{};  // where the stream is damaged, what came so far of one is lost
  int count = 0;
  while ((count = gzread(file.get(), buffer.data(), static_cast<unsigned>(buffer.size()))) > 0) {
    text.content.append(buffer.data(), static_cast<std::size_t>(count));
    if (text.content.size() > kMost) return fail(path.string() + ": larger than " + std::to_string(kMost) + " bytes");
  }
  int number = Z_OK;
  const char* message = gzerror(file.get(), &number);
  if (number == Z_BUF_ERROR)
    text.fault = path.string() + ": the gzip stream ends early";
  else if (count < 0 || (number != Z_OK && number != Z_STREAM_END))
    text.fault = path.string() + ": damaged gzip stream: " + message;
  return text;
}

std::string other_kind_of(std::string_view content) {
  constexpr std::size_t kTarMagicAt = 257;
  for (const auto& [magic, kind] : std::initializer_list<std::pair<std::string_view, const char*>>{
           {"\x89MCAP0", "an MCAP recording that is gzipped"},
           {"SQLite format 3", "a rosbag2 database that is gzipped"},
           {"#ROSBAG V", "a bag of ROS 1 that is gzipped"},
           {"#ROSRECORD V", "a bag of ROS 1 that is gzipped"},
           {"\x1f\x8b", "a file that is gzipped twice"},
           {"PK\x03\x04", "an archive (zip)"},
           {"7z\xbc\xaf\x27\x1c", "an archive (7z)"},
           {"\xfd\x37zXZ", "a file that is packed with xz"},
           {"BZh", "a file that is packed with bzip2"}})
    if (content.starts_with(magic)) return std::string{kind} + ": unpack it first";
  if (content.size() > kTarMagicAt && content.substr(kTarMagicAt).starts_with("ustar"))
    return "an archive (tar): unpack it first";
  return {};
}

}  // namespace docent::recording
