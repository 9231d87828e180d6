# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Package aurora_bench (dependencies are locked in requirements/ at the top)."""

from setuptools import find_packages, setup

setup(
    name='aurora_bench',
    version='0.2.0',
    packages=find_packages(exclude=['test', 'test.*']),
    package_data={
        '': ['*.typed'],
        'aurora_bench.feasibility': ['*.yaml'],
        'aurora_bench.prompts': ['data/*/*.jsonl'],
        'aurora_bench.retrieval': ['*.yaml'],
    },
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/aurora_bench']),
        ('share/aurora_bench', ['package.xml']),
    ],
    zip_safe=False,
    maintainer='The AURORA authors',
    maintainer_email='aurora@example.com',
    description='Benchmarks and long campaigns: speed, faults, damaged bags, isolation, endurance',
    license='Apache-2.0',
)
