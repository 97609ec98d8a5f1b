#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <span>

#include "docent/modules/host/registry.h"
#include "module_stage.h"

// The input: which module, then one message after the other: its topic, how many hundredths of a second go by before
// it, and either a seed and how much of the message is spoiled by it, or the message's own bytes.

namespace {

struct StateFolder {
  StateFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "docent-fuzz-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) std::abort();
    path = name;
  }
  ~StateFolder() { std::filesystem::remove_all(path); }
  std::filesystem::path path;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const StateFolder folder;
  if (size < 1) return 0;
  const auto modules = docent::modules::all_modules();
  const std::string module = modules[data[0] % modules.size()].name;
  if (module == "web") return 0;  // it listens on a port, in threads of its own
  std::filesystem::remove_all(folder.path);
  std::filesystem::create_directories(folder.path);
  docent::ModuleStage stage{module, folder.path};
  std::size_t at = 1;
  for (int messages = 0; messages < 60 && at + 5 <= size; ++messages) {
    const std::size_t topic = data[at] % docent::ModuleStage::topics();
    stage.run(0.01 * data[at + 1]);
    const std::uint8_t kind = data[at + 2];
    std::uint16_t number = 0;
    std::memcpy(&number, data + at + 3, sizeof number);
    at += 5;
    if (kind < 128) {
      docent::Rng rng{number};
      stage.publish(topic, rng, kind / 255.0);
    } else {
      const std::size_t length = std::min<std::size_t>(number % 2048, size - at);
      stage.publish(topic, std::span{data + at, length});
      at += length;
    }
  }
  stage.run(1.0);
  if (!stage.unfit_output().empty()) std::abort();
  return 0;
}
