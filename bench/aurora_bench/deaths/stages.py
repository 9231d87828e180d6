# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""R6: every node dies in three ways in every stage that `aurora_bench.faults` leaves out."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Iterable
from enum import StrEnum
from itertools import product

from aurora_bench.faults.client import Client, Run, trace_hash
from aurora_bench.faults.live_graph import CALL_LIMIT_S, NAMES, CampaignError, LiveGraph, wait_for
from aurora_bench.faults.matrix import LIMITS_S, WHOLE_LIMIT_S, Blow
from aurora_bench.faults.matrix import PROMPT as VERIFIED
from aurora_core.document import Document

# Nowhere does a car get as fast: repair is asked, and its one candidate is tried in vain.
VIOLATED = (
    'A scenario of 15 seconds. A drone tracks a car. When the car is faster than 24 m/s, the '
    'drone alerts the ego car.'
)
FLYING_FROM_S = 5.0
UP_LIMIT_S = 60
UP = ('ros2', 'run', 'aurora_bringup', 'up', '--detach', '--timeout', str(UP_LIMIT_S))
# What `up` may take beyond its limit to end what it has started.
_STOP_S = 20.0
_CLIENT = 'orchestrator'  # the one that the client itself talks to


class Stage(StrEnum):
    """When."""

    STARTING = 'starting'
    PARSING = 'parsing'
    GROUNDING = 'grounding'
    LOADING = 'loading'
    FLYING = 'flying'
    VERIFYING = 'verifying'
    REPAIRING = 'repairing'


# In these `aurora_bench.faults` strikes whoever takes part in a tick or judges it.
_STRUCK_ELSEWHERE = (Stage.LOADING, Stage.FLYING, Stage.VERIFYING)
_ONLY_HERE = ('parser', 'grounding', 'repair', _CLIENT)


class Death(Document):
    """Who dies, how and when."""

    node: str
    blow: Blow
    stage: Stage

    @property
    def name(self) -> str:
        """As `--only` matches it."""
        return f'{self.node}-{self.blow}-{self.stage}'

    @property
    def prompt(self) -> str:
        """The prompt in whose run it happens."""
        return VIOLATED if self.stage is Stage.REPAIRING else VERIFIED


class DeathResult(Document):
    """What came of it.

    Attributes:
        hit_at: Stage and simulated time of the last feedback at the moment of the blow.
        seconds: From the blow to the end of the run, or of `up`.
        status: Of the run; `up N` with the exit code of `up`.
        named: Component of the error, or the dead node when `up` named it.
        as_undisturbed: Status and trace are those of a run in which nobody died.
        left: What was left behind.
        next_equal: The prompt sent next left the same trace as ever.
        note: What went wrong with the case itself.
    """

    death: Death
    hit_at: str = ''
    seconds: float = 0.0
    status: str = ''
    named: str = ''
    as_undisturbed: bool = False
    left: tuple[str, ...] = ()
    next_equal: bool = False
    note: str = ''

    @property
    def held(self) -> bool:
        """Whether everything was as it must be.

        Nobody waits for ever; the run ends as an error that names who died, or as it does when
        nobody dies: then the dead one had no part in it any more.
        """
        return (
            not self.note and self.is_told and not self.left and self.next_equal and self.in_time
        )

    @property
    def is_told(self) -> bool:
        """Whether who asked was told the truth."""
        if self.death.stage is Stage.STARTING:
            return self.status == 'up 0' or (
                self.status == 'up 1' and self.named == self.death.node
            )
        if self.as_undisturbed:
            return True
        return self.status == 'error' and self.named == self.death.node

    @property
    def in_time(self) -> bool:
        """Whether the answer came within the limit; an undisturbed end takes as long as ever."""
        if self.death.stage is Stage.STARTING:
            return self.seconds <= UP_LIMIT_S + _STOP_S
        return self.as_undisturbed or self.seconds <= LIMITS_S[self.death.blow]


def deaths(only: Iterable[str] = ()) -> list[Death]:
    """Return the deaths whose name holds one of the words, all without words."""
    words = tuple(only)
    # In turn: `up` gives up a node that dies too often within a minute.
    every = [
        Death(node=node, blow=blow, stage=stage)
        for stage, blow, node in product(Stage, Blow, NAMES)
        if stage not in _STRUCK_ELSEWHERE or node in _ONLY_HERE
    ]
    return [one for one in every if not words or any(word in one.name for word in words)]


