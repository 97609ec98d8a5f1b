#pragma once

#include <filesystem>

#include "docent/base/result.h"

namespace docent {

/// Where what is written to a path goes. Links are followed, also one whose file does not exist yet.
struct Destination {
  std::filesystem::path path;  ///< no link
  /// A device, a pipe, or what this process has open (/dev/stdout): written into, it stays what it is. Anything else is
  /// written beside and then renamed to `path`.
  bool is_stream = false;
  int descriptor = -1;  ///< of this process, where `path` names one: /proc/self/fd/N
};

/// Error: "PATH: cannot be written: why" for a socket, and for links that lead round in a circle.
[[nodiscard]] Result<Destination> destination_of(const std::filesystem::path& path);

/// A stream for writing, or else a new empty file `beside` it. Waits for the reader of a pipe.
/// @returns a descriptor of its own, to be closed; -1: errno says why not
[[nodiscard]] int open_destination(const Destination& destination, const std::filesystem::path& beside);

/// Whether whoever writes to the one loses what was written to the other. Streams take from many.
[[nodiscard]] bool replace_each_other(const std::filesystem::path& one, const std::filesystem::path& other);

}  // namespace docent
