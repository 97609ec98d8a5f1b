#include <iostream>

#include "docent/base/files.h"
#include "docent/telepresence/contract/contract.h"

// Writes web/src/contract/contract.ts and tests/web_contract/server: `docent_web_contract SOURCES`.

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: docent_web_contract SOURCES\n";
    return 2;
  }
  const std::filesystem::path root = argv[1];
  auto written =
      docent::write_file_atomically(root / "web/src/contract/contract.ts", docent::telepresence::contract_types());
  for (const auto& [name, text] : docent::telepresence::contract_samples()) {
    if (written) written = docent::write_file_atomically(root / "tests/web_contract/server" / name, text + "\n");
  }
  if (!written) std::cerr << written.error().message << '\n';
  return written ? 0 : 1;
}
