# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Package the shell scripts that start and stop the nodes; there is no Python in it."""

from setuptools import setup

setup(
    name='aurora_bringup',
    version='0.2.0',
    packages=[],
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/aurora_bringup']),
        ('share/aurora_bringup', ['package.xml']),
        ('share/aurora_bringup/config', ['config/fastdds_localhost.xml']),
        ('share/aurora_bringup/launch', ['launch/aurora.launch.py']),
        (
            'lib/aurora_bringup',
            [
                'scripts/up',
                'scripts/down',
                'scripts/inside',
                'scripts/common.bash',
                'scripts/seats.bash',
                'scripts/stopping.bash',
                'scripts/supervising.bash',
            ],
        ),
    ],
    zip_safe=False,
    maintainer='The AURORA authors',
    maintainer_email='aurora@example.com',
    description='Starts and stops the nodes of AURORA',
    license='Apache-2.0',
)
