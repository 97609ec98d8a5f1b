#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "docent/base/yaml.h"

namespace {

/// One of everything that a struct can be made of.
struct Leaf {
  double number = 0.0;
  std::optional<int> maybe;
  template <class V>
  void visit(V& v) {
    v.required("number", number);
    v("maybe", maybe);
  }
};
struct Everything {
  float narrow = 0.0F;
  int whole = 0;
  std::int64_t wide = 0;
  std::uint64_t natural = 0;
  bool yes = false;
  std::string text;
  std::vector<double> list;
  std::vector<std::vector<int>> lists;
  std::vector<Leaf> leaves;
  Leaf leaf;
  template <class V>
  void visit(V& v) {
    v("narrow", narrow);
    v("whole", whole);
    v("wide", wide);
    v("natural", natural);
    v("yes", yes);
    v("text", text);
    v("list", list);
    v("lists", lists);
    v("leaves", leaves);
    v("leaf", leaf);
  }
};

/// A fault is one line "FILE:LINE: what".
void check(const docent::Error& error) {
  const std::string& message = error.message;
  if (message.rfind("fuzz.yaml:", 0) != 0) std::abort();
  const std::size_t end = message.find(':', 10);
  if (end == std::string::npos || end == 10) std::abort();
  for (std::size_t i = 10; i < end; ++i)
    if (message[i] < '0' || message[i] > '9') std::abort();
  if (message.find('\n') != std::string::npos) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = docent::YamlFile::parse({reinterpret_cast<const char*>(data), size}, "fuzz.yaml");
  if (!file) {
    check(file.error());
    return 0;
  }
  Everything everything;
  if (const auto read = docent::read_yaml(*file, file->root(), everything); !read) check(read.error());
  return 0;
}
