#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace docent {

/// Why something could not be done, in one line for a person. Faults of a file begin with "FILE:LINE: ".
struct Error {
  std::string message;  ///< the line
};

/// What a caller can handle: files, network, no path. Promises that we broke ourselves are DOCENT_CHECK.
template <class T>
using Result = tl::expected<T, Error>;

/// A Result that is this Error.
[[nodiscard]] inline tl::unexpected<Error> fail(std::string message) {
  return tl::unexpected<Error>(Error{std::move(message)});
}

}  // namespace docent
