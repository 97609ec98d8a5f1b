#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "docent/base/result.h"

namespace docent::interaction {

/// Starts a program without a shell: `input` is its standard input, its output is thrown away. The first argument is
/// the program, sought in PATH. Error: "PROGRAM: why". The caller waits for the child.
[[nodiscard]] Result<pid_t> start_quietly(const std::vector<std::string>& arguments,
                                          const std::filesystem::path& input = "/dev/null");

}  // namespace docent::interaction
