#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <new>
#include <string>

#include "odd_machine.h"

namespace docent {

OddMachine& on_odd_machine(char** arguments) {
  const char* known = std::getenv(OddMachine::kVariable);
  const bool is_new = known == nullptr;
  std::string path = is_new ? (std::filesystem::temp_directory_path() / "odd-machine-XXXXXX").string() : known;
  const int file = is_new ? mkstemp(path.data()) : open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0 || (is_new && ftruncate(file, sizeof(OddMachine)) != 0)) std::abort();
  if (is_new) {
    setenv(OddMachine::kVariable, path.c_str(), 1);
    setenv("LD_PRELOAD", DOCENT_ODD_MACHINE_LIBRARY, 1);
    execv("/proc/self/exe", arguments);
    std::abort();
  }
  void* const place = mmap(nullptr, sizeof(OddMachine), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  if (place == MAP_FAILED) std::abort();
  static const struct Remover {
    std::string path;
    ~Remover() { unlink(path.c_str()); }
  } remover{path};
  return *new (place) OddMachine;
}

}  // namespace docent
