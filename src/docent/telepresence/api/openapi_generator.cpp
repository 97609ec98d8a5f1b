// Writes docs/openapi.json.
//
//   docent_openapi FILE
#include <cstdio>

#include "docent/base/files.h"
#include "docent/telepresence/api/openapi.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s FILE\n", argv[0]);
    return 2;
  }
  const auto written =
      docent::write_file_atomically(argv[1], docent::telepresence::openapi_of(docent::telepresence::endpoints()));
  if (!written) std::fprintf(stderr, "%s\n", written.error().message.c_str());
  return written ? 0 : 1;
}
