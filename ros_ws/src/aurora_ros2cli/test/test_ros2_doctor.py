# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 doctor`."""

from __future__ import annotations

from collections.abc import Callable
from subprocess import CompletedProcess

import pytest

Ros2 = Callable[..., CompletedProcess[str]]

pytestmark = pytest.mark.ros


def test_a_sound_set_up_passes_and_says_what_is_odd(ros2: Ros2) -> None:
    done = ros2('doctor')

    assert (done.returncode, done.stdout) == (0, '\nAll 5 checks passed\n\n'), done.stderr
    assert 'topic: WARNING: Publisher without subscriber detected on /zoo/sign.\n' in done.stderr
    assert 'Subscriber without publisher detected on /zoo/ear.\n' in done.stderr
    strict = ros2('wtf', '--include-warnings')
    assert strict.returncode == 1
    assert '\nFailed modules: topic' in strict.stdout


def test_a_broken_environment_fails(ros2: Ros2, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv('ROS_DISTRO')

    done = ros2('doctor', '--report-failed')

    assert done.returncode == 1
    assert '\n1/5 check(s) failed\n' in done.stdout
    assert 'platform: ERROR: ROS_DISTRO is not set: source ' in done.stderr
    assert '\n   PLATFORM INFORMATION\n' in done.stdout
    assert '\n   TOPIC LIST\n' not in done.stdout


def test_the_report_has_every_section(ros2: Ros2) -> None:
    done = ros2('doctor', '--report')

    for title in (
        'NETWORK CONFIGURATION', 'PACKAGE VERSIONS', 'PLATFORM INFORMATION',
        'QOS COMPATIBILITY LIST', 'RMW MIDDLEWARE', 'ROS 2 INFORMATION', 'ROS ENVIRONMENT',
        'SERVICE LIST', 'TOPIC LIST',
    ):  # fmt: skip
        assert f'\n   {title}\n' in done.stdout
    assert 'topic            : /zoo/sign [std_msgs/msg/String]\n' in done.stdout
    assert 'middleware name : rmw_fastrtps_cpp\n' in done.stdout
