#include <iostream>

#include "docent/base/files.h"
#include "docent/messages/schema.h"
#include "docent/messages/topics.h"

// Writes the IDL of every message on the bus: `docent_idl_generator FILE.idl [FILE.c]`. The second file gets a table of
// what idlc makes of the first: topic_descriptor("sensor_msgs/msg/LaserScan").

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

}  // namespace
}  // namespace docent

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::cerr << "usage: docent_idl_generator FILE.idl [FILE.c]\n";
    return 2;
  }
  const std::filesystem::path idl = argv[1];
  const auto schemas = docent::all_schemas();
  auto written = docent::write_file_atomically(idl, docent::idl_text(schemas));
  if (written && argc == 3) {
    const std::string header = std::filesystem::path{idl}.replace_extension(".h").filename();
    written = docent::write_file_atomically(argv[2], docent::descriptor_table(schemas, header));
  }
  if (!written) std::cerr << written.error().message << '\n';
  return written ? 0 : 1;
}
