#include "docent/simulator/museum_folder/made_files.h"

#include <array>
#include <cstdio>
#include <sstream>

#include "docent/base/files.h"
#include "docent/base/random.h"

namespace docent::simulator {

namespace {

constexpr const char* kList = ".made-by-docent";

Result<std::string> hash_of_file(const std::filesystem::path& path) {
  auto content = read_file(path);
  if (!content) return tl::unexpected<Error>(content.error());
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash_of(*content)));
  return std::string{text.data()};
}

}  // namespace

Result<MadeFiles> MadeFiles::in(const std::filesystem::path& folder) {
  MadeFiles made{folder};
  if (!std::filesystem::exists(folder / kList)) return made;
  auto list = read_file(folder / kList);
  if (!list) return tl::unexpected<Error>(list.error());
  std::istringstream lines{*list};
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const auto space = line.find(' ');
    if (space != 16) return fail((folder / kList).string() + ":" + std::to_string(number) + ": expected HASH NAME");
    made.hashes_[line.substr(space + 1)] = line.substr(0, space);
  }
  return made;
}

Result<void> MadeFiles::check(const std::vector<std::string>& names) const {
  for (const std::string& name : names) {
    const auto path = folder_ / name;
    if (!std::filesystem::exists(path)) continue;
    const auto made = hashes_.find(name);
    const auto now = hash_of_file(path);
    if (!now) return tl::unexpected<Error>(now.error());
    if (made == hashes_.end())
      return fail(path.string() + ": was not made by this command and is not replaced; name another folder");
    if (*now != made->second)
      return fail(path.string() + ": was edited since it was made and is not replaced; name another folder");
  }
  return {};
}

Result<void> MadeFiles::note(const std::vector<std::string>& names) const {
  std::string list;
  for (const std::string& name : names) {
    const auto hash = hash_of_file(folder_ / name);
    if (!hash) return tl::unexpected<Error>(hash.error());
    list += *hash + " " + name + "\n";
  }
  return write_file_atomically(folder_ / kList, list);
}

}  // namespace docent::simulator
