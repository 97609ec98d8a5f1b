#pragma once

#include <map>
#include <string>

namespace docent {

/// What the headers say of messages and their fields: the doc comment of struct `Hypothesis` under "Hypothesis", that
/// of its field `x` under "Hypothesis.x".
using MessageComments = std::map<std::string, std::string>;

/// Takes the doc comments out of the text of a header of messages, as clang-format lays it out: structs of fields, each
/// field with `///` before it or `///<` behind it.
void add_message_comments(const std::string& header, MessageComments& comments);

/// The text of a .msg file (`ros2msg_text` of one message) with what the comments say of the message `name`.
[[nodiscard]] std::string commented_msg(const std::string& msg, const std::string& name,
                                        const MessageComments& comments);

}  // namespace docent
