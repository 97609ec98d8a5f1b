#include <iostream>

#include "docent/base/files.h"
#include "docent/messages/definitions/message_comments.h"
#include "docent/messages/schema.h"
#include "docent/messages/topics.h"

// Writes what every message on the bus is, for programs of others: `docent_idl_generator FILE.idl FILE.c FOLDER
// HEADER...`. The first file gets the IDL, the second a table of what idlc makes of it:
// topic_descriptor("sensor_msgs/msg/LaserScan"). The folder gets the messages of package docent_msgs as ROS 2 wants
// them, NAME.msg, with the comments of the headers.

namespace docent {
namespace {

MessageSchemas all_schemas() {
  SchemaCollector collector;
  const auto add = [&]<class T>(Topic<T>) { collector.add<T>(); };
  for_each_robot_topic(add);
  for_each_truth_topic(add);
  return collector.take();
}

std::string descriptor_table(const MessageSchemas& schemas, const std::string& header) {
  std::string text = "#include \"" + header + "\"\n#include <string.h>\n\n" +
                     "const dds_topic_descriptor_t* docent_topic_descriptor(const char* type) {\n";
  for (const auto& schema : schemas) {
    std::string symbol = dds_type_name(schema.type);
    for (auto at = symbol.find("::"); at != std::string::npos; at = symbol.find("::")) symbol.replace(at, 2, "_");
    text += "  if (strcmp(type, \"" + schema.type + "\") == 0) return &" + symbol + "_desc;\n";
  }
  return text + "  return 0;\n}\n";
}

Result<void> write_msg_files(const MessageSchemas& schemas, const std::vector<std::string>& headers,
                             const std::filesystem::path& folder) {
  MessageComments comments;
  for (const auto& header : headers) {
    const auto text = read_file(header);
    if (!text) return tl::unexpected<Error>(text.error());
    add_message_comments(*text, comments);
  }
  const std::string package = "docent_msgs/msg/";
  for (const auto& schema : schemas) {
    if (!schema.type.starts_with(package)) continue;
    const std::string name = schema.type.substr(package.size());
    const std::string text = commented_msg(ros2msg_text({schema}), name, comments);
    if (auto written = write_file_atomically(folder / (name + ".msg"), text); !written) return written;
  }
  return {};
}

}  // namespace
}  // namespace docent

int main(int argc, char** argv) {
  if (argc < 5) {
    std::cerr << "usage: docent_idl_generator FILE.idl FILE.c FOLDER HEADER...\n";
    return 2;
  }
  const std::filesystem::path idl = argv[1];
  const std::vector<std::string> headers{argv + 4, argv + argc};
  const auto schemas = docent::all_schemas();
  auto written = docent::write_file_atomically(idl, docent::idl_text(schemas));
  const std::string header = std::filesystem::path{idl}.replace_extension(".h").filename();
  if (written) written = docent::write_file_atomically(argv[2], docent::descriptor_table(schemas, header));
  if (written) written = docent::write_msg_files(schemas, headers, argv[3]);
  if (!written) std::cerr << written.error().message << '\n';
  return written ? 0 : 1;
}
