#!/usr/bin/env python3
"""The files of packages/docent_ros that no compiler sees: its manifest, its parameters, its launch file."""
import importlib.util
import re
import sys
import tempfile
import unittest
import unittest.mock
import xml.etree.ElementTree as xml
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "packaging" / "docent_ros"


def read(path):
    return (PACKAGE / path).read_text()


class Manifest(unittest.TestCase):
    def test_what_is_included_is_found_and_depended_on(self):
        included = {found for file in ("navigator_node.h", "navigator_node.cpp")
                    for found in re.findall(r"#include <(\w+)/", read("src/" + file))}
        listed = set(re.search(r"set\(packages ([\w ]+)\)", read("CMakeLists.txt")).group(1).split())
        depended = {element.text for element in xml.fromstring(read("package.xml.in")).findall("depend")}
        self.assertLessEqual(included, listed)
        self.assertEqual(listed, depended)

    def test_the_library_goes_along_whole(self):
        files = read("library.txt").split()
        here = {re.sub("^(include|src)/", "", file) for file in files}
        for file in files:
            for wanted in re.findall(r'#include "(docent/[^"]+)"', (ROOT / file).read_text()):
                self.assertIn(wanted, here, file)


class Parameters(unittest.TestCase):
    def test_the_file_names_each_parameter_with_its_default(self):
        import yaml
        written = yaml.safe_load(read("config/docent_ros.yaml"))["/**"]["ros__parameters"]
        header = (ROOT / "src/docent/task_control/navigation_goals/navigation_goals.h").read_text()
        params = header[header.index("struct NavigationGoalParams"):header.index("void visit")]
        defaults = {name: float(value) for name, value in re.findall(r"(?:double|int) (\w+) = ([\d.]+);", params)}
        declared = re.findall(r'declare_parameter\("(\w+)", std::string\("([^"]*)"\)\)', read("src/navigator_node.cpp"))
        defaults.update(declared)
        self.assertEqual(written, defaults)
        for name, value in written.items():
            kind = int if name == "most_poses" else str if name in dict(declared) else float
            self.assertIs(type(value), kind, f"{name}: rclcpp refuses another type")


class Launch(unittest.TestCase):
    def setUp(self):
        names = ("ament_index_python.packages", "launch", "launch.actions", "launch.conditions", "launch.events",
                 "launch.substitutions", "launch_ros.actions", "launch_ros.event_handlers", "launch_ros.events.lifecycle",
                 "lifecycle_msgs.msg")
        self.ros = {name: unittest.mock.MagicMock() for name in names}
        self.ros["ament_index_python.packages"].get_package_share_directory = lambda name: "/share/" + name
        parents = {name.rpartition(".")[0] for name in names if "." in name} | {"launch_ros.events", "launch_ros"}
        modules = self.ros | {name: unittest.mock.MagicMock() for name in parents - {"launch"}}
        spec = importlib.util.spec_from_file_location("docent_launch", PACKAGE / "launch" / "docent_ros.launch.py")
        self.launch = importlib.util.module_from_spec(spec)
        with unittest.mock.patch.dict(sys.modules, modules):
            spec.loader.exec_module(self.launch)

    def test_takes_the_speed_of_robot_yaml(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "robot.yaml"
            file.write_text("body:\n  max_speed: 1\n")
            self.assertEqual(self.launch.of_robot(str(file)), {"speed": 0.35})
            file.write_text("# nothing of its own\n")
            self.assertEqual(self.launch.of_robot(str(file)), {})
        self.assertEqual(self.launch.of_robot(""), {})

    def test_declares_what_it_asks_for(self):
        self.launch.generate_launch_description()
        declared = {call.args[0] for call in self.ros["launch.actions"].DeclareLaunchArgument.call_args_list}
        asked = set(re.findall(r'(?:value|LaunchConfiguration)\("(\w+)"\)', read("launch/docent_ros.launch.py")))
        self.assertEqual(declared, asked)

    def test_starts_one_node_that_is_configured_and_then_activated(self):
        said = {"namespace": "minerva", "params_file": "p.yaml", "robot_yaml": "", "use_sim_time": "true"}
        configuration = self.ros["launch.substitutions"].LaunchConfiguration
        configuration.side_effect = lambda name: unittest.mock.MagicMock(perform=lambda context: said.get(name, "true"))
        self.assertEqual(len(self.launch.start(None)), 3)
        node = self.ros["launch_ros.actions"].LifecycleNode.call_args.kwargs
        self.assertEqual((node["package"], node["executable"], node["namespace"]), ("docent_ros", "navigator", "minerva"))
        self.assertEqual(node["parameters"], ["p.yaml", {}, {"use_sim_time": True}])
        self.assertIn(f"add_executable({node['executable']} ", read("CMakeLists.txt"))


if __name__ == "__main__":
    unittest.main()
