#pragma once

#include <string>

#include "docent/base/result.h"

namespace CLI {
class App;
}

namespace docent::apps {

/// Thrown by a command's callback, caught in main: prints "docent: MESSAGE" on one line and exits with the code.
struct CommandFailed {
  std::string message;
  int exit_code = 1;
};

/// The value, or CommandFailed.
template <class T>
T value_or_fail(Result<T> result, int exit_code = 1) {
  if (!result) throw CommandFailed{result.error().message, exit_code};
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

}  // namespace docent::apps
