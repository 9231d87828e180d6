# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A repaired realisation is judged by its request; a forged one cannot weaken what is judged."""

from __future__ import annotations

from typing import Any

import pytest

from aurora_core.agsg.build import build_agsg
from aurora_core.errors import VerificationError
from aurora_core.judging.codec import conditions_from_json
from aurora_core.monitor.plan_check import Plan
from aurora_core.outcomes.agsg import Agsg, Stage
from aurora_core.outcomes.repair import Anchor, RepairPlan, ValueEdit
from aurora_core.pipeline.functions import execution_stage, ground_stage, parse_stage
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.pipeline.verification import recorded_plan
from aurora_core.repair.attempts import anchor_of

_KNOWN = installed_knowledge()
PROMPT = (
    'A van tailgates the ego car closely, closing from 45 meters; a tracking drone alerts the ego '
    'when the van comes within 20 meters.'
)
ALTITUDE = 'missions/m1/altitude_m'


@pytest.fixture(scope='module')
def parsed() -> Agsg:
    graph = parse_stage(_KNOWN, PROMPT, 'downtown', 1).agsg
    assert graph is not None
    return graph


def edit(graph: Agsg, path: str, realised: float) -> ValueEdit:
    row = next(p for p in graph.parameters if p.path == path)
    return ValueEdit(
        path=path, requested=row.requested, realised=realised, provenance=row.provenance
    )


def grounded(graph: Agsg, plan: RepairPlan | None = None) -> Agsg:
    found = ground_stage(_KNOWN, graph, 1, plan).agsg
    assert found is not None
    return found


def findings(graph: Agsg) -> set[tuple[str, str]]:
    world = execution_stage(_KNOWN, graph, 1, ()).world
    plan = recorded(graph, world)
    return {(finding.kind, finding.subject) for finding in plan.documents}


def recorded(graph: Agsg, world: Any) -> Plan:
    plan = recorded_plan(_KNOWN, world, conditions_from_json(world.conditions_json), graph)
    assert isinstance(plan, Plan)
    return plan


def forged(graph: Agsg, plan: RepairPlan) -> Agsg:
    """The graph with another plan in its grounding."""
    assert graph.grounding is not None
    return build_agsg(
        graph.spec,
        map_digest=graph.map_digest,
        stage=graph.stage,
        grounding=graph.grounding.model_copy(update={'repair': plan}),
        schedule=graph.schedule,
        conditions=graph.conditions,
    )


def test_a_moved_default_is_carried_out_at_its_place_and_judged(parsed: Agsg) -> None:
    first = grounded(parsed)
    assert first.grounding is not None
    plan = RepairPlan(kept=anchor_of(first.grounding), values=(edit(parsed, ALTITUDE, 55.0),))
    moved = grounded(parsed, plan)
    assert moved.grounding is not None
    assert moved.stage is Stage.REPAIRED
    assert moved.spec == first.spec
    assert anchor_of(moved.grounding) == anchor_of(first.grounding)
    assert [m.altitude_m for u in moved.grounding.uavs for m in u.missions] == [55.0]
    row = next(p for p in moved.parameters if p.path == ALTITUDE)
    assert (row.requested, row.realised) == (30.0, 55.0)
    assert [c.id for c in moved.conditions] == [c.id for c in first.conditions]
    assert findings(moved) == set()


def test_another_road_is_another_place(parsed: Agsg) -> None:
    first = grounded(parsed)
    assert first.grounding is not None
    here = anchor_of(first.grounding)
    elsewhere = grounded(parsed, RepairPlan(avoided=(here,))).grounding
    assert elsewhere is not None
    edge = here.lane.rpartition('_')[0]
    assert elsewhere.anchor_lane.rpartition('_')[0] != edge
    near = RepairPlan(avoided=(Anchor(**{**here.model_dump(), 'whole_road': False}),))
    beside = grounded(parsed, near).grounding
    assert beside is not None
    assert anchor_of(beside) != here


def test_a_recording_that_claims_a_locked_edit_is_found(parsed: Agsg) -> None:
    first = grounded(parsed)
    duration = next(p for p in first.parameters if p.path == 'missions/m1/duration_s')
    shorter = edit(first, duration.path, 5.0)
    assert ('graph', 'repair') in findings(forged(first, RepairPlan(values=(shorter,))))


def test_a_recording_that_claims_to_have_moved_a_stated_value_is_not_judged(
    parsed: Agsg,
) -> None:
    first = grounded(parsed)
    world = execution_stage(_KNOWN, first, 1, ()).world
    stated = next(p.path for p in first.parameters if p.provenance == 'explicit')
    fake = forged(first, RepairPlan(values=(edit(first, stated, 21.0),)))
    with pytest.raises(VerificationError, match='stated by the prompt'):
        recorded(fake, world)
