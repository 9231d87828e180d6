# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from aurora_core.judging.quantities.free_speed import FreeSpeed
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.verdict import ConditionResult, Reason, Verdict, VerdictStatus
from aurora_core.pipeline.functions import ground_stage, parse_stage
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.repair.unshown import never_shown
from aurora_core.trace.trace import Integrity

_KNOWN = installed_knowledge()
_NETWORK = _KNOWN.map('downtown').network


def grounded(prompt: str) -> Agsg:
    graph = parse_stage(_KNOWN, prompt, 'downtown', 1).agsg
    assert graph is not None
    found = ground_stage(_KNOWN, graph, 1).agsg
    assert found is not None
    return found


def verdict_on(agsg: Agsg, reason: Reason | None) -> Verdict:
    """Return a verdict in which a stated speed has no margin for a reason."""
    [condition] = [c for c in agsg.conditions if isinstance(c.arguments, FreeSpeed)]
    row = ConditionResult(
        id=condition.id,
        sentence=condition.sentence,
        explanation='',
        formula=condition.formula,
        op=condition.op,
        threshold=condition.threshold,
        margin=None if reason is not None else -0.2,
        normalised=None if reason is not None else -0.2,
        unit=condition.unit,
        reason=reason,
        satisfied=False,
        exercised=reason is None,
        provenance=condition.provenance,
    )
    return Verdict(status=VerdictStatus.VIOLATED, results=(row,), integrity=Integrity.INTACT)


def test_a_place_where_a_speed_cannot_show_is_named_and_a_free_way_is_not() -> None:
    whole = grounded('A scenario of 30 seconds. A car drives at 10 m/s.')
    assert whole.grounding is not None
    [car] = whole.grounding.agents
    # The same way, of which it comes no farther than the corner behind it.
    turned = car.model_copy(update={'route_xy_m': corner_of(whole)})
    scene = whole.grounding.model_copy(update={'agents': (turned,)})
    cut = whole.model_copy(update={'grounding': scene})
    verdict = verdict_on(whole, Reason.EMPTY_PHASE)
    assert list(never_shown(verdict, whole, _NETWORK)) == []
    [told] = never_shown(verdict, cut, _NETWORK)
    assert 'would not show there either: 0 m of its way' in told
    # What was measured, and missed, may be met at any place.
    assert list(never_shown(verdict_on(whole, None), cut, _NETWORK)) == []


def corner_of(agsg: Agsg) -> tuple[tuple[float, float], ...]:
    """Return a short way that ends where a lane does."""
    assert agsg.grounding is not None
    x, y = _NETWORK.lane(agsg.grounding.agents[0].lane_id).polyline[-1][:2]
    return ((float(x) - 30.0, float(y)), (float(x), float(y)))
