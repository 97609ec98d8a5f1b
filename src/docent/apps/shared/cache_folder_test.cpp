#include "docent/apps/shared/cache_folder.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "docent/apps/shared/temporary_folder.h"

namespace docent::apps {
namespace {

/// Sets or unsets a variable of the environment for as long as it lives.
class Variable {
 public:
  Variable(const char* name, const std::optional<std::string>& value) : name_{name} {
    if (const char* before = std::getenv(name); before != nullptr) before_ = before;
    set(value);
  }
  ~Variable() { set(before_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  void set(const std::optional<std::string>& value) {
    if (value) {
      ::setenv(name_, value->c_str(), 1);
    } else {
      ::unsetenv(name_);
    }
  }
  const char* name_;
  std::optional<std::string> before_;
};

TEST(CacheFolder, IsWhereTheEnvironmentSays) {
  const Variable home{"HOME", "/home/somebody"};
  {
    const Variable own{"DOCENT_CACHE", std::nullopt};
    {
      const Variable xdg{"XDG_CACHE_HOME", "/fast"};
      EXPECT_EQ(default_cache(), "/fast/docent");
    }
    const Variable xdg{"XDG_CACHE_HOME", std::nullopt};
    EXPECT_EQ(default_cache(), "/home/somebody/.cache/docent");
    const Variable homeless{"HOME", std::nullopt};
    EXPECT_EQ(default_cache(), "") << "a folder that all share is no place";
  }
  {
    const Variable own{"DOCENT_CACHE", "/mine"};
    EXPECT_EQ(default_cache(), "/mine");
  }
  const Variable own{"DOCENT_CACHE", ""};
  EXPECT_EQ(default_cache(), "");
}

std::string cache_of(const std::string& arguments) {
  const Variable own{"DOCENT_CACHE", "/mine"};
  CLI::App app;
  std::string folder;
  add_cache_options(app, folder);
  app.parse(arguments);
  return folder;
}

TEST(CacheFolder, OptionsSayOtherwise) {
  EXPECT_EQ(cache_of(""), "/mine");
  EXPECT_EQ(cache_of("--cache /other"), "/other");
  EXPECT_EQ(cache_of("--no-cache"), "");
  EXPECT_THROW(cache_of("--no-cache --cache /other"), CLI::ParseError);
}

TEST(CacheFolder, OneThatCannotBeWrittenCostsALineOfTheLog) {
  const auto log_of = [](const std::string& folder) {
    ::testing::internal::CaptureStderr();
    prepare_cache(folder);
    return ::testing::internal::GetCapturedStderr();
  };
  const TemporaryFolder temporary;
  const std::string made = (temporary.path() / "a/b").string();
  EXPECT_EQ(log_of(made), "");
  EXPECT_TRUE(std::filesystem::is_directory(made));
  EXPECT_EQ(log_of(""), "");
  const std::string line = log_of("/proc/docent");
  EXPECT_NE(line.find(" warning docent: --cache /proc/docent: "), std::string::npos) << line;
  EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1);
}

}  // namespace
}  // namespace docent::apps
