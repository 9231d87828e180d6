# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Chance in the ledger against the draws that the seed of the run gives: luck cannot be forged."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.comm.link import link_stream
from aurora_core.comm.reach import reach_of
from aurora_core.judging.evaluation import Context
from aurora_core.outcomes.verdict import Finding
from aurora_core.spec.scenario import Link
from aurora_core.trace.records import LinkEventKind, LossReason

_ATTEMPTS = (LinkEventKind.ATTEMPT_LOST, LinkEventKind.ATTEMPT_PASSED)
_FAULT = 'link_loss'
_ALL_LINKS = '*'


def chance_findings(context: Context, seed: int) -> Iterator[Finding]:
    """Yield, link by link, the first attempt whose luck is not that of its draw.

    A link that has an injected loss is left out: faults are injected again in the recomputation.

    Args:
        context: The run.
        seed: Of the run.
    """
    faulty = {
        record.subject for record in context.view.trace.events if record.fault_kind == _FAULT
    }
    for link in context.spec.links:
        if link.id not in faulty and _ALL_LINKS not in faulty:
            yield from _link(context, link, seed)


def _link(context: Context, link: Link, seed: int) -> Iterator[Finding]:
    draws, reach = link_stream(seed, link.id), reach_of(link, context.view.world.limits)
    for record in context.view.trace.links:
        if record.link != link.id or record.kind not in _ATTEMPTS:
            continue
        chance = reach.chance(link.loss.value, record.distance_m, record.line_of_sight)
        lost = bool(draws.random() < chance)  # one draw for each, in range or not
        passed = record.kind is LinkEventKind.ATTEMPT_PASSED
        if (passed and lost) or (record.reason is LossReason.RANDOM and not lost):
            yield Finding(
                kind='chance',
                subject=f'message {record.message} on {link.id}',
                tick=record.tick,
                time_s=context.time_s(record.tick),
                text=(
                    f'attempt {record.attempt} is recorded as {record.kind.name}, the draw of '
                    f'seed {seed} is {"lost" if lost else "passed"}'
                ),
            )
            return  # from here on the draws may belong to other attempts
