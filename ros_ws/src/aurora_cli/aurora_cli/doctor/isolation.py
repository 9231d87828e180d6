# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who reaches the graph of this domain."""

from __future__ import annotations

import stat
from pathlib import Path

from aurora_cli.doctor.machine import Finding, Machine
from aurora_cli.doctor.processes import node_files
from aurora_cli.isolation import refusal, same_network

_KEY = 'AURORA_MAVLINK_KEY_FILE'
_UP = 'up'


def key_file(machine: Machine) -> list[Finding]:
    """A key of the user for MAVLink is there, and nobody else may read it."""
    named = machine.environment.get(_KEY, '')
    if not named:
        return []
    try:
        mode = Path(named).stat().st_mode
    except OSError as err:
        found, fix = err.strerror or str(err), f'unset {_KEY} (up makes a key for each graph)'
    else:
        if not mode & (stat.S_IRWXG | stat.S_IRWXO):
            return []
        found, fix = f'others may read it ({stat.filemode(mode)})', f'chmod 600 {named}'
    return [Finding(expected=f'{_KEY} names a file for this user alone', found=found, fix=fix)]


def who_reaches(machine: Machine) -> str:
    """Return who can send to the graph that runs, or to one that is started."""
    signed = machine.environment.get(_KEY) != ''
    mavlink = '' if signed else f'; MAVLink is not signed ({_KEY} is empty)'
    for node in node_files(machine.run_dir, machine.proc):
        if node.name == _UP and node.state and node.pid is not None:
            try:
                shared = same_network(node.pid)
            except OSError:
                return f"the graph is another user's{mavlink}"
            if shared:
                return (
                    'every process here that joins the domain reaches the graph '
                    f'(up --isolated keeps others out){mavlink}'
                )
            return f'the graph has a network of its own{mavlink}'
    why = refusal()
    if why:
        return f'every process here reaches a graph: no network of its own, {why}{mavlink}'
    return f'a graph of aurora run has a network of its own, one of up with --isolated{mavlink}'
