# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The graph that `up` has started in this domain: who lives, who does not, what is left behind."""

from __future__ import annotations

from aurora_cli.doctor.machine import Finding, Machine
from aurora_cli.doctor.processes import NODES, NodeFiles, node_files

_UP = 'up'
_RESTART = 'ros2 run aurora_bringup down; ros2 run aurora_bringup up'
# Left by the supervision beside a node's pid file.
_GIVEN_UP = '.failed'


def nodes(machine: Machine) -> list[Finding]:
    """All nodes run, or none; none is stopped; nothing is left of dead ones."""
    files = node_files(machine.run_dir, machine.proc)
    findings = [*_dead(files), *_stopped(files), *_lonely_ready_files(machine, files)]
    living = {node.name for node in files if node.state}
    missing = [name for name in NODES if name not in living]
    if living & set(NODES) and missing:
        findings.append(
            Finding(
                expected='all nodes of the graph or none',
                found=f'{", ".join(missing)} not running, {len(NODES) - len(missing)} others are',
                fix=_RESTART,
            )
        )
    for node in files:
        if node.state not in ('', 'T') and node.name != _UP and not node.is_ready:
            log = machine.run_dir / 'log' / f'{node.name}.log'
            findings.append(
                Finding(
                    expected=f'{node.name} serves (a ready file beside its pid file)',
                    found=f'process {node.pid} lives and is not ready: starting, or hanging',
                    fix=f'tail {log}; if it stays so: {_RESTART}',
                )
            )
    for path in sorted(machine.run_dir.glob(f'*{_GIVEN_UP}')):
        findings.append(
            Finding(
                expected=f'{path.stem} serves',
                found='it died again after every restart and was given up',
                fix=f'tail {machine.run_dir}/log/{path.stem}.log; then: {_RESTART}',
            )
        )
    return findings


def running(machine: Machine) -> list[str]:
    """Return the names of the nodes that run."""
    files = node_files(machine.run_dir, machine.proc)
    return [node.name for node in files if node.state and node.name != _UP]


def _dead(files: list[NodeFiles]) -> list[Finding]:
    return [
        Finding(
            expected=f'the process of {node.name} that {node.pid_file.name} names',
            found=f'process {node.pid} has ended' if node.pid is not None else 'no process id',
            fix='ros2 run aurora_bringup down (or aurora doctor --fix)',
            dead=(node.pid_file, node.ready_file) if node.is_ready else (node.pid_file,),
        )
        for node in files
        if not node.state
    ]


def _stopped(files: list[NodeFiles]) -> list[Finding]:
    return [
        Finding(
            expected=f'{node.name} runs',
            found=f'process {node.pid} is stopped (SIGSTOP or Ctrl-Z)',
            fix=f'kill -CONT {node.pid}',
        )
        for node in files
        if node.state == 'T'
    ]


def _lonely_ready_files(machine: Machine, files: list[NodeFiles]) -> list[Finding]:
    known = {node.name for node in files}
    return [
        Finding(
            expected='a ready file only while its node serves',
            found=f'{path} without a pid file',
            fix='aurora doctor --fix',
            dead=(path,),
        )
        for path in sorted(machine.run_dir.glob('*.ready'))
        if path.stem not in known
    ]
