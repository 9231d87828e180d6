# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Package the UAV bridge (dependencies are locked in requirements/ at the top)."""

from setuptools import find_packages, setup

setup(
    name='aurora_uav_bridge',
    version='0.2.0',
    packages=find_packages(exclude=['test', 'test.*']),
    package_data={'': ['*.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/aurora_uav_bridge']),
        ('share/aurora_uav_bridge', ['package.xml']),
    ],
    zip_safe=False,
    maintainer='The AURORA authors',
    maintainer_email='aurora@example.com',
    description='Flying vehicles: a MAVLink client in lockstep, and its ROS 2 node',
    license='Apache-2.0',
    entry_points={'console_scripts': ['uav_bridge = aurora_uav_bridge.node:main']},
)
