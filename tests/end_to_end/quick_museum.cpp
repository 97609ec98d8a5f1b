#include "quick_museum.h"

#include <fstream>

namespace docent {

std::string with_short_texts(const std::filesystem::path& museum, const std::filesystem::path& folder) {
  std::filesystem::copy(museum, folder, std::filesystem::copy_options::recursive);
  for (const auto& entry : std::filesystem::directory_iterator{folder / "content"}) {
    if (entry.path().extension() == ".md") {
      std::ofstream{entry.path()}
          << "Here stands something that is worth a look. Many people have worked on it for years.\n";
    }
  }
  return folder;
}

}  // namespace docent
