#include "docent/apps/simulation_run.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>

#include "docent/base/files.h"
#include "docent/base/random.h"
#include "docent/evaluation/deployment_report.h"
#include "docent/messages/conversions.h"
#include "docent/pictures/colors.h"
#include "docent/pictures/drawing.h"
#include "docent/pictures/map_picture.h"
#include "docent/recording/recorder.h"
#include "docent/simulator/simulated_museum.h"
#include "docent/simulator/world/world.h"

namespace docent {
namespace {

/// A folder of its own that goes when the run goes.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "docent-XXXXXX").string();
    if (::mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code code;
    if (!path_.empty()) std::filesystem::remove_all(path_, code);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace
}  // namespace docent
