# SPDX-License-Identifier: Apache-2.0
"""The simulator, the wind and, if wanted, RViz: ``ros2 launch golf_sim_ros golf.launch.py rviz:=true``."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, Shutdown
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare

SHARE = FindPackageShare('golf_sim_ros')
ARGUMENTS = [
    DeclareLaunchArgument('course', default_value='golf_without_friends',
                          description='name of a shipped course, or path of a course file'),
    DeclareLaunchArgument('accuracy', default_value='standard', choices=['sketch', 'standard', 'reference'],
                          description='how exactly to simulate'),
    DeclareLaunchArgument('namespace', default_value='',
                          description='namespace of all nodes, so that many games share one network'),
    DeclareLaunchArgument('wind', default_value='true', choices=['true', 'false'],
                          description='whether to start the wind generator'),
    DeclareLaunchArgument('wind_params', description='parameters of the wind generator, a YAML file',
                          default_value=PathJoinSubstitution([SHARE, 'config', 'wind.yaml'])),
    DeclareLaunchArgument('rviz', default_value='false', choices=['true', 'false'],
                          description='whether to start RViz'),
]


def generate_launch_description():
    """All nodes of one game."""
    namespace = LaunchConfiguration('namespace')
    strings = {name: ParameterValue(LaunchConfiguration(name), value_type=str)
               for name in ('course', 'accuracy')}
    sim = Node(package='golf_sim_ros', executable='sim_node', namespace=namespace, output='screen',
               parameters=[strings], on_exit=Shutdown(reason='the simulator has ended'))
    wind = Node(package='golf_sim_ros', executable='wind_node', namespace=namespace, output='screen',
                parameters=[LaunchConfiguration('wind_params')],
                condition=IfCondition(LaunchConfiguration('wind')))
    rviz = Node(package='rviz2', executable='rviz2', namespace=namespace,
                arguments=['-d', PathJoinSubstitution([SHARE, 'rviz', 'golf.rviz'])],
                condition=IfCondition(LaunchConfiguration('rviz')))
    return LaunchDescription([*ARGUMENTS, sim, wind, rviz])
