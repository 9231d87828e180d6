# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Package the simulator (dependencies are locked in requirements/ at the top)."""

from setuptools import find_packages, setup

setup(
    name='aurora_uav_sim',
    version='0.2.0',
    packages=find_packages(exclude=['test', 'test.*']),
    package_data={'': ['*.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/aurora_uav_sim']),
        ('share/aurora_uav_sim', ['package.xml']),
    ],
    zip_safe=False,
    maintainer='The AURORA authors',
    maintainer_email='aurora@example.com',
    description='Multirotors behind MAVLink 2 over UDP, PX4 flavour, in real time or lockstep',
    license='Apache-2.0',
    entry_points={'console_scripts': ['uav_sim = aurora_uav_sim.udp_main:main']},
)
