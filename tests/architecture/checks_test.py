#!/usr/bin/env python3
"""What the checks of this folder must find: each rule is broken once, in a tiny project."""
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True  # the work tree stays as it was
sys.path[:0] = [str(Path(__file__).resolve().parent), str(Path(__file__).resolve().parents[2] / "cmake")]
import check_includes  # noqa: E402
import check_sizes  # noqa: E402
import findings  # noqa: E402
import joint_groups  # noqa: E402


class Project(unittest.TestCase):
    """A folder for files that a test writes; it counts what the checks find there."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        (self.root / "src/docent").mkdir(parents=True)
        findings.faults.clear()

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def body(lines, indent="  "):
    return f"{indent}work();\n" * lines


class Sizes(Project):
    def large(self):
        return [(what, size) for what, size, _ in check_sizes.too_large(self.root)]

    def faults(self, exceptions):
        findings.faults.clear()
        check_sizes.check_sizes(self.root, exceptions)
        return list(findings.faults)

    def test_a_folder_may_hold_thirty_files(self):
        for i in range(30):
            self.write(f"src/docent/grid/{i}.h", "")
        self.write("src/docent/grid/deeper/one.h", "")
        self.assertEqual(self.large(), [])
        self.write("src/docent/grid/README.md", "")
        self.assertEqual(self.large(), [("src/docent/grid", "31 files")])

    def test_a_file_may_have_450_lines(self):
        names = ["src/docent/a.h", "src/a.cpp", "tests/x/a.inc", "tests/a.py", "scripts/x/a.py", "web/src/a.ts", "web/src/x/a.svelte",
                 "python/a.cpp", "python/tests/a.py", "examples/x/a.cpp", "examples/a.py"]
        for name in names:
            self.write(name, "\n" * 450)
        self.write("docs/a.py", "\n" * 1000)
        self.write("web/src/node_modules/a.ts", "\n" * 1000)
        self.assertEqual(self.large(), [])
        for name in names:
            self.write(name, "\n" * 451)
        self.assertEqual(sorted(self.large()), sorted((name, "451 lines") for name in names))

    def test_functions_of_each_kind_are_found(self):
        heads = {
            "f": "int f(int a) {",
            "Type::g": "template <class T>\nauto Type::g(std::array<int, 2> a = {1, 2},\n    int b) const -> int {",
            "Type::Type": "Type::Type(int a)\n    : a_{a}, b_{[] { return Pair{1, 2}; }()} {",
            "TEST(Grid, Is Full)": "TEST(Grid, Is Full) {",
            "TEST_F(Stage, Runs)": "TEST_F(Stage, Runs) {",
            "kTable": "constexpr auto kTable = [] {",
            "operator()": "bool Order::operator()(int a) const {",
        }
        for name, head in heads.items():
            lines = 60 - head.count("\n") - 2
            self.write("src/a.cpp", f"namespace a {{\n{head}\n{body(lines)}}}\n}}\n")
            self.assertEqual(self.large(), [], name)
            self.write("src/a.cpp", f"namespace a {{\n{head}\n{body(lines + 1)}}}\n}}\n")
            self.assertEqual(self.large(), [(f"src/a.cpp: {name}", "61 lines")])

    def test_a_member_in_its_class_is_found_and_the_class_is_no_function(self):
        members = "".join(f"  int f{i}() {{ return a_[{i}]; }}\n" for i in range(70))
        self.write("src/a.h", f"class alignas(64) A : public B<int> {{\n public:\n{members}\n private:\n  int a_[70] = {{}};\n}};\n")
        self.assertEqual(self.large(), [])
        self.write("src/a.h", f"class A {{\n{members}\n  void g() override {{\n{body(59)}  }}\n}};\n")
        self.assertEqual(self.large(), [("src/a.h: g", "61 lines")])

    def test_a_lambda_counts_with_the_function_around_it(self):
        self.write("src/a.cpp", f"void f() {{\n  const auto g = [&](int a) {{\n{body(57, '    ')}  }};\n}}\n")
        self.assertEqual(self.large(), [("src/a.cpp: f", "61 lines")])

    def test_a_long_value_is_no_function(self):
        rows = '    {1, f(2), "}"},\n' * 80
        self.write("src/a.cpp", f"const Row kRows[] = {{\n{rows}}};\nstd::vector<Row> kMore{{\n{rows}}};\nvoid f() {{}}\n")
        self.assertEqual(self.large(), [])

    def test_braces_in_text_and_comments_are_no_braces(self):
        text = "void f() {\n  // {\n  /* { */\n  use(\"{\", '{', '\\'', 1'000, R\"(\n{\")\");\n}\n#define BODY {\n"
        self.write("src/a.cpp", text + "void g() {\n" + body(30) + "}\n")
        self.assertEqual(self.large(), [])
        self.write("src/a.cpp", "void f() {\n")
        self.assertEqual([what for what, _ in self.large()], ["src/a.cpp"])

    def test_functions_of_scripts_and_of_the_page_are_found(self):
        self.write("scripts/a.py", "@cache\ndef f():\n" + body(59, "    "))
        self.write("web/src/a.ts", "export function g(\n  a: number,\n): void {\n" + body(57) + "}\n")
        self.write("web/src/b.svelte", "<script>\n  const h = async (a) => {\n" + body(59, "    ") + "  };\n</script>\n")
        self.write("web/src/c.ts", "class A {\n  private m(a: number) {\n" + body(59, "    ") + "  }\n}\n")
        self.assertEqual(self.large(), [("web/src/a.ts: g", "61 lines"), ("web/src/b.svelte: h", "61 lines"),
                                        ("web/src/c.ts: m", "61 lines"), ("scripts/a.py: f", "61 lines")])

    def test_a_module_may_have_fifteen_data_members(self):
        def module(members, name="GlideModule"):
            return ("namespace docent::modules {\nclass " + name + " final : public Module {\n public:\n"
                    "  explicit GlideModule(Bus& bus)\n      : bus_{bus}, way_{Way{1, 2}}, speed_(0.0) {\n    run(speed_);\n  }\n"
                    "  void run(double speed) { speed_ = speed; }\n  int stop(Stop stop_ = {}) const;\n\n private:\n"
                    "  struct Seen {\n    int old_ = 0;\n    int new_ = 0;\n  };\n" + members + "};\n}\n")
        kinds = ["Bus& bus_;", "Way way_{other_, {1, 2}};", "std::function<void(int)> call_ = [this](int a_) { stop_(a_); };",
                 "std::map<std::string, std::pair<int, int>> seen_;  // and not this_", "struct {\n    int deep_ = 0;\n  } parts_;",
                 "const Time begun_ = now(bus_) + longest_;", "double first_ = 1.0, second_{2.0}, third_;", "int cells_[3] = {};"]
        rest = "".join(f"  int a{i}_ = 0;\n" for i in range(5))
        fifteen = "".join(f"  {member}\n" for member in kinds) + rest
        self.write("src/docent/modules/drive/glide_module.cpp", module(fifteen))
        self.assertEqual(self.large(), [])
        fat = module(fifteen + "  std::vector<std::uint8_t> more_;\n")
        self.write("src/docent/modules/drive/glide_module.cpp", fat)
        self.assertEqual(self.large(), [("src/docent/modules/drive/glide_module.cpp: GlideModule", "16 data members")])
        self.write("src/docent/modules/drive/glide_module.cpp", module("", "Way") + fat.replace("GlideModule final", "Slow final"))
        self.write("src/docent/planning/glide_module.cpp", fat)
        self.assertEqual(self.large(), [])

    def test_an_exception_has_a_reason_and_is_needed(self):
        self.write("src/a.cpp", f"void f() {{\n{body(80)}}}\n")
        self.assertEqual(len(self.faults({})), 1)
        self.assertEqual(self.faults({"src/a.cpp: f": "a table in code"}), [])
        self.assertEqual(len(self.faults({"src/a.cpp: f": " "})), 1)
        self.write("src/a.cpp", "void f() {}\n")
        self.assertEqual(self.faults({}), [])
        self.assertEqual(len(self.faults({"src/a.cpp: f": "a table in code"})), 1)


class Publishers(Project):
    def faults(self):
        findings.faults.clear()
        check_includes.check_publishers(self.root, self.root / "messages/topics.h", {"docent/drive": "avoid_module.cpp"})
        return list(findings.faults)

    def setUp(self):
        super().setUp()
        self.write("messages/topics.h", 'inline constexpr Topic<Drive> kDrive{"docent/drive", Qos::command};\n')
        self.write("modules/avoid_module.cpp", "drive_{bus_.publisher(topics::kDrive)},\n")
        self.write("modules/robot_module.cpp", "bus_.subscribe<Drive>(topics::kDrive, f);\n")
        self.write("modules/robot_module_test.cpp", "auto drive = bus.publisher(topics::kDrive);\n")

    def test_the_owner_alone_is_fine(self):
        self.assertEqual(self.faults(), [])

    def test_a_second_publisher_is_found(self):
        for name in ("modules/plan_module.cpp", "modules/plan/parts.inc", "modules/plan.h", "apps/steer/steer.cpp"):
            self.write(name, "auto p = bus->publisher<Drive>(\n    docent::topics::kDrive);\n")
            self.assertEqual(len(self.faults()), 1, name)
            self.write(name, "auto p = bus->publisher(topics::kDriveGoal);\n")
            self.assertEqual(self.faults(), [], name)

    def test_a_second_publisher_in_the_owners_file_is_found(self):
        self.write("modules/avoid_module.cpp", "a_{bus_.publisher(topics::kDrive)},\nb_{bus_.publisher(topics::kDrive)},\n")
        self.assertEqual(len(self.faults()), 1)

    def test_no_publisher_and_no_topic_are_found(self):
        self.write("modules/avoid_module.cpp", "")
        self.assertEqual(len(self.faults()), 1)
        self.write("messages/topics.h", "")
        self.assertEqual(len(self.faults()), 1)

    def test_a_topic_of_the_same_name_is_found(self):
        self.write("apps/steer.cpp", 'const Topic<Drive> mine{"docent/drive", Qos::command};\n')
        self.assertEqual(len(self.faults()), 1)


class Laboratory(Project):
    def faults(self, cmake, source):
        findings.faults.clear()
        self.write("apps/laboratory/crowd/CMakeLists.txt", "docent_capability(apps/laboratory/crowd LABORATORY\n  SOURCES crowd)")
        self.write("apps/x/CMakeLists.txt", cmake)
        self.write("apps/x/x.cpp", source)
        check_includes.check_laboratory(self.root)
        return len(findings.faults)

    def test_nothing_else_sees_a_folder_of_the_laboratory(self):
        plain, own = "docent_capability(apps/x SOURCES x DEPENDS base", "docent_capability(apps/x LABORATORY SOURCES x DEPENDS base"
        include = '#include "docent/base/time.h"\n#include "docent/apps/laboratory/crowd/crowd.h"\n'
        self.assertEqual(self.faults(f"{plain})", ""), 0)
        self.assertEqual(self.faults(f"{plain} apps/laboratory/crowd)", ""), 1)
        self.assertEqual(self.faults(f"{plain})", include), 1)
        self.assertEqual(self.faults(f"{own} apps/laboratory/crowd)", include), 0)

    def test_nothing_else_names_what_cripples(self):
        plain, own = "docent_capability(apps/x SOURCES x)", "docent_capability(apps/x LABORATORY SOURCES x)"
        for text in ("if (config.evaluation().blind) return;", "ablations::CrippledRobot robot;", "AblationParams params;"):
            self.assertEqual(self.faults(plain, text), 1)
            self.assertEqual(self.faults(own, text), 0)


class Namespaces(Project):
    def faults(self, text, path="planning/pursuit/a.h"):
        findings.faults.clear()
        self.write(path, text)
        check_includes.check_namespaces(self.root, {"messages"})
        self.write(path, "")
        return len(findings.faults)

    def test_a_folder_has_a_namespace_of_its_name(self):
        self.assertEqual(self.faults("namespace docent::planning {\n"), 0)
        self.assertEqual(self.faults("namespace docent::planning::testing {\n"), 0)
        self.assertEqual(self.faults("namespace docent {\n"), 1)
        self.assertEqual(self.faults("namespace docent::localization {\n"), 1)

    def test_a_common_folder_has_none(self):
        self.assertEqual(self.faults("namespace docent {\n", "messages/a.h"), 0)
        self.assertEqual(self.faults("namespace docent::docent_msgs {\n", "messages/a.h"), 0)
        self.assertEqual(self.faults("namespace docent::messages {\n", "messages/a.h"), 1)


class Types(Project):
    def faults(self, other):
        findings.faults.clear()
        self.write("mapping/rooms/room.h", "namespace docent::mapping {\nstruct Place {\n};\n")
        self.write("mapping/way/way.h", other)
        check_includes.check_types(self.root)
        return len(findings.faults)

    def test_a_full_name_stands_for_one_type(self):
        self.assertEqual(self.faults("namespace docent::mapping {\nclass Place final : public Way {\n};\n"), 1)
        self.assertEqual(self.faults("namespace docent::mapping {\nstruct Place;\n"), 0)
        self.assertEqual(self.faults("namespace docent::planning {\nstruct Place {\n};\n"), 0)
        self.assertEqual(self.faults("namespace docent {\nnamespace mapping {\nstruct Place {\n};\n}  // namespace mapping\n"), 1)
        self.assertEqual(self.faults("namespace docent {\nnamespace mapping {\n}  // namespace mapping\nstruct Place {\n};\n"), 0)
        self.assertEqual(self.faults("namespace docent::mapping {\nstruct Place::Part {\n};\n"), 0)


class Public(Project):
    def faults(self):
        self.write("cmake/Table.cmake", "docent_component(core FOLDERS base grid LIBRARIES png)\n"
                                        "docent_component(tours FOLDERS task/golog\n  DEPENDS core)\n")
        self.write("src/docent/base/a.cpp", "")
        self.write("src/docent/task/golog/b.cpp", "")
        self.write("src/docent/apps/c.cpp", "")
        findings.faults.clear()
        check_includes.check_public(self.root / "include/docent", self.root / "src/docent", self.root / "cmake/Table.cmake")
        return len(findings.faults)

    def test_headers_of_components_are_fine(self):
        self.write("include/docent/base/a.h", "")
        self.write("include/docent/task/golog/b.h", "")
        self.assertEqual(self.faults(), 0)

    def test_a_header_of_no_component_is_found(self):
        self.write("include/docent/apps/c.h", "")
        self.assertEqual(self.faults(), 1)

    def test_a_header_without_its_folder_is_found(self):
        self.write("include/docent/grid/a.h", "")
        self.assertEqual(self.faults(), 1)

    def test_a_second_header_of_a_name_is_found(self):
        self.write("include/docent/base/a.h", "")
        self.write("src/docent/base/a.h", "")
        self.assertEqual(self.faults(), 1)

    def test_a_source_is_no_public_header(self):
        self.write("include/docent/base/other.cpp", "")
        self.assertEqual(self.faults(), 1)


class JointGroups(Project):
    """Which folders are compiled as one file; no rule, but what it rests on."""

    def groups(self, most=4, **texts):
        folders = []
        for name, text in texts.items():
            path = f"src/docent/{name}/a.cpp"
            self.write(path, text)
            folders.append((name.replace("__", "/"), [str(self.root / path)]))
        joint_groups.names_of.cache_clear()
        return [group.folders for group in joint_groups.groups_of(folders, most)]

    def test_names_of_one_namespace_must_not_meet(self):
        one = "namespace docent::planning {\nnamespace {\nconstexpr double kFar = 3.0;\n}\n"
        for other in ("constexpr int kFar[] = {1};\n", "struct kFar {};\n", "double f() { return kFar; }\n", "using testing::kFar;\n"):
            self.assertEqual(len(self.groups(a=one, b="namespace docent::planning {\n" + other)), 2, other)
            self.assertEqual(len(self.groups(a=one, b="namespace docent::mapping {\n" + other)), 1, other)
            self.assertEqual(len(self.groups(a=one, b="namespace docent::planning::inner {\n" + other)), 2, other)
        for other in ("// kFar\n", 'const char* text() { return "kFar"; }\n', "double f() { return params.kFar; }\n"):
            self.assertEqual(len(self.groups(a=one, b="namespace docent::planning {\n" + other)), 1, other)

    def test_tests_of_one_name_must_not_meet(self):
        one = "namespace docent {\nTEST(Grid, Is) {\n}\n"
        self.assertEqual(len(self.groups(a=one, b=one)), 2)
        self.assertEqual(len(self.groups(a=one, b=one.replace("Is", "Has"))), 1)

    def test_a_layer_stays_together_where_there_is_room(self):
        texts = {name: "" for name in ("low__a", "low__b", "high__a", "high__b", "low__c", "high__c")}
        self.assertEqual(self.groups(most=3, **texts), [["low/a", "low/b", "high/a"], ["high/b", "low/c", "high/c"]])
        self.assertEqual(self.groups(most=6, **texts), [["low/a", "low/b", "high/a", "high/b", "low/c", "high/c"]])


if __name__ == "__main__":
    unittest.main()
