# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The same nodes as `ros2 run aurora_bringup up`: ros2 launch aurora_bringup aurora.launch.py

`up` also starts a node again that died; nothing in AURORA depends on this file.
"""

from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch_ros.actions import Node

_NODES = (
    ('aurora_sync', 'sync'),
    ('aurora_sumo_bridge', 'sumo_bridge'),
    ('aurora_uav_bridge', 'uav_bridge'),
    ('aurora_nodes', 'recorder'),
    ('aurora_nodes', 'monitor'),
    ('aurora_nodes', 'executor'),
    ('aurora_nodes', 'grounding'),
    ('aurora_nodes', 'parser'),
    ('aurora_nodes', 'repair'),
    ('aurora_nodes', 'orchestrator'),
)


def generate_launch_description() -> LaunchDescription:
    """Describe one process per node, and the air simulator, which knows nothing of ROS."""
    air = ExecuteProcess(cmd=['ros2', 'run', 'aurora_uav_sim', 'uav_sim'], output='screen')
    nodes = [Node(package=package, executable=name, output='screen') for package, name in _NODES]
    return LaunchDescription([air, *nodes])
