#include "docent/simulator/world/charger_contacts.h"

#include <cmath>

#include "docent/base/yaml.h"

namespace docent::simulator {

bool ChargerContacts::reach(const Pose2& world_from_base) const {
  const Pose2 off = inverse(at) * world_from_base;
  return std::abs(off.y) <= across && off.x >= -before && off.x <= beyond && std::abs(off.theta.degrees()) <= turned;
}

namespace {

struct ContactsYaml {
  double x = 0.0, y = 0.0, heading = 0.0, across = ChargerContacts{}.across;
  template <class V>
  void visit(V& v) {
    v.required("x", x);
    v.required("y", y);
    v.required("heading", heading);
    v("across", across);
  }
};

Result<std::optional<ChargerContacts>> contacts_of(const YamlFile& file) {
  const YAML::Node root = file.root();
  if (!root.IsMap() || !root["contacts"].IsDefined()) return std::optional<ChargerContacts>{};
  ContactsYaml yaml;
  if (auto read = read_yaml(file, root["contacts"], yaml); !read) return tl::unexpected<Error>(read.error());
  if (!(yaml.across > 0.0)) return tl::unexpected<Error>(file.fault(root["contacts"], "across must be > 0"));
  return ChargerContacts{{yaml.x, yaml.y, Angle::degrees(yaml.heading)}, yaml.across};
}

}  // namespace

Result<std::optional<ChargerContacts>> load_contacts(const std::filesystem::path& simulation_yaml) {
  const auto file = YamlFile::load(simulation_yaml);
  if (!file) return tl::unexpected<Error>(file.error());
  return contacts_of(*file);
}

Result<std::optional<ChargerContacts>> parse_contacts(const std::string& text, const std::string& name) {
  const auto file = YamlFile::parse(text, name);
  if (!file) return tl::unexpected<Error>(file.error());
  return contacts_of(*file);
}

}  // namespace docent::simulator
