#include "docent/apps/shared/arguments.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <vector>

#include "docent/apps/shared/command.h"
#include "docent/base/destination.h"
#include "docent/pictures/figure.h"

namespace docent::apps {

namespace {

std::vector<double> parse_numbers(const std::string& option, const std::string& text, std::size_t count,
                                  const std::string& form) {
  std::vector<double> numbers;
  const char* at = text.c_str();
  bool good = true;
  while (good) {
    char* end = nullptr;
    const double number = std::strtod(at, &end);
    good = end != at && std::isfinite(number);
    numbers.push_back(number);
    at = end;
    if (*at != ',') break;
    ++at;
  }
  if (!good || *at != '\0' || numbers.size() != count) {
    throw CommandFailed{option + " " + text + ": expected " + form, 2};
  }
  return numbers;
}

}  // namespace

double parse_number(const std::string& option, const std::string& text, const std::string& form) {
  return parse_numbers(option, text, 1, form).front();
}

Point2 parse_point(const std::string& option, const std::string& text) {
  const auto numbers = parse_numbers(option, text, 2, "two numbers X,Y [m]");
  return {numbers[0], numbers[1]};
}

Pose2 parse_pose(const std::string& option, const std::string& text) {
  const auto numbers = parse_numbers(option, text, 3, "three numbers X,Y,DEG [m, m, degrees]");
  return {numbers[0], numbers[1], Angle::degrees(numbers[2])};
}

std::string pose_text(const Pose2& pose) {
  return std::to_string(pose.x) + "," + std::to_string(pose.y) + "," + std::to_string(pose.theta.degrees());
}

CLI::Validator pose_option() {
  return CLI::Validator{[](std::string& text) {
                          try {
                            static_cast<void>(parse_pose("", text));
                            return std::string{};
                          } catch (const CommandFailed&) {
                            return text + ": expected three numbers X,Y,DEG [m, m, degrees]";
                          }
                        },
                        "X,Y,DEG"};
}

CLI::Validator kept_folder() {
  return CLI::Validator{[](std::string& text) {
                          std::error_code code;
                          std::filesystem::path there = std::filesystem::absolute(text, code);
                          if (text.empty() || code) return std::string{"expected a folder"};
                          while (!std::filesystem::exists(there, code) && there != there.parent_path())
                            there = there.parent_path();
                          if (std::filesystem::is_directory(there, code)) return std::string{};
                          return there.string() + " is not a folder";
                        },
                        "FOLDER"};
}

void refuse_odd_numbers(CLI::App& app) {
  for (const CLI::Option* option : app.get_options({})) {
    if (option->count() == 0 || option->get_type_name().rfind("FLOAT", 0) != 0) continue;
    for (const std::string& text : option->results())
      if (!std::isfinite(std::strtod(text.c_str(), nullptr)))
        throw CommandFailed{option->get_name() + " " + text + ": expected a number", 2};
  }
  for (CLI::App* command : app.get_subcommands({})) refuse_odd_numbers(*command);
}

namespace {

namespace fs = std::filesystem;

constexpr const char* kWritesFile = "writes a file";  ///< the name of the validators of files

struct Output {
  std::string option;
  std::string file;
};

bool writes_file(CLI::Option& option) {
  try {
    return option.get_validator(kWritesFile) != nullptr;
  } catch (const CLI::OptionNotFound&) {
    return false;
  }
}

/// Of the options that were given, those of all commands.
void collect_outputs(CLI::App& app, std::vector<Output>& outputs) {
  for (CLI::Option* option : app.get_options({}))
    if (option->count() > 0 && writes_file(*option))
      for (const std::string& file : option->results()) outputs.push_back({option->get_name(), file});
  for (CLI::App* command : app.get_subcommands({})) collect_outputs(*command, outputs);
}

std::string cannot(const std::string& text, const std::string& why) { return "cannot write " + text + ": " + why; }

/// "" when something can be made in `folder`.
std::string fault_of_folder(const std::string& text, const fs::path& folder) {
  std::error_code code;
  if (!fs::exists(folder, code)) return cannot(text, "there is no folder " + folder.string());
  if (!fs::is_directory(folder, code)) return cannot(text, folder.string() + " is not a folder");
  if (access(folder.c_str(), W_OK | X_OK) != 0) return cannot(text, "no permission to write in " + folder.string());
  return "";
}

std::string fault_of_output_file(std::string& text) {
  std::error_code code;
  const fs::path path = fs::absolute(text, code);
  if (text.empty() || code) return "expected a file to write";
  const auto to = destination_of(path);
  if (!to) return to.error().message;
  if (to->descriptor >= 0) return "";
  if (fs::is_directory(path, code)) return cannot(text, "it is a folder");
  if (fs::exists(path, code) && access(path.c_str(), W_OK) != 0)
    return cannot(text, to->is_stream ? "no permission to write into it" : "no permission to replace it");
  return to->is_stream ? "" : fault_of_folder(text, to->path.parent_path());
}

std::string fault_of_output_picture(std::string& text) {
  if (const auto format = pictures::figure_format(text); !format) return format.error().message;
  return fault_of_output_file(text);
}

std::string fault_of_output_folder(std::string& text) {
  std::error_code code;
  fs::path existing = fs::absolute(text, code);
  if (text.empty() || code) return "expected a folder to write to";
  while (!fs::exists(existing, code) && existing.has_relative_path()) existing = existing.parent_path();
  return fault_of_folder(text, existing);
}

}  // namespace

CLI::Validator output_file() { return CLI::Validator{fault_of_output_file, "FILE", kWritesFile}; }
CLI::Validator output_folder() { return CLI::Validator{fault_of_output_folder, "FOLDER"}; }
CLI::Validator output_picture() {
  return CLI::Validator{fault_of_output_picture, "FILE.svg, .pdf or .png", kWritesFile};
}

void refuse_shared_outputs(CLI::App& app) {
  std::vector<Output> outputs;
  collect_outputs(app, outputs);
  for (std::size_t i = 0; i < outputs.size(); ++i)
    for (std::size_t before = 0; before < i; ++before)
      if (replace_each_other(outputs[before].file, outputs[i].file))
        throw CommandFailed{outputs[i].option + " " + outputs[i].file + ": is written by " + outputs[before].option, 2};
}

void add_picture_format(CLI::App& command, std::string& format) {
  command.add_option("--picture-format", format, "of the pictures: svg, pdf (both vectors) or png")
      ->check(CLI::IsMember({"svg", "pdf", "png"}))
      ->capture_default_str();
}

CLI::Validator topic_prefix() {
  return CLI::Validator{
      [](std::string& text) {
        constexpr std::size_t kLongest = 64;
        bool begins = true;  // a part, of which the first character is no digit
        bool fits = !text.empty() && text.size() <= kLongest && text.back() != '/';
        for (const char c : text) {
          const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
          const bool is_digit = c >= '0' && c <= '9';
          fits = fits && (is_letter || (!begins && (is_digit || c == '/')));
          begins = c == '/';
        }
        if (fits) return std::string{};
        return "'" + text +
               "' cannot begin the name of a topic: letters, digits and '_', which may be parted by '/', "
               "no digit first, at most 64 in all";
      },
      "NAME"};
}

void add_seed(CLI::App& command, const std::string& name, std::uint64_t& seed, const std::string& meaning) {
  // Left alone, -3 becomes the seed 18446744073709551613.
  const CLI::Validator is_seed{[](std::string& text) {
                                 const bool is_whole =
                                     !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
                                 return is_whole ? std::string{} : "'" + text + "' is no whole number from 0 on";
                               },
                               "SEED"};
  command.add_option(name, seed, meaning)->check(is_seed)->capture_default_str();
}

}  // namespace docent::apps
