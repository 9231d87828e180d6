# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 launch` on a small install prefix, and on the launch file of AURORA."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from aurora_ros2cli.errors import CliError
from aurora_ros2cli.launching.command import commands_of, load

ROOT = Path(__file__).resolve().parents[1]
AURORA = ROOT.parent / 'aurora_bringup' / 'launch' / 'aurora.launch.py'
HEAD = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, Shutdown
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
"""


@pytest.fixture
def prefix(tmp_path: Path) -> Path:
    (tmp_path / 'share' / 'ament_index' / 'resource_index' / 'packages').mkdir(parents=True)
    (tmp_path / 'share' / 'ament_index' / 'resource_index' / 'packages' / 'garage').touch()
    (tmp_path / 'share' / 'garage' / 'launch').mkdir(parents=True)
    for name, body in (
        ('drive', 'echo "drive $*"; exit ${CODE:-0}'),
        ('wait', 'trap "echo leaving; exit 0" INT; echo up; while :; do sleep 0.05; done'),
    ):
        path = tmp_path / 'lib' / 'garage' / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f'#!/usr/bin/env bash\n{body}\n')
        path.chmod(0o755)
    return tmp_path


def _launch(prefix: Path, entities: str, *words: str) -> subprocess.Popen[str]:
    file = prefix / 'share' / 'garage' / 'launch' / 'all.launch.py'
    file.write_text(
        f'{HEAD}\ndef generate_launch_description():\n    return LaunchDescription([{entities}])\n'
    )
    return subprocess.Popen(
        [sys.executable, str(ROOT / 'scripts' / 'ros2'), 'launch', *words],
        env={
            'PATH': os.environ['PATH'],
            'PYTHONPATH': str(ROOT),
            '_ROS_WHEELS_BOOTSTRAP_COMPLETE': '1',
            'AMENT_PREFIX_PATH': str(prefix),
        },
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


FILE = ('garage', 'all.launch.py')


def test_it_starts_nodes_with_names_parameters_and_arguments(prefix: Path) -> None:
    process = _launch(
        prefix,
        "DeclareLaunchArgument('speed', default_value='3'),"
        "Node(package='garage', executable='drive', name='car', namespace='/town',"
        " parameters=[{'speed': LaunchConfiguration('speed'), 'loud': True}],"
        " remappings=[('in', 'out')], arguments=['-v']),"
        "ExecuteProcess(cmd=['bash', '-c', 'exit 3'], name='broken')",
        *FILE,
        'speed:=5',
    )
    out, err = process.communicate(timeout=60)

    assert (process.returncode, err) == (0, '')
    assert (
        '[drive-1] drive -v --ros-args -r __node:=car -r __ns:=/town -r in:=out '
        '-p speed:=5 -p loud:=true\n'
    ) in out
    assert '[INFO] [drive-1]: process has finished cleanly [pid ' in out
    assert '[ERROR] [broken-2]: process has died [pid ' in out
    assert 'exit code 3, cmd ' in out


def test_ctrl_c_ends_all_of_them(prefix: Path) -> None:
    node = "Node(package='garage', executable='wait')"
    process = _launch(prefix, f'{node}, {node}', *FILE)
    assert process.stdout is not None
    seen = ''
    while not ('[wait-1] up' in seen and '[wait-2] up' in seen):
        seen += process.stdout.readline()

    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=60)

    assert process.returncode == 0
    for name in ('wait-1', 'wait-2'):
        assert f'[{name}] leaving\n' in out
        assert f'[INFO] [{name}]: process has finished cleanly' in out


def test_the_end_of_one_can_end_the_others(prefix: Path) -> None:
    process = _launch(
        prefix,
        "Node(package='garage', executable='wait'),"
        "ExecuteProcess(cmd=['sleep', '0.5'], on_exit=Shutdown())",
        *FILE,
    )
    out, _ = process.communicate(timeout=60)

    assert process.returncode == 0
    assert '[wait-1] leaving\n' in out


@pytest.mark.parametrize(
    ('entities', 'words', 'message'),
    [
        ('', ('garage', 'none.launch.py'), "file 'none.launch.py' was not found"),
        ('', ('nowhere', 'x.launch.py'), "Package 'nowhere' not found"),
        ('', ('garage',), 'name a package and its launch file'),
        ("Node(package='garage', executable='fly')", FILE, "executable 'fly' not found"),
        ("DeclareLaunchArgument('speed')", FILE, "argument 'speed' was not provided"),
        ('', (*FILE, 'speed=5'), "malformed launch argument 'speed=5'"),
        ("Node(package='garage', executable='drive', prefix='gdb')", FILE, 'full ROS 2'),
        ("ExecuteProcess(cmd=['/no/such'])", FILE, '/no/such: No such file'),
    ],
)
def test_it_says_what_is_wrong(
    prefix: Path, entities: str, words: tuple[str, ...], message: str
) -> None:
    process = _launch(prefix, entities, *words)
    _, err = process.communicate(timeout=60)

    assert process.returncode == 1
    assert message in err
    assert 'Traceback' not in err


def test_arguments_are_shown(prefix: Path) -> None:
    process = _launch(
        prefix,
        "DeclareLaunchArgument('speed', default_value='3', description='in m/s')",
        *FILE,
        '--show-args',
    )
    out, _ = process.communicate(timeout=60)

    assert "'speed':\n        in m/s\n        (default: '3')\n" in out


def test_what_is_not_here_is_named(tmp_path: Path) -> None:
    file = tmp_path / 'x.launch.py'
    file.write_text('from launch.actions import GroupAction\n')
    with pytest.raises(CliError, match='GroupAction'):
        load(file)


def test_the_graph_of_aurora_can_be_launched(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        'aurora_ros2cli.launching.description.executables',
        lambda package: [Path(f'/lib/{package}/{name}') for name in PARTS[package]],
    )
    commands = commands_of(load(AURORA), {})
    assert {command.name for command in commands} >= {'sync', 'executor', 'ros2'}
    nodes = sum(len(parts) for parts in PARTS.values())
    assert len(commands) == nodes + 1


PARTS = {
    'aurora_sync': ('sync',),
    'aurora_sumo_bridge': ('sumo_bridge',),
    'aurora_uav_bridge': ('uav_bridge',),
    'aurora_nodes': (
        'recorder', 'monitor', 'executor', 'grounding', 'parser', 'repair', 'orchestrator',
    ),
}  # fmt: skip
