# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Package the stand-in for ros2 (dependencies are locked in requirements/ at the top)."""

from setuptools import find_packages, setup

setup(
    name='aurora_ros2cli',
    version='0.2.0',
    packages=find_packages(exclude=['test', 'test.*']),
    package_data={'': ['*.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/aurora_ros2cli']),
        ('share/aurora_ros2cli', ['package.xml']),
        # A plain script: a generated entry point looks through every installed package first.
        ('lib/aurora_ros2cli', ['scripts/ros2']),
    ],
    zip_safe=False,
    maintainer='The AURORA authors',
    maintainer_email='aurora@example.com',
    description='A small stand-in for the ros2 command',
    license='Apache-2.0',
)
