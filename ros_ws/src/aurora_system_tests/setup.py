# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Package aurora_system_tests (dependencies are locked in requirements/ at the top)."""

from setuptools import find_packages, setup

setup(
    name='aurora_system_tests',
    version='0.2.0',
    packages=find_packages(exclude=['test', 'test.*']),
    package_data={'': ['*.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/aurora_system_tests']),
        ('share/aurora_system_tests', ['package.xml']),
    ],
    zip_safe=False,
    maintainer='The AURORA authors',
    maintainer_email='aurora@example.com',
    description='Tests that need several packages: the whole graph as processes',
    license='Apache-2.0',
)