class Undisturbed:
    """How the prompts end when nobody dies: status and trace hash, each run once."""

    def __init__(self, graph: LiveGraph, client: Client) -> None:
        self._graph, self._client = graph, client
        self._known: dict[str, tuple[str, str]] = {}

    def end(self, prompt: str) -> tuple[str, str]:
        """Return status and trace hash.

        Raises:
            CampaignError: It leaves no trace.
        """
        if prompt not in self._known:
            make_whole(self._graph)
            run = self._client.run(prompt, options(prompt))
            known = (str(getattr(run.result, 'status', run.error)), trace_hash(run.result))
            if not known[1]:
                raise CampaignError(f'undisturbed, {prompt!r} ends as {known[0]} without a trace')
            self._known[prompt] = known
        return self._known[prompt]


def options(prompt: str) -> dict[str, int]:
    """Return what is asked for beside a prompt: one candidate of repair, or none."""
    return {'repair': int(prompt == VIOLATED)}


def make_whole(graph: LiveGraph) -> None:
    """Have every node serve: start what there is not."""
    if not graph.pid('up') or not graph.processes():
        graph.up()
    wait_for('every node serves', graph.is_whole, WHOLE_LIMIT_S)


def strike(graph: LiveGraph, client: Client, known: Undisturbed, death: Death) -> DeathResult:
    """Let a node die and look what comes of it."""
    known.end(VERIFIED)
    if death.stage is Stage.STARTING:
        found = _while_starting(graph, death)
    else:
        known.end(death.prompt)
        found = _in_a_run(graph, client, known, death)
    if found.note:
        return found
    make_whole(graph)
    after = client.run(VERIFIED, options(VERIFIED))
    equal = trace_hash(after.result) == known.end(VERIFIED)[1]
    return found.model_copy(update={'next_equal': equal})


def _while_starting(graph: LiveGraph, death: Death) -> DeathResult:
    graph.down()
    process = graph.begin(UP)
    try:
        wait_for('the node begins', lambda: graph.pid(death.node) > 0, WHOLE_LIMIT_S)
        used = graph.footprint()
        os.kill(graph.pid(death.node), signal.Signals[death.blow])
        struck_s = time.monotonic()
        said, _ = process.communicate(timeout=CALL_LIMIT_S)
    except (CampaignError, OSError) as err:
        process.kill()
        process.communicate()
        return DeathResult(death=death, note=str(err))
    seconds = time.monotonic() - struck_s
    is_named = any(death.node in line for line in said.splitlines() if 'error:' in line)
    return DeathResult(
        death=death,
        hit_at='up',
        seconds=round(seconds, 2),
        status=f'up {process.returncode}',
        named=death.node if is_named else said[-200:],
        left=() if process.returncode == 0 else tuple(graph.leftovers(used)),
    )


def _in_a_run(graph: LiveGraph, client: Client, known: Undisturbed, death: Death) -> DeathResult:
    make_whole(graph)
    run = client.begin(death.prompt, options(death.prompt))
    if not run.wait_until(lambda now: is_time(now, death.stage)):
        ended = f'{run.result.status}, {run.result.error_msg}' if run.result else run.error
        return DeathResult(death=death, note=f'ended before {death.stage}: {ended}')
    os.kill(graph.pid(death.node), signal.Signals[death.blow])
    struck_s = time.monotonic()
    hit_at = f'{run.stage} {run.sim_time_s:.1f} s'
    result = run.wait()
    seconds = round((run.reported_s or run.ended_s) - struck_s, 2)
    facts = {'death': death, 'hit_at': hit_at, 'seconds': seconds}
    if result is None:
        # Whoever sent the prompt is told that its server is gone.
        told = death.node == _CLIENT and _CLIENT in run.error
        return DeathResult.model_validate(
            {**facts, 'status': 'error', 'named': death.node if told else run.error}
        )
    status, whole = known.end(death.prompt)
    # Of what is violated the best realisation is shown: it may be another one without repair.
    same = str(result.status) == status and (status != 'verified' or trace_hash(result) == whole)
    return DeathResult.model_validate(
        {
            **facts,
            'status': str(result.status),
            'named': str(result.error_msg).partition(':')[0],
            'as_undisturbed': same,
        }
    )


def is_time(run: Run, stage: Stage) -> bool:
    """Return whether a run is in a stage."""
    if stage is Stage.LOADING:
        return run.stage == 'execute' and run.sim_time_s == 0.0
    if stage is Stage.FLYING:
        return run.stage == 'execute' and run.sim_time_s >= FLYING_FROM_S
    names = {
        Stage.PARSING: 'parse',
        Stage.GROUNDING: 'ground',
        Stage.VERIFYING: 'verify',
        Stage.REPAIRING: 'repair',
    }
    return run.stage == names[stage]
