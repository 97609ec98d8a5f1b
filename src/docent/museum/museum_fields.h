#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "docent/base/yaml.h"
#include "docent/geometry/polygon.h"
#include "docent/museum/museum_reader.h"
#include "docent/museum/place_yaml.h"

namespace docent::museum {

/// What each part of museum.yaml is read by. All throw a YamlFault that names file and line.
class MuseumFields {
 protected:
  static constexpr double kFarthest = 10'000.0;  ///< [m]; coordinates beyond it are a slip of the pen
  static constexpr std::size_t kLongestId = 40;

  explicit MuseumFields(const YamlFile& file) : file_{file} {}
  [[nodiscard]] const YamlFile& file() const { return file_; }

  [[nodiscard]] YamlFault fault(const YAML::Node& at, const std::string& what) const {
    return YamlFault{file_.fault(at, what)};
  }

  [[nodiscard]] YamlFault about(const YAML::Node& at, const std::string& what, const std::string& why) const {
    return fault(at, what + ": " + why);
  }

  [[nodiscard]] YAML::Node required(const YAML::Node& parent, const YAML::Node& node, const char* key) const {
    if (!node.IsDefined() || node.IsNull()) throw fault(parent, std::string{"missing key '"} + key + "'");
    return node;
  }
  [[nodiscard]] YAML::Node list(const YAML::Node& node, const char* what) const {
    if (!node.IsSequence()) throw fault(node, std::string{"expected a list of "} + what);
    return node;
  }
  [[nodiscard]] std::string text(const YAML::Node& node, const char* what) const {
    if (!node.IsScalar()) throw fault(node, std::string{"expected "} + what);
    return node.Scalar();
  }

  [[nodiscard]] std::filesystem::path inside_folder(const YAML::Node& node, const std::string& name) const {
    const std::filesystem::path path{name};
    auto normal = path.lexically_normal();
    if (name.empty() || name.find('\0') != std::string::npos || path.is_absolute() || *normal.begin() == "..") {
      throw fault(node, "'" + name + "' is not a file inside the museum's folder");
    }
    return normal;
  }

  [[nodiscard]] std::string id(const YAML::Node& parent, const YAML::Node& node, std::set<std::string>& seen,
                               const char* what) const {
    std::string name = text(required(parent, node, "id"), "an id");
    const bool plain = std::all_of(name.begin(), name.end(),
                                   [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; });
    if (name.empty() || !plain || name.size() > kLongestId) {
      throw fault(node, std::string{what} + " id '" + name + "': small letters, digits and '-', at most 40");
    }
    if (!seen.insert(name).second) throw fault(node, std::string{what} + " '" + name + "' stands twice");
    return name;
  }

  template <class T>
  [[nodiscard]] T structure(const YAML::Node& node) const {
    T value;
    YamlReader reader{file_, node};
    value.visit(reader);
    reader.finish();
    if (std::abs(value.x) > kFarthest || std::abs(value.y) > kFarthest) throw fault(node, "too far away");
    return value;
  }
  [[nodiscard]] Pose2 pose(const YAML::Node& node) const { return structure<PoseYaml>(node).pose(); }

  [[nodiscard]] Polygon polygon(const YAML::Node& node) const {
    Polygon result;
    for (const auto& corner : list(node, "corners [x, y]")) {
      if (!corner.IsSequence() || corner.size() != 2) throw fault(corner, "expected a corner [x, y]");
      std::array<double, 2> xy{};
      for (std::size_t i = 0; i < 2; ++i) {
        try {
          xy[i] = corner[i].as<double>();
        } catch (const YAML::Exception&) {
          throw fault(corner, "expected numbers [x, y]");
        }
        if (!(std::abs(xy[i]) <= kFarthest)) throw fault(corner, "too far away, or not a number");
      }
      result.push_back({xy[0], xy[1]});
    }
    if (result.size() < 3) throw fault(node, "a polygon needs at least 3 corners");
    if (result.size() > 1000) throw fault(node, "a polygon may have at most 1000 corners");
    if (!is_simple(result)) throw fault(node, "the polygon crosses itself");
    if (std::abs(signed_area(result)) < 1e-6) throw fault(node, "the polygon has no area");
    return result;
  }

 private:
  const YamlFile& file_;
};

/// Texts that lack one of the museum's languages. One that all of them lack is one fault, of the list of languages.
class MissingTexts {
 public:
  /// There is one more text, whatever it lacks.
  void count() { ++texts_; }
  void add(const std::string& language, const Error& fault, const MuseumSource& source) {
    missing_.push_back({language, fault, source.faults.size()});
  }
  /// Tells all of them, each at its place among the other faults.
  /// @param languages  the list of them
  void tell(const YamlFile& file, const YAML::Node& languages, MuseumSource& source) const {
    std::map<std::string, std::size_t> lacking;
    for (const Missing& text : missing_) ++lacking[text.language];
    std::set<std::string> told;
    std::size_t moved = 0;  // by those that were inserted already
    for (const auto& [language, fault, before] : missing_) {
      const bool is_everywhere = texts_ > 1 && lacking.at(language) == texts_;
      if (is_everywhere && !told.insert(language).second) continue;
      const std::size_t place = is_everywhere ? 0 : before + moved;
      const std::string why = "language '" + language + "' has no text anywhere: write them, or take it out";
      source.faults.insert(source.faults.begin() + static_cast<std::ptrdiff_t>(place),
                           is_everywhere ? file.fault(languages, why) : fault);
      for (std::size_t& index : source.of_no_exhibits) index += index >= place ? 1 : 0;
      ++moved;
    }
  }

 private:
  struct Missing {
    std::string language;
    Error fault;
    std::size_t before;  ///< so many other faults
  };
  std::vector<Missing> missing_;
  std::size_t texts_ = 0;
};

}  // namespace docent::museum
