#include "docent/base/destination.h"

#include <fcntl.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <string>
#include <system_error>

namespace docent {

namespace fs = std::filesystem;

namespace {

constexpr int kMostLinks = 40;  // as Linux has it

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path{"."}; }

/// N of /proc/self/fd/N, however its folder is called; -1: something else. What these links lead to must not be
/// replaced under its name: whoever else has it open would write to what is gone.
int own_descriptor(const fs::path& link) {
  std::error_code code;
  const fs::path folder = fs::canonical(folder_of(link), code);
  if (code || folder != fs::canonical("/proc/self/fd", code) || code) return -1;
  const std::string name = link.filename().string();
  int number = -1;
  const auto [end, fault] = std::from_chars(name.data(), name.data() + name.size(), number);
  return fault == std::errc{} && end == name.data() + name.size() ? number : -1;
}

tl::unexpected<Error> cannot(const fs::path& path, const std::string& why) {
  return fail(path.string() + ": cannot be written: " + why);
}

}  // namespace

Result<Destination> destination_of(const fs::path& path) {
  Destination at;
  at.path = path;
  std::error_code code;
  fs::file_type type = fs::symlink_status(path, code).type();
  for (int links = 1; type == fs::file_type::symlink; ++links) {
    if (links > kMostLinks) return cannot(path, std::strerror(ELOOP));
    at.descriptor = own_descriptor(at.path);
    at.is_stream = at.descriptor >= 0;
    if (at.is_stream) return at;
    const fs::path target = fs::read_symlink(at.path, code);
    if (code) return cannot(path, code.message());
    at.path = at.path.parent_path() / target;
    type = fs::symlink_status(at.path, code).type();
  }
  if (type == fs::file_type::socket) return cannot(path, "it is a socket");
  at.is_stream = type == fs::file_type::fifo || type == fs::file_type::character || type == fs::file_type::block;
  return at;
}

int open_destination(const Destination& destination, const fs::path& beside) {
  if (destination.descriptor >= 0) return ::fcntl(destination.descriptor, F_DUPFD_CLOEXEC, 0);
  if (destination.is_stream) return ::open(destination.path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
  return ::open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
}

bool replace_each_other(const fs::path& one, const fs::path& other) {
  const auto a = destination_of(one);
  const auto b = destination_of(other);
  if (!a || !b || a->is_stream || b->is_stream) return false;
  // Of the folders alone: a file that is there with two names is replaced under one of them.
  std::error_code code;
  const auto whole = [&](const fs::path& path) {
    return fs::weakly_canonical(folder_of(path), code) / path.filename();
  };
  return whole(a->path) == whole(b->path) && !code;
}

}  // namespace docent
