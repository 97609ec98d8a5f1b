#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace docent::apps {

/// Commands under one heading of `--help`, in its order.
struct CommandGroup {
  std::string heading;
  std::vector<std::function<void(CLI::App&)>> commands;  ///< each adds its own to the program
};

/// A program with commands: `docent`, `docent-lab`.
struct Program {
  std::string name;     ///< as it is typed
  std::string meaning;  ///< one line
  std::string version;
  std::vector<CommandGroup> groups;  ///< by what somebody wants
  std::string other;                 ///< a program beside it, and
  std::vector<std::string> others;   ///< commands that only that one has
  /// A call for each command, and for each part of one ("state check"), without the program's name: shown by --help.
  std::map<std::string, std::string> examples{};
};

/// What may be given to an option, in plain words: "NUMBER from 0 to 1" for CLI11's "FLOAT:FLOAT in [0 - 1]".
[[nodiscard]] std::string plain_type(const std::string& type);
/// The names of its commands, in the order of its groups.
[[nodiscard]] std::vector<std::string> names_of_commands(const Program& program);

/// Runs the command that the arguments name. @returns the exit code: 0, 1 for a command that failed, 2 for arguments
/// that cannot be; whatever is wrong is one line on stderr.
[[nodiscard]] int run(const Program& program, int argc, const char* const* argv);

}  // namespace docent::apps
