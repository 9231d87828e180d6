# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Package the pure library (dependencies are locked in requirements/ at the top)."""

from setuptools import find_packages, setup

setup(
    name='aurora_core',
    version='0.2.0',
    packages=find_packages(exclude=['test', 'test.*']),
    package_data={'': ['*.typed', '*.json', '*.lark', '*.yaml', '*.jinja', '*.css', '*.js']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/aurora_core']),
        ('share/aurora_core', ['package.xml']),
    ],
    zip_safe=False,
    maintainer='The AURORA authors',
    maintainer_email='aurora@example.com',
    description='Scenario graph, grounding, execution and verification without ROS',
    license='Apache-2.0',
)
