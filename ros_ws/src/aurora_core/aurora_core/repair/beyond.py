# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What no other realisation mends, because a value that is locked stands in the way.

Only what is certain is told: a link that is slower than a message may be, or that loses all.
"""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.repair import Implicated
from aurora_core.outcomes.verdict import Verdict
from aurora_core.repair.localize import violated
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Link

_ARRIVES = (QuantityName.DELIVERED, QuantityName.DELIVERY_LATENCY)


def beyond_repair(agsg: Agsg, verdict: Verdict) -> tuple[Implicated, ...]:
    """Return the locked values for which a violated condition cannot hold, with the reason.

    Args:
        agsg: Grounded, as it was executed.
        verdict: Of its trace.
    """
    conditions = {condition.id: condition for condition in agsg.conditions}
    links = {link.id: link for link in agsg.spec.links}
    found: dict[str, Implicated] = {}
    for row in violated(verdict):
        condition = conditions.get(row.id)
        link = None if condition is None else links.get(condition.arguments.link or '')
        if condition is None or link is None:
            continue
        for path, reason in _of_a_link(link, condition):
            found.setdefault(
                path, Implicated(field=path, score=1.0, conditions=(row.id,), reason=reason)
            )
    return tuple(found.values())


def _of_a_link(link: Link, condition: Condition) -> Iterator[tuple[str, str]]:
    if condition.quantity not in _ARRIVES or condition.op not in ('<', '<='):
        return
    slow_s = link.latency_s.value
    if slow_s > condition.threshold:
        yield (
            f'links/{link.id}/latency_s',
            f'{condition.id} allows {condition.threshold:g} s, and a message takes {slow_s:g} s',
        )
    if link.loss.value >= 1.0:
        yield f'links/{link.id}/loss', f'{condition.id} waits for a message, and all are lost'
