#include "docent/telepresence/store/salvage/private_files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <string>

namespace docent::telepresence {
namespace {

tl::unexpected<Error> cannot(const std::filesystem::path& path, const char* what, int why) {
  return fail(path.string() + ": cannot be " + what + ": " + (why == ENOSPC ? "the disk is full" : std::strerror(why)));
}

std::string formatted(std::int64_t seconds, const char* format) {
  const std::time_t time = seconds;
  std::tm parts{};
  ::gmtime_r(&time, &parts);
  char text[64];
  return {text, std::strftime(text, sizeof text, format, &parts)};
}

}  // namespace

Result<void> write_private_file(const std::filesystem::path& file, std::string_view content) {
  const std::filesystem::path beside = file.string() + ".part" + std::to_string(::getpid());
  const int opened = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (opened < 0) return cannot(file, "written", errno);
  int why = 0;
  while (!content.empty() && why == 0) {
    const ::ssize_t written = ::write(opened, content.data(), content.size());
    if (written < 0 && errno != EINTR) why = errno;
    if (written > 0) content.remove_prefix(static_cast<std::size_t>(written));
  }
  if (why == 0 && ::fsync(opened) != 0) why = errno;
  ::close(opened);
  make_private(beside);
  if (why == 0) {
    if (auto renamed = rename_for_good(beside, file); renamed) return {};
    why = errno;
  }
  ::unlink(beside.c_str());
  return cannot(file, "written", why);
}

void make_private(const std::filesystem::path& path) {
  struct stat found {};
  struct stat folder {};
  const auto around = path.parent_path();
  if (::stat(path.c_str(), &found) != 0 || ::stat(around.empty() ? "." : around.c_str(), &folder) != 0) return;
  if (::chmod(path.c_str(), S_ISDIR(found.st_mode) ? 0700 : 0600) != 0) return;
  if (::geteuid() == 0 && found.st_uid != folder.st_uid && ::chown(path.c_str(), folder.st_uid, folder.st_gid) != 0)
    return;
}

Result<void> sync_to_disk(const std::filesystem::path& path) {
  const int opened = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (opened < 0) return cannot(path, "opened", errno);
  const int why = ::fsync(opened) == 0 ? 0 : errno;
  ::close(opened);
  if (why != 0) return cannot(path, "written", why);
  return {};
}

Result<void> rename_for_good(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (::rename(from.c_str(), to.c_str()) != 0) return cannot(to, "written", errno);
  const auto folder = to.parent_path();
  return sync_to_disk(folder.empty() ? "." : folder);
}

std::filesystem::path dated_name(const std::filesystem::path& beside, const std::string& why) {
  const std::string name = beside.string() + "." + why + "-" + formatted(seconds_now(), "%Y%m%dT%H%M%SZ");
  std::filesystem::path free = name;
  std::error_code ignored;
  for (int i = 2; std::filesystem::exists(free, ignored) || std::filesystem::exists(free.string() + "-wal", ignored);
       ++i)
    free = name + "-" + std::to_string(i);
  return free;
}

std::int64_t seconds_now() {
  return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch()).count();
}

std::string date_and_time(std::int64_t seconds) { return formatted(seconds, "%Y-%m-%d %H:%M:%S UTC"); }

}  // namespace docent::telepresence
