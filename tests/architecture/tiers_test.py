#!/usr/bin/env python3
"""What scripts/test chooses: the folders that a change needs, the sources for clang-tidy, the suites of a tier; and that processor
time is counted with orphans."""
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path
from unittest import mock

sys.dont_write_bytecode = True  # the work tree stays as it was
ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts/testing"), str(ROOT / "scripts")]
import changes  # noqa: E402
import tidy  # noqa: E402

SUITES = {path.name for path in (ROOT / "tests/suites").iterdir() if path.suffix != ".txt"}
ORPHAN = """
import os, time
if os.fork() == 0:
    os.setsid()
    if os.fork() == 0:
        while time.process_time() < 0.2: pass
    os._exit(0)
os.wait()
time.sleep(0.2)
raise SystemExit(3)
"""


class Project(unittest.TestCase):
    """A folder that git watches, with three capabilities in a row: base <- grid <- planning/route; and one apart."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.write("src/docent/base/CMakeLists.txt", "docent_capability(base\n  SOURCES a)  # DEPENDS grid\n")
        self.write("src/docent/grid/CMakeLists.txt", "docent_capability(grid\n  SOURCES a HOT DEPENDS base LIBRARIES fmt)\n")
        self.write("src/docent/planning/route/CMakeLists.txt", "docent_capability(planning/route\n  SOURCES a\n  DEPENDS grid)\n")
        self.write("src/docent/people/CMakeLists.txt", "docent_capability(people SOURCES a DEPENDS base TEST_DEPENDS planning/route)\n")
        self.write("tests/replay/CMakeLists.txt", "target_link_libraries(docent_replay_test PRIVATE docent_planning_route)\n")
        self.write("src/docent/base/a.h", "")
        self.write("src/docent/grid/a.h", '#include "docent/base/a.h"\n')
        self.write("src/docent/grid/a.cpp", '#include "docent/grid/a.h"\n')
        self.write("src/docent/grid/a_test.cpp", '#include "docent/grid/a.h"\n')
        self.write("src/docent/planning/route/a.cpp", '#include "docent/grid/a.h"\n#include "table.inc"\n')
        self.write("src/docent/planning/route/table.inc", "")
        self.git("init", "-q", "-b", "main")
        self.commit()

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def git(self, *words):
        subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@b", *words], cwd=self.root, check=True, capture_output=True)

    def commit(self):
        self.git("add", "-A")
        self.git("commit", "-qm", "more")

    def plan(self, *files):
        folders, tests, suites, page, everything = changes.plan(changes.Graph(self.root), files, SUITES)
        return sorted(folders), sorted(tests), sorted(suites), page, everything

    def changed(self, base=None):
        return changes.changed_files(self.root, changes.base_of(self.root, base))


class Folders(Project):
    def test_a_source_needs_its_folder_and_all_that_use_it(self):
        self.assertEqual(self.plan("src/docent/planning/route/a.cpp"), (["people", "planning/route"], ["replay"], [], False, False))
        self.assertEqual(self.plan("src/docent/grid/a.h")[0], ["grid", "people", "planning/route"])
        self.assertEqual(self.plan("src/docent/base/a.h")[0], ["base", "grid", "people", "planning/route"])
        self.assertEqual(self.plan("src/docent/people/a.cpp"), (["people"], [], [], False, False))

    def test_a_public_header_is_one_of_its_folder(self):
        self.assertEqual(self.plan("include/docent/grid/b.h")[:2], self.plan("src/docent/grid/a.h")[:2])
        self.assertEqual(self.plan("include/docent/grid/b.h")[2], ["14-reference"])

    def test_what_lies_deeper_belongs_to_the_folder_above(self):
        self.assertEqual(self.plan("src/docent/planning/route/words/de.yaml")[0], ["people", "planning/route"])
        self.assertEqual(self.plan("src/docent/planning/README.md")[0], [])

    def test_a_test_needs_its_folder_alone(self):
        for kind in ("test", "benchmark", "fuzzer"):
            self.assertEqual(self.plan(f"src/docent/grid/a_{kind}.cpp"), (["grid"], [], [], False, False))
        self.assertEqual(self.plan("tests/replay/replay_test.cpp"), ([], ["replay"], [], False, False))

    def test_a_parser_needs_its_fuzzer(self):
        self.write("src/docent/people/a_fuzzer.cpp", "")
        self.assertEqual(self.plan("src/docent/people/a.cpp")[2], ["13-fuzz-replay"])
        self.assertEqual(self.plan("src/docent/base/a.h")[2], [])

    def test_documents_need_nothing(self):
        for name in ("README.md", "docs/a.md", "src/docent/grid/README.md", "CHANGELOG.md", "python/README.md", "examples/README.md",
                     "web/README.md", "prolog/README.md", "tests/mutants/README.md"):
            self.assertEqual(self.plan(name), ([], [], [], False, False), name)

    def test_a_document_that_is_named_or_that_programs_read_needs_it(self):
        self.assertEqual(self.plan("include/README.md"), ([], [], ["14-reference"], False, False))
        self.assertEqual(self.plan("museums/bonn/content/zuse.long.en.md")[1], ["museums"])
        self.assertEqual(self.plan("tests/corpus/interaction_speech_spoken_text/story.md")[2], ["13-fuzz-replay"])

    def test_other_files_need_what_reads_them(self):
        self.assertTrue(self.plan("web/src/a.ts")[3])
        self.assertTrue(self.plan("cmake/DocentCapability.cmake")[4])
        self.assertFalse(self.plan("cmake/README.md.in", "web/src/a.ts")[3:] == (False, False))
        self.assertEqual(self.plan("scripts/evaluation/tour.py")[2], ["10-verdicts", "11-figures"])
        self.assertEqual(self.plan("docs/reference/Doxyfile")[2], ["14-reference"])
        self.assertEqual(self.plan("scripts/testing/seeds.sh")[2], ["13-fuzz-replay"])
        for name in ("packaging/debian/docent.service", "tests/package/check_package.sh", "scripts/package"):
            self.assertEqual(self.plan(name)[2], ["45-package"], name)
        self.assertEqual(self.plan("tests/library/check_library.sh")[2], ["46-library"])
        self.assertEqual(self.plan("tests/package/small_debian.sh")[2], ["45-package", "46-library"])
        self.assertEqual(self.plan("tests/suites/12-prolog")[2], ["12-prolog"])
        self.assertEqual(self.plan("tests/suites/budgets.txt")[2], [])

    def test_what_is_said_to_read_files_is_there(self):
        graph = changes.Graph(ROOT)
        for start, needs in changes.READ_BY.items():
            self.assertTrue((ROOT / start).exists(), start)
            for need in needs:
                is_there = (need in {"page", "everything"} or need in SUITES or need.removeprefix("tests/") in graph.linked_by_tests
                            or need.removeprefix("=") in graph.depends)
                self.assertTrue(is_there, f"{start} needs {need}")

    def test_the_graph_of_this_project_is_read(self):
        graph = changes.Graph(ROOT)
        listed = len(list((ROOT / "src/docent").rglob("CMakeLists.txt"))) - 2  # src/docent itself, and apps
        self.assertGreaterEqual(len(graph.depends), listed - 1)
        self.assertGreater(len(graph.users({"base"})), 0.9 * len(graph.depends))
        self.assertIn("hostile", graph.linked_by_tests)


class Changes(Project):
    def test_what_is_committed_on_a_branch_changed_and_or_new_counts(self):
        self.assertEqual(self.changed(), [])
        self.git("checkout", "-qb", "branch")
        self.write("src/docent/grid/a.cpp", "int a;\n")
        self.commit()
        self.write("src/docent/base/a.h", "int b;\n")
        self.write("new.py", "")
        self.assertEqual(self.changed(), ["new.py", "src/docent/base/a.h", "src/docent/grid/a.cpp"])
        self.assertEqual(self.changed("HEAD"), ["new.py", "src/docent/base/a.h"])

    def test_names_with_blanks_and_letters_of_other_languages_count(self):
        names = ["src/docent/grid/b c.h", "src/docent/grid/b\u00fc.h", "src/docent/grid/b\nc.h"]
        for name in names:
            self.write(name, "")
        self.assertEqual(self.changed(), sorted(names))
        self.commit()
        self.assertEqual(self.changed("HEAD^"), sorted(names))
        self.assertEqual(self.plan(names[1])[0], ["grid", "people", "planning/route"])

    def test_what_is_gone_counts(self):
        (self.root / "src/docent/grid/a.cpp").unlink()
        self.assertEqual(self.changed(), ["src/docent/grid/a.cpp"])

    def test_without_a_main_branch_it_is_what_is_not_committed(self):
        self.git("branch", "-m", "other")
        self.write("new.py", "")
        self.assertEqual(self.changed(), ["new.py"])
        with self.assertRaises(SystemExit):
            self.changed("nothing-of-that-name")

    def test_tidy_looks_at_what_includes_a_public_header(self):
        self.write("include/docent/grid/b.h", "")
        self.write("src/docent/grid/b.cpp", '#include "docent/grid/b.h"\n')
        self.assertEqual(changes.to_tidy(self.root, ["include/docent/grid/b.h"]), (["src/docent/grid/b.cpp"], 0))

    def test_tidy_looks_at_what_includes_a_changed_header_the_nearest_first(self):
        self.write("src/docent/people/b.cpp", '#include "docent/people/b.h"\n')
        self.write("src/docent/people/b.h", '#include "docent/grid/a.h"\n')
        route = "src/docent/planning/route/a.cpp"
        self.assertEqual(changes.to_tidy(self.root, ["src/docent/grid/a.h"]), (["src/docent/grid/a.cpp", route, "src/docent/people/b.cpp"], 0))
        self.assertEqual(changes.to_tidy(self.root, ["src/docent/grid/a.h"], 1), (["src/docent/grid/a.cpp"], 2))
        self.assertEqual(changes.to_tidy(self.root, [route.replace("a.cpp", "table.inc")]), ([route], 0))
        self.assertEqual(changes.to_tidy(self.root, ["src/docent/grid/a_test.cpp", "README.md"]), ([], 0))


class BuiltTests(Project):
    def chosen(self, *words):
        return changes.chosen_tests(changes.built_tests(self.root / "b"), self.root / "b", *words)

    def setUp(self):
        super().setUp()
        b = self.root / "b"
        self.write("b/src/docent/CTestTestfile.cmake",
                   f'add_test([=[grid+planning/route]=] "{b}/src/docent/docent_tests_0")\n'
                   'set_tests_properties([=[grid+planning/route]=] PROPERTIES  LABELS "unit" TIMEOUT "600")\n'
                   f'add_test(people "{b}/src/docent/docent_people_test")\nset_tests_properties(people PROPERTIES  LABELS "unit")\n')
        self.write("b/tests/replay/CTestTestfile.cmake",
                   f'add_test([=[replay]=] "{b}/tests/replay/docent_replay_test")\n'
                   'set_tests_properties([=[replay]=] PROPERTIES  LABELS "replay" TIMEOUT "900")\n')

    def test_folders_that_are_one_program_come_together(self):
        joint, people, replay = ("docent_tests_0", "grid+planning/route"), ("docent_people_test", "people"), ("docent_replay_test", "replay")
        self.assertEqual(self.chosen(["planning/route"], set(), set()), [joint])
        self.assertEqual(self.chosen(["people", "grid"], {"replay"}, set()), [joint, people])
        self.assertEqual(self.chosen([], {"replay"}, {"replay"}), [replay])
        self.assertEqual(self.chosen(None, set(), set()), [joint, people, replay])


    def test_of_a_program_only_the_tests_of_the_folders_are_asked_for(self):
        self.write("src/docent/grid/a_test.cpp", "TEST(Grid, Is) {\n}\nTEST_P(Size,\n       Fits) {\n}\n// TEST(Not, This)\n")
        self.write("src/docent/people/a_test.cpp", "TEST(People, Are) {\n}\n")
        self.write("tests/replay/replay_test.cpp", "TEST_F(Replay, Is) {\n}\n")
        asked = changes.filter_of(self.root, ["grid", "tests/replay!"])
        self.assertEqual(asked.split(":")[::4], ["Grid.*", "Replay.*", "Size.*"])
        self.assertIn(":*/Size.*:", asked)


class Budgets(unittest.TestCase):
    def setUp(self):
        lines = (ROOT / "tests/suites/budgets.txt").read_text().splitlines()
        self.rows = [line.split(None, 4) for line in lines if line and not line.startswith("#")]

    def test_every_suite_has_a_tier_and_a_reason(self):
        for row in self.rows:
            self.assertEqual(len(row), 5, row)
            self.assertIn(row[0], {"merge", "all", "both"})
            self.assertIn(row[1], {"step", "alone", "lane", "beside"})
            self.assertGreater(int(row[3]), 0)
        names = [row[2] for row in self.rows if row[1] != "step"]
        self.assertEqual(sorted(names), sorted(SUITES))
        steps = (ROOT / "scripts/testing/tiers.sh").read_text()
        for row in self.rows:
            self.assertTrue(row[1] != "step" or re.search(rf"\b(stage|aside) {row[2]}\b", steps), row)

    def test_what_every_merge_runs_stays_below_its_budget(self):
        total = int(re.search(r"^total_budget=(\d+)", (ROOT / "scripts/testing/stages.sh").read_text(), re.M)[1])
        self.assertLessEqual(total, 3000)
        self.assertLessEqual(sum(int(row[3]) for row in self.rows if row[0] != "all"), total)


class Metered(unittest.TestCase):
    @staticmethod
    def metered(*words):
        return subprocess.run([ROOT / "scripts/testing/metered", *words], check=False, capture_output=True, text=True)

    def test_what_cannot_be_started_is_said_in_one_line(self):
        with tempfile.TemporaryDirectory() as folder:
            missing = self.metered(folder + "/meter", "no-such-command")
            self.assertEqual((missing.returncode, missing.stderr.count("\n")), (127, 1))
            self.assertEqual(self.metered(folder + "/meter", folder).returncode, 126)
        self.assertIn("usage", self.metered("meter").stderr)

    def test_a_hangup_ends_the_command_and_is_its_exit_code(self):
        with tempfile.TemporaryDirectory() as folder:
            started = Path(folder) / "started"
            process = subprocess.Popen([ROOT / "scripts/testing/metered", folder + "/meter", "sh", "-c", f"touch {started}; exec sleep 60"])
            while not started.exists():
                time.sleep(0.02)
            process.send_signal(signal.SIGHUP)
            self.assertEqual(process.wait(timeout=30), 128 + signal.SIGHUP)
            self.assertTrue((Path(folder) / "meter").exists())

    def test_an_orphan_counts_and_the_exit_code_stays(self):
        with tempfile.TemporaryDirectory() as folder:
            for measure in ("", "reaper"):
                file = Path(folder) / "meter"
                done = subprocess.run([ROOT / "scripts/testing/metered", file, sys.executable, "-c", ORPHAN],
                                      env=dict(os.environ, DOCENT_MEASURE=measure), check=False)
                self.assertEqual(done.returncode, 3)
                seconds, kind = file.read_text().split()
                self.assertGreater(float(seconds), 0.18)
                self.assertLess(float(seconds), 2.0)
                self.assertIn(kind, {measure} if measure else {"cgroup", "reaper"})


class TidyKeys(Project):
    """What clang-tidy has found good is known by a key of what the source sees, wherever the clone lies."""

    def keys(self, root):
        source, other, foreign = (root / name for name in ("src/docent/grid/a.cpp", "src/docent/planning/route/a.cpp", "build/dev/foreign.h"))
        joint = root / "build/dev/joint.cpp"
        tidy.hash_of.cache_clear()
        tidy.own_includes.cache_clear()
        read = [joint, source, root / "src/docent/grid/a.h", root / "src/docent/base/a.h", other, foreign, *(root / "include").rglob("*.h")]
        commands = {source: {"command": f"c++ -I {root}/src -O2 -o {root}/joint_7.o -c {source}"}}
        with mock.patch.multiple(tidy, ROOT=root, TIDY="true", files_read_by_compiler=lambda: {joint: read}):
            return tidy.keys_of([source], commands, {source: joint})

    def test_the_clones_place_and_what_it_does_not_see_do_not_count(self):
        for name in (".clang-tidy", ".clang-format", "build/dev/foreign.h"):
            self.write(name, "")
        self.write("build/dev/joint.cpp", f'#include "{self.root}/src/docent/grid/a.cpp"\n')
        [first] = self.keys(self.root).values()
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(self.root, Path(folder) / "clone")
            self.assertEqual(list(self.keys(Path(folder) / "clone").values()), [first])
        self.write("src/docent/planning/route/a.cpp", "int other;\n")
        self.assertEqual(list(self.keys(self.root).values()), [first])
        for name in ("src/docent/base/a.h", "src/docent/grid/a.cpp", ".clang-tidy", "build/dev/foreign.h"):
            before = (self.root / name).read_text()
            self.write(name, before + "// more\n")
            self.assertNotEqual(list(self.keys(self.root).values()), [first], name)
            self.write(name, before)
        (self.root / "build/dev/foreign.h").unlink()
        self.assertEqual(self.keys(self.root), {})

    def test_what_lies_behind_a_public_header_counts(self):
        for name in (".clang-tidy", ".clang-format", "build/dev/foreign.h", "build/dev/joint.cpp", "include/docent/people/a.h"):
            self.write(name, "")
        self.write("src/docent/grid/a.cpp", '#include "docent/grid/b.h"\n')
        self.write("include/docent/grid/b.h", '#include "docent/grid/a.h"\n')
        known = list(self.keys(self.root).values())
        for name in ("include/docent/grid/b.h", "src/docent/grid/a.h", "src/docent/base/a.h"):
            before = (self.root / name).read_text()
            self.write(name, before + "// more\n")
            self.assertNotEqual(list(self.keys(self.root).values()), known, name)
            self.write(name, before)
        self.write("include/docent/people/a.h", "int other;\n")
        self.assertEqual(list(self.keys(self.root).values()), known)


class Runs(Project):
    """scripts/test itself, in a project whose suites and tools only say that they were called."""

    def setUp(self):
        super().setUp()
        for name in ("scripts/test", "scripts/testing/stages.sh", "scripts/testing/tiers.sh", "scripts/testing/metered",
                     "scripts/testing/left-running", "scripts/testing/changes.py", "scripts/testing/configure"):
            self.write(name, (ROOT / name).read_text())
            (self.root / name).chmod(0o755)
        for name in ("cmake", "ctest", "npm"):
            self.script(f"bin/{name}", f'echo {name} "$@" >>"$CALLED"; echo $GTEST_FILTER >filter; mkdir -p build/dev')
        for name in ("install-packages", "lint"):
            self.script(f"scripts/{name}", f'echo {name} "$@" >>"$CALLED"')
        for name in ("check_includes", "check_sizes", "check_documents", "checks_test", "tiers_test"):
            self.write(f"tests/architecture/{name}.py", "print('4 passed, 0 failed')\n")
        for name in ("10-cheap", "40-dear", "41-beside", "42-long", "60-lane", "61-whole", "12-prolog"):
            self.script(f"tests/suites/{name}", f'echo suite {name} >>"$CALLED"; echo 3 passed, 0 failed')
        self.write("tests/suites/budgets.txt", "both alone 10-cheap 5 x\nmerge alone 40-dear 1 x\nmerge beside 41-beside 5 x\nmerge lane 60-lane 9 x\nall lane 61-whole 9 x\n"
                   "all alone 12-prolog 9 x\nall alone 42-long 61 x\n")
        self.write(".gitignore", "/build/\n/called\n/filter\n")
        self.commit()

    def script(self, name, text):
        self.write(name, f"#!/bin/bash\n{text}\n")
        (self.root / name).chmod(0o755)

    def run_test(self, *words):
        """(exit code, what it printed, what it called)"""
        called = self.root / "called"
        called.write_text("")
        done = subprocess.run([self.root / "scripts/test", *words], text=True, capture_output=True, check=False,
                              env=dict(os.environ, PATH=f"{self.root}/bin:{os.environ['PATH']}", CALLED=str(called)))
        return done.returncode, done.stdout, called.read_text().splitlines()

    def test_a_merge_runs_its_suites_and_says_what_took_too_long(self):
        self.write("tests/suites/40-dear", (self.root / "tests/suites/40-dear").read_text() +
                   f"{sys.executable} - <<'END'\nimport time\nwhile time.process_time() < 1.6: pass\nEND\necho 1 passed, 2 failed; exit 1\n")
        code, said, called = self.run_test()
        self.assertEqual(code, 1)
        self.assertEqual(sorted(line for line in called if line.startswith("suite")), ["suite 10-cheap", "suite 40-dear", "suite 41-beside", "suite 60-lane"])
        self.assertIn("cmake --preset dev -D DOCENT_UNITY=ON -D CMAKE_CXX_FLAGS_RELEASE=-O2", called)
        self.assertTrue(any(line.startswith("ctest --preset dev -LE") for line in called))
        self.assertIn("dear: 2 s of processors, over its budget of 1 s\n", said)
        self.assertNotIn("cheap: ", said)
        self.assertIn("-- failed: dear", said)
        self.assertRegex(said, r"\n\d+ passed, 2 failed\n$")
        self.assertIn("2 failed", (self.root / "build/test-logs/stage-times.txt").read_text())

    def test_after_a_change_of_documents_nothing_is_built(self):
        self.write("docs/new.md", "")
        code, said, called = self.run_test("--quick")
        self.assertEqual((code, called), (0, ["lint --fast"]), said)
        self.assertIn("1 files changed", said)

    def test_nothing_is_built_for_a_suite_that_is_left_out(self):
        self.script("tests/suites/42-long", 'echo suite changed >>"$CALLED"')
        code, said, called = self.run_test("--quick")
        self.assertEqual((code, called), (0, ["lint --fast"]), said)
        self.assertIn("-- long is left out: it takes 61 s\n", said)
        self.script("tests/suites/40-dear", 'echo suite changed >>"$CALLED"')
        code, said, called = self.run_test("--quick")
        self.assertEqual(code, 0, said)
        self.assertTrue(any(line.endswith("--target docent docent-lab") for line in called), called)
        self.assertEqual(called[-1], "suite changed")

    def test_after_a_change_of_a_source_what_needs_it_is_built_and_tested(self):
        tests = "".join(f'add_test({name} "{self.root}/build/dev/src/docent/docent_{name}_test")\n' for name in ("base", "people", "other"))
        self.write("build/dev/src/docent/CTestTestfile.cmake", tests)
        self.write("build/dev/CMakeCache.txt", "")
        self.write("src/docent/base/a.h", "int a;\n")
        self.write("src/docent/people/a_test.cpp", "TEST(People, Are) {\n}\n")
        self.script("tests/suites/12-prolog", 'echo suite changed >>"$CALLED"')
        code, said, called = self.run_test("--quick")
        self.assertEqual(code, 0, said)
        self.assertIn("cmake -S . -B build/dev", called)
        self.assertTrue(any(line.endswith("--target docent docent_base_test docent_people_test") and line.startswith("cmake --build") for line in called), called)
        self.assertTrue(any(line.endswith("-R ^(base|people)$") for line in called), called)
        self.assertIn("suite changed", called)
        self.assertIn("*/People.*", (self.root / "filter").read_text())

    def test_a_wrong_option_is_refused(self):
        for words in (["--slow"], ["--base"], ["--base", "HEAD"], ["--all", "--base", "HEAD"]):
            code, _, called = self.run_test(*words)
            self.assertNotEqual(code, 0)
            self.assertEqual(called, [])
        self.assertIn("--quick", self.run_test("--help")[1])


if __name__ == "__main__":
    unittest.main()
