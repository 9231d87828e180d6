# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A small graph in another process, and the stand-in called on it."""

from __future__ import annotations

import io
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
SCRIPT = ROOT / 'scripts' / 'ros2'

Done = subprocess.CompletedProcess[str]


@pytest.fixture(scope='session')
def zoo() -> Iterator[dict[str, str]]:
    """Start the graph of zoo.py; yields the environment in which it is seen."""
    pytest.importorskip('rclpy')
    from aurora_ros.testing.domains import own_domain
    from aurora_ros2cli.discovery import participants_here

    paths = [str(ROOT), os.environ.get('PYTHONPATH', '')]
    with ExitStack() as stack:
        domain = stack.enter_context(own_domain())
        # A graph that somebody started by hand there would show up in every list.
        while participants_here(domain):
            domain = stack.enter_context(own_domain())
        environment = {
            **os.environ,
            'ROS_DOMAIN_ID': str(domain),
            'PYTHONPATH': os.pathsep.join(paths),
        }
        with subprocess.Popen(
            [sys.executable, str(Path(__file__).parent / 'zoo.py')],
            env=environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        ) as process:
            assert process.stdout is not None
            assert process.stdout.readline() == 'ready\n'
            yield environment
            process.kill()


@pytest.fixture
def ros2(
    zoo: dict[str, str], monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> Callable[..., Done]:
    """Call the stand-in in this process, which spares a start of Python for each call."""
    from aurora_ros2cli.main import main

    monkeypatch.setenv('ROS_DOMAIN_ID', zoo['ROS_DOMAIN_ID'])

    def call(*arguments: str, given: str = '') -> Done:
        monkeypatch.setattr(sys, 'stdin', io.StringIO(given))
        capfd.readouterr()
        try:
            code = main(arguments)
        except SystemExit as stop:
            code = int(stop.code or 0)
        out, err = capfd.readouterr()
        return subprocess.CompletedProcess(arguments, code, out, err)

    return call


@pytest.fixture
def started(zoo: dict[str, str]) -> Iterator[Callable[..., subprocess.Popen[str]]]:
    """Start the stand-in in a process of its own, for what runs until it is stopped."""
    running: list[subprocess.Popen[str]] = []

    def start(*arguments: str) -> subprocess.Popen[str]:
        process = subprocess.Popen(
            [sys.executable, str(SCRIPT), *arguments],
            env=zoo,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        running.append(process)
        return process

    yield start
    for process in running:
        process.kill()
        process.communicate()
