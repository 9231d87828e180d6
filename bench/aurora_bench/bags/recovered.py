# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What can be had of a bag whose writer was killed, and whether it is what was recorded."""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path

import numpy as np
from rosbags.highlevel import AnyReader

from aurora_bench.bags.judge import judge
from aurora_core.errors import BagError
from aurora_core.trace.bag_reader import read_bag
from aurora_core.trace.bag_recover import recover_bag
from aurora_core.trace.definitions import MessageDefinitions
from aurora_core.trace.trace import Trace


def recovered(
    bag: Path, reference: Trace, definitions: MessageDefinitions
) -> tuple[float, list[str]]:
    """Recover a bag; return up to which simulated time it is complete and what is wrong, s.

    Args:
        bag: Its folder, which must stay as it is.
        reference: Of the same request, undisturbed.
        definitions: Of the messages.
    """
    before = {path.name: path.read_bytes() for path in bag.iterdir()}
    problems = []
    try:
        recovery = recover_bag(bag, None, definitions)
    except BagError as err:
        # Killed before roster and world were stored: there is nothing to recover yet, and the
        # limit of what may be lost judges whether that was early enough.
        if not judge(bag).refused:
            problems.append(f'a bag without content is judged: {err}')
        return 0.0, problems
    if {path.name: path.read_bytes() for path in bag.iterdir()} != before:
        problems.append('the original was changed')
    with AnyReader([Path(recovery.bag)]) as reader:
        if sum(recovery.kept.values()) != sum(1 for _ in reader.messages()):
            problems.append('rosbags reads another number of messages')
    known = {'truncated', 'unknown'}
    if recovery.last_complete_tick <= 0:
        known.add('')  # killed within the first ticks: there may be nothing to judge
    with tempfile.TemporaryDirectory() as apart:
        # In a run folder it is called altered for its name alone, whatever it holds.
        copy = Path(shutil.copytree(recovery.bag, Path(apart) / 'bag'))
        for path in (bag, copy):
            found = judge(path)
            if not found.refused or found.integrity not in known:
                problems.append(f'{path.name} is {found.integrity}, exit code {found.code}')
    trace = read_bag(Path(recovery.bag), definitions).trace
    upto = recovery.last_complete_tick + 1
    if not (
        np.array_equal(trace.ground[:upto], reference.ground[:upto])
        and np.array_equal(trace.uav[:upto], reference.uav[:upto])
        and trace.ground_commands[:upto] == reference.ground_commands[:upto]
    ):
        problems.append('a recovered value differs from the undisturbed run')
    return recovery.complete_s, problems
