# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the verifier says about a mutant, in memory or through a bag.

What is asked is what conditions and cross-checks find by themselves, so the executor is not
stepped over the recorded states; what that finds is counted apart.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from aurora_bench.mutation.bag import write_bag
from aurora_bench.mutation.mutant import Mutant
from aurora_cli.installed import installed
from aurora_core.agsg.message import agsg_message, read_agsg
from aurora_core.errors import AuroraError
from aurora_core.judging.codec import conditions_from_json
from aurora_core.monitor.plan_check import Plan
from aurora_core.outcomes.verdict import Verdict
from aurora_core.pipeline.verification import (
    load_bag,
    recomputed_content,
    recorded_plan,
    verify_content,
)
from aurora_core.report.doubts import doubted, trace_doubts
from aurora_core.report.run_folder import REPORT
from aurora_core.trace.bag_content import BagContent
from aurora_core.trace.bag_metadata import METADATA
from aurora_core.trace.definitions import MessageDefinitions
from aurora_core.trace.hashing import trace_sha256
from aurora_core.trace.messages import MessageBuilder
from aurora_system_tests.local_runs import names_of

# The verifier refused to judge: not even inconclusive.
REFUSED = 'refused'


@dataclass(frozen=True, kw_only=True)
class Judgement:
    """What was said.

    Attributes:
        status: Of the verdict, `refused` when the record was not even read.
        names: What was complained of, see `names_of`; `refused` when it was not even read.
        text: Why it was refused.
    """

    status: str
    names: frozenset[str]
    text: str = ''

    @property
    def passed(self) -> bool:
        """Whether it was believed that everything holds."""
        return self.status == 'verified'


def in_memory(mutant: Mutant) -> Judgement:
    """Judge it as if every digest had been stamped anew."""
    content = BagContent(trace=mutant.trace, world=mutant.world, agsg_message=None)
    return _judged(lambda: verify_content(installed(), content, mutant.agsg, recompute=False))


def by_recomputation(mutant: Mutant) -> bool:
    """Tell whether the executor gives other commands or claims from the states of a mutant."""
    content = BagContent(trace=mutant.trace, world=mutant.world, agsg_message=None)
    try:
        conditions = conditions_from_json(mutant.world.conditions_json)
        plan = recorded_plan(installed(), mutant.world, conditions, mutant.agsg)
        return isinstance(plan, Plan) and bool(
            recomputed_content(installed(), content, mutant.agsg)
        )
    except AuroraError:
        return False


def unstamped_in_memory(mutant: Mutant, definitions: MessageDefinitions) -> Judgement:
    """Judge it beside the digests of the recording: of the graph, of the trace in the report."""

    def verdict() -> Verdict:
        agsg = mutant.agsg
        if agsg is not mutant.base.agsg:
            header = MessageBuilder(definitions, 1, mutant.trace.roster.dt_s).header(0)
            message = agsg_message(definitions.create, header, 'run', agsg)
            message.sha256 = mutant.base.agsg.sha256
            agsg = read_agsg(message)
        sha256 = trace_sha256(mutant.trace, mutant.world)
        content = BagContent(trace=mutant.trace, world=mutant.world, agsg_message=None)
        found = verify_content(installed(), content, agsg, recompute=False)
        return doubted(found, trace_doubts(found, sha256, mutant.base.reported.sha256, REPORT))

    return _judged(verdict)


def through_bag(
    mutant: Mutant, folder: Path, definitions: MessageDefinitions, *, stamped: bool
) -> Judgement:
    """Write it as a bag and judge that; not stamped: beside the metadata of the recording."""
    bag = write_bag(mutant, folder, definitions)
    if not stamped:
        (bag / METADATA).write_bytes((mutant.base.bag / METADATA).read_bytes())
    return judge_bag(bag)


def judge_bag(bag: Path) -> Judgement:
    """Judge what is in a bag."""

    def verdict() -> Verdict:
        content, agsg = load_bag(bag)
        return verify_content(installed(), content, agsg, recompute=False)

    return _judged(verdict)


def _judged(verdict: Callable[[], Verdict]) -> Judgement:
    try:
        found = verdict()
    except AuroraError as err:
        return Judgement(status=REFUSED, names=frozenset({REFUSED}), text=str(err))
    return Judgement(status=found.status.value, names=names_of(found))
