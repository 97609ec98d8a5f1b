#include "docent/apps/shared/program.h"

#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <sstream>

#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/base/suggestion.h"

namespace docent::apps {

namespace {

std::string plain_word(const std::string& word) {
  if (word == "FLOAT") return "NUMBER";
  if (word == "INT" || word == "UINT") return "WHOLE NUMBER";
  return word;
}

/// Help as CLI11 writes it, but for the types.
class PlainHelp final : public CLI::Formatter {
 public:
  [[nodiscard]] std::string make_option_opts(const CLI::Option* option) const override {
    std::string text = CLI::Formatter::make_option_opts(option);
    const std::string type = option->get_type_name();
    if (type.empty() || !text.starts_with(" " + type)) return text;
    std::string rest = text.substr(1 + type.size());
    if (const std::string value = option->get_default_str(); !value.empty() && rest.starts_with("=" + value))
      rest = " (without: " + value + ")" + rest.substr(1 + value.size());
    return " " + plain_type(type) + rest;
  }
};

void add_commands(const Program& program, CLI::App& app) {
  for (const CommandGroup& group : program.groups) {
    const std::size_t before = app.get_subcommands({}).size();
    for (const auto& command : group.commands) command(app);
    const std::vector<CLI::App*> all = app.get_subcommands({});
    for (std::size_t i = before; i < all.size(); ++i) all[i]->group(group.heading);
  }
}

std::vector<std::string> names_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// An example at the end of each command's help, and of each of its parts.
void show_examples(const Program& program, CLI::App& app, const std::string& path) {
  for (CLI::App* command : app.get_subcommands({})) {
    const std::string name = path.empty() ? command->get_name() : path + " " + command->get_name();
    const auto example = program.examples.find(name);
    if (example != program.examples.end()) {
      const std::string before = command->get_footer();
      command->footer((before.empty() ? "" : before + "\n\n") + "Example:\n  " + program.name + " " + example->second);
    }
    show_examples(program, *command, name);
  }
}

/// Which word of a list was meant, where CLI11 says "busi not in {empty,quiet,busy,packed}".
std::string meant_by(const std::string& reason) {
  const auto at = reason.find(" not in {");
  const auto end = reason.find('}', at == std::string::npos ? 0 : at);
  if (at == std::string::npos || end == std::string::npos) return {};
  const auto begin = reason.rfind(' ', at - 1);
  const std::string word = reason.substr(begin == std::string::npos ? 0 : begin + 1, at - (begin + 1));
  std::vector<std::string> known;
  std::stringstream list{reason.substr(at + 9, end - at - 9)};
  for (std::string one; std::getline(list, one, ',');) known.push_back(one);
  return did_you_mean(word, known);
}

/// What is wrong with arguments that CLI11 refused for `reason`.
std::string fault_of(const Program& program, const CLI::App& app, int argc, const char* const* argv,
                     const std::string& reason) {
  const std::string command = argc > 1 ? argv[1] : "";
  const std::vector<std::string> names = names_of(app);
  if (command.empty() || command.front() == '-' || std::find(names.begin(), names.end(), command) != names.end())
    return reason + meant_by(reason) + " (try --help)";
  if (std::find(program.others.begin(), program.others.end(), command) != program.others.end())
    return "'" + command + "' is a command of " + program.other;
  return "unknown command '" + command + "'" + did_you_mean(command, names) + " (try --help)";
}

}  // namespace

std::string plain_type(const std::string& type) {
  const auto colon = type.find(':');
  if (colon == std::string::npos) return plain_word(type);
  const std::string word = plain_word(type.substr(0, colon));
  std::string tail = type.substr(colon + 1);
  if (tail == "POSITIVE") return word + " above 0";
  if (tail.starts_with("{") && tail.ends_with("}")) {
    std::string text = "ONE OF ";
    for (const char letter : tail.substr(1, tail.size() - 2))
      text += letter == ',' ? std::string{", "} : std::string{letter};
    return text;
  }
  const auto open = tail.find(" in [");
  const auto dash = tail.find(" - ", open == std::string::npos ? 0 : open);
  if (open != std::string::npos && dash != std::string::npos && tail.ends_with("]"))
    return word + " from " + tail.substr(open + 5, dash - open - 5) + " to " +
           tail.substr(dash + 3, tail.size() - dash - 4);
  return tail;
}

std::vector<std::string> names_of_commands(const Program& program) {
  CLI::App app;
  add_commands(program, app);
  return names_of(app);
}

namespace {

/// What a full disk did not take of the output would otherwise be missing without a word: `docent config > robot.yaml`.
/// A reader at the other end of a pipe may leave when it has what it wants: `docent up | grep -q open`.
bool is_all_said(const char* name) {
  struct stat out {};
  if (::fstat(STDOUT_FILENO, &out) == 0 && (S_ISFIFO(out.st_mode) || S_ISSOCK(out.st_mode))) return true;
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return true;
  std::fprintf(stderr, "%s: the output cannot be written%s%s\n", name, errno != 0 ? ": " : "",
               errno != 0 ? std::strerror(errno) : "");
  return false;
}

}  // namespace

int run(const Program& program, int argc, const char* const* argv) {
  CLI::App app{program.meaning, program.name};
  app.require_subcommand(1);
  app.set_version_flag("--version", program.name + " " + program.version);
  app.formatter(std::make_shared<PlainHelp>());  // before the commands, which take it over
  add_commands(program, app);
  show_examples(program, app, "");
  app.parse_complete_callback([&app] {
    refuse_odd_numbers(app);
    refuse_shared_outputs(app);
  });  // before the command runs
  const char* name = program.name.c_str();
  try {
    app.parse(argc, argv);
    return is_all_said(name) ? 0 : 1;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    std::fprintf(stderr, "%s: %s\n", name, fault_of(program, app, argc, argv, error.what()).c_str());
    return 2;
  } catch (const CommandFailed& failure) {
    if (!failure.message.empty()) std::fprintf(stderr, "%s: %s\n", name, failure.message.c_str());
    return failure.exit_code;
  } catch (const std::exception& exception) {
    std::fprintf(stderr, "%s: %s\n", name, exception.what());
    return 1;
  }
}

}  // namespace docent::apps
