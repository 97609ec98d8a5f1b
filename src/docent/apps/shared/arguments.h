#pragma once

#include <cstdint>
#include <string>

#include "docent/geometry/pose2.h"

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace docent::apps {

/// What an option's text says; otherwise CommandFailed, which names the option and what was expected (`form`).
[[nodiscard]] double parse_number(const std::string& option, const std::string& text, const std::string& form);
[[nodiscard]] Point2 parse_point(const std::string& option, const std::string& text);  ///< X,Y [m]
[[nodiscard]] Pose2 parse_pose(const std::string& option, const std::string& text);    ///< X,Y,DEG
[[nodiscard]] std::string pose_text(const Pose2& pose);                                ///< what parse_pose reads

/// For options of parse_pose: refused before the work begins, also by a command that has no use for it.
[[nodiscard]] CLI::Validator pose_option();
/// For options that name a folder for what must survive, which need not be there yet: refused where it is a file, or
/// lies below one.
[[nodiscard]] CLI::Validator kept_folder();
/// CommandFailed where an option that wants a number was given one that is none or infinite: bounds let it pass.
void refuse_odd_numbers(CLI::App& app);

/// For options that become the beginning of topics' names, as ROS 2 has them.
[[nodiscard]] CLI::Validator topic_prefix();

/// For options that name what a command will write: refused before the work begins when it could not be written at the
/// end. A file needs a folder that exists, also where a link leads; a folder is made where it can be. Devices and pipes
/// are written into.
[[nodiscard]] CLI::Validator output_file();
[[nodiscard]] CLI::Validator output_folder();
/// A file whose extension is one that a figure can have.
[[nodiscard]] CLI::Validator output_picture();
/// CommandFailed where two of the options given name the same file to write: one of the two would be lost.
void refuse_shared_outputs(CLI::App& app);
/// A seed: a whole number from 0 on.
void add_seed(CLI::App& command, const std::string& name, std::uint64_t& seed, const std::string& meaning);
/// "as FILE.svg, .pdf or .png" for commands that write pictures under names of their own: the option --picture-format.
void add_picture_format(CLI::App& command, std::string& format);

}  // namespace docent::apps
