# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What can be had of a bag whose writer was killed, and whether it is what was recorded."""

from __future__ import annotations

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
    for path in (bag, Path(recovery.bag)):
        judgement = judge(path)
        known = {'truncated', 'unknown'}
        if path != bag:
            known.add('altered')  # it has not the name of a bag of the run that it lies in
        if recovery.last_complete_tick <= 0:
            known.add('')  # killed within the first ticks: there may be nothing to judge
        if not judgement.refused or judgement.integrity not in known:
            problems.append(f'{path.name} is {judgement.integrity}, exit code {judgement.code}')
    trace = read_bag(Path(recovery.bag), definitions).trace
    upto = recovery.last_complete_tick + 1
    if not (
        np.array_equal(trace.ground[:upto], reference.ground[:upto])
        and np.array_equal(trace.uav[:upto], reference.uav[:upto])
        and trace.ground_commands[:upto] == reference.ground_commands[:upto]
    ):
        problems.append('a recovered value differs from the undisturbed run')
    return recovery.complete_s, problems
