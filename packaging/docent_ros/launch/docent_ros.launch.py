"""Starts the navigator, brings it to active, and takes from robot.yaml what it needs of it.

ros2 launch docent_ros docent_ros.launch.py robot_yaml:=/etc/docent/robot.yaml namespace:=minerva
"""
import os

import yaml
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, EmitEvent, OpaqueFunction, RegisterEventHandler
from launch.conditions import IfCondition
from launch.events import matches_action
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import LifecycleNode
from launch_ros.event_handlers import OnStateTransition
from launch_ros.events.lifecycle import ChangeState
from lifecycle_msgs.msg import Transition

# Of the speed that the body may drive, a robot among people keeps about a third over a whole way.
SHARE_OF_MAX_SPEED = 0.35


def of_robot(path):
    """Parameters that follow from Docent's robot.yaml; a file without a body has the defaults."""
    if not path:
        return {}
    with open(path, encoding="utf-8") as file:
        robot = yaml.safe_load(file) or {}
    fastest = (robot.get("body") or {}).get("max_speed")
    return {} if fastest is None else {"speed": SHARE_OF_MAX_SPEED * float(fastest)}


def start(context):
    def value(name):
        return LaunchConfiguration(name).perform(context)

    node = LifecycleNode(
        package="docent_ros", executable="navigator", name="docent_navigator", namespace=value("namespace"),
        output="screen",
        parameters=[value("params_file"), of_robot(value("robot_yaml")),
                    {"use_sim_time": value("use_sim_time").lower() in ("true", "1")}])

    def change(transition):
        return EmitEvent(event=ChangeState(lifecycle_node_matcher=matches_action(node), transition_id=transition))

    automatic = IfCondition(LaunchConfiguration("autostart"))
    activate = RegisterEventHandler(
        OnStateTransition(target_lifecycle_node=node, start_state="configuring", goal_state="inactive",
                          entities=[change(Transition.TRANSITION_ACTIVATE)]), condition=automatic)
    configure = EmitEvent(event=ChangeState(lifecycle_node_matcher=matches_action(node),
                                            transition_id=Transition.TRANSITION_CONFIGURE), condition=automatic)
    return [activate, node, configure]


def generate_launch_description():
    share = get_package_share_directory("docent_ros")
    return LaunchDescription([
        DeclareLaunchArgument("namespace", default_value="", description="what docent up has as --name"),
        DeclareLaunchArgument("robot_yaml", default_value="", description="Docent's, for the speed of the body"),
        DeclareLaunchArgument("params_file", default_value=os.path.join(share, "config", "docent_ros.yaml")),
        DeclareLaunchArgument("use_sim_time", default_value="false"),
        DeclareLaunchArgument("autostart", default_value="true",
                              description="false: a lifecycle manager configures and activates it"),
        OpaqueFunction(function=start),
    ])
