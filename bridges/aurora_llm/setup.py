# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Package aurora_llm (dependencies are locked in requirements/ at the top)."""

from setuptools import find_packages, setup

setup(
    name='aurora_llm',
    version='0.2.0',
    packages=find_packages(exclude=['test', 'test.*']),
    package_data={'': ['*.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/aurora_llm']),
        ('share/aurora_llm', ['package.xml']),
    ],
    zip_safe=False,
    maintainer='The AURORA authors',
    maintainer_email='aurora@example.com',
    description='Language models for the parser: any provider, and recorded transcripts',
    license='Apache-2.0',
)
