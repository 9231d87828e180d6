# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Package aurora_nodes (dependencies are locked in requirements/ at the top)."""

from setuptools import find_packages, setup

setup(
    name='aurora_nodes',
    version='0.2.0',
    packages=find_packages(exclude=['test', 'test.*']),
    package_data={'': ['*.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/aurora_nodes']),
        ('share/aurora_nodes', ['package.xml']),
    ],
    zip_safe=False,
    maintainer='The AURORA authors',
    maintainer_email='aurora@example.com',
    description='Orchestrator, parser, grounding, executor, monitor, recorder and replay nodes',
    license='Apache-2.0',
    entry_points={
        'console_scripts': [
            'orchestrator = aurora_nodes.orchestrator:main',
            'parser = aurora_nodes.parser:main',
            'grounding = aurora_nodes.grounding:main',
            'executor = aurora_nodes.executor:main',
            'repair = aurora_nodes.repair:main',
            'monitor = aurora_nodes.monitor:main',
            'recorder = aurora_nodes.recorder:main',
            'replay = aurora_nodes.replay:main',
            'together = aurora_nodes.together:main',
            'viewer = aurora_nodes.viewer:main',
        ]
    },
)
