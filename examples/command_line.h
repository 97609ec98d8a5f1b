#pragma once
// The one argument that each example takes.
#include <cstdio>
#include <cstdlib>
#include <string>

namespace example {

/// The argument, which is called `name`, or `otherwise` without one. Else the end of the program, with its usage.
inline std::string argument_or_exit(int argc, char** argv, const char* name, const char* otherwise) {
  if (argc == 1) return otherwise;
  if (argc == 2 && argv[1][0] != '-' && argv[1][0] != '\0') return argv[1];
  std::fprintf(stderr, "usage: %s [%s]\n", argv[0], name);
  std::exit(2);
}

}  // namespace example
