# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Callable

from aurora_core.agsg.build import build_agsg
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.grounding import GroundingFailure
from aurora_core.outcomes.repair import Anchor, Attempt, Proposal, Step, ValueEdit, with_values
from aurora_core.outcomes.verdict import Verdict
from aurora_core.pipeline.functions import parse_stage
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.repair.lock import locked_edits
from aurora_core.repair.propose import propose
from aurora_core.repair.revise import MOST_FIELDS, revised_to_fit
from aurora_core.repair.settings import RepairSettings, load_repair_settings
from aurora_core.spec.parameter import Provenance

_KNOWN = installed_knowledge()
SETTINGS = load_repair_settings()
ALTITUDE, STANDOFF = 'missions/m1/altitude_m', 'missions/m1/standoff_m'
Failing = Callable[..., Verdict]


def parsed(prompt: str) -> Agsg:
    found = parse_stage(_KNOWN, prompt, 'downtown', 1).agsg
    assert found is not None
    return found


def to_fit(agsg: Agsg, *reasons: str) -> list[Proposal]:
    counts = {reason: 9 - k for k, reason in enumerate(reasons)}
    failure = GroundingFailure(reason=reasons[0], tried=9, rejected_by=counts)
    return list(revised_to_fit(agsg, failure, SETTINGS))


def test_what_flies_too_low_to_be_clear_is_revised_upwards_and_first_alone() -> None:
    agsg = parsed('A drone orbits the City Hall.')
    low = next(row.requested for row in agsg.parameters if row.path == ALTITUDE)
    first, round_it, both, *_ = to_fit(agsg, 'clearance')
    [edit] = first.plan.values
    assert (edit.path, edit.realised > low) == (ALTITUDE, True)
    [edit] = round_it.plan.values
    assert (edit.path, edit.realised > edit.requested) == ('missions/m1/radius_m', True)
    assert {edit.path for edit in both.plan.values} == {ALTITUDE, 'missions/m1/radius_m'}
    assert first.step is Step.SYMBOLIC


def test_what_most_sites_lacked_is_revised_first() -> None:
    agsg = parsed('A drone tracks a bus.')
    first = to_fit(agsg, 'separation', 'sight')[0]
    assert [edit.path for edit in first.plan.values] == [STANDOFF]
    assert [e.path for e in to_fit(agsg, 'sight', 'separation')[0].plan.values] == [ALTITUDE]


def test_who_sees_nothing_from_high_up_is_put_lower_first() -> None:
    usual = parsed('In fog, a drone hovers over an intersection and sees a bus for 5 seconds.')
    high = ValueEdit(path=ALTITUDE, requested=30.0, realised=84.0, provenance=Provenance.DEFAULT)
    agsg = build_agsg(with_values(usual.spec, (high,)))
    [down], [up] = (proposal.plan.values for proposal in to_fit(agsg, 'sight')[:2])
    assert down.realised < 84.0 < up.realised
    [up], [down] = (proposal.plan.values for proposal in to_fit(usual, 'sight')[:2])
    assert down.realised < 30.0 < up.realised


def test_what_most_often_gives_sight_is_moved_far_as_well() -> None:
    usual = parsed('In fog, a drone tracks a bus.')
    far = ValueEdit(path=STANDOFF, requested=0.0, realised=120.0, provenance=Provenance.DEFAULT)
    agsg = build_agsg(with_values(usual.spec, (far,)))
    tried = [p.plan.values for p in to_fit(agsg, 'sight')[: SETTINGS.placements]]
    alone = [v[0].realised for v in tried if [e.path for e in v] == [STANDOFF]]
    # Beyond 75 m nobody sees anything in fog.
    assert min(alone) < 60.0


def test_nothing_stated_is_revised_and_what_no_value_mends_is_left() -> None:
    stated = parsed('A drone orbits the City Hall at 12 meters with a radius of 30 meters.')
    assert to_fit(stated, 'clearance') == []
    assert to_fit(parsed('A drone tracks a bus.'), 'start_spot') == []


def test_a_revision_is_inside_the_lock_and_the_bound_of_fields() -> None:
    agsg = parsed(
        'Two drones hover over the bus, two drones track the car and a drone patrols a street.'
    )
    found = to_fit(agsg, 'clearance', 'pattern', 'sight')
    assert found
    for proposal in found:
        assert 1 <= len(proposal.plan.values) <= MOST_FIELDS
        assert list(locked_edits(agsg, proposal.plan)) == []


def attempts(number: int) -> tuple[Attempt, ...]:
    rows = []
    for k in range(number):
        anchor = Anchor(lane=f'{chr(97 + k)}_0', position_m=10.0)
        step = Step.GROUNDING if k else None
        fields = {'iteration': k, 'anchor': anchor, 'outcome': 'violated', 'step': step}
        rows.append(Attempt.model_validate(fields))
    return tuple(rows)


def test_when_nothing_was_of_avail_place_and_values_are_revised_together(
    agsg: Agsg, failing: Failing
) -> None:
    verdict = failing(m1__visible=-0.4)
    before = propose(agsg, verdict, attempts(SETTINGS.in_vain), SETTINGS)
    assert before.step is not Step.SYMBOLIC
    found = propose(agsg, verdict, attempts(SETTINGS.in_vain + 1), SETTINGS)
    assert found.step is Step.SYMBOLIC
    assert found.plan.avoided
    fields = [edit.path for edit in found.plan.values]
    assert ALTITUDE in fields
    assert len(fields) < MOST_FIELDS
    assert set(fields) <= {item.field for item in found.implicated}


def test_a_step_that_is_left_out_is_never_taken(agsg: Agsg, failing: Failing) -> None:
    steps = [Step.ONE.value, Step.SEARCH.value]
    document = {**SETTINGS.model_dump(), 'escalation': steps}
    settings = RepairSettings.model_validate(document)
    for number in (1, 5):
        found = propose(agsg, failing(m1__visible=-0.4), attempts(number), settings)
        assert found.step in (Step.ONE, Step.SEARCH)


def test_an_edit_without_room_at_its_place_takes_the_scene_along(
    agsg: Agsg, failing: Failing
) -> None:
    verdict = failing(m1__visible=-0.4)
    past = attempts(1)
    first = propose(agsg, verdict, past, SETTINGS)
    assert (first.step, first.plan.kept is None) == (Step.ONE, False)
    fields = {'iteration': 1, 'outcome': 'no_place', 'step': Step.ONE, 'plan': first.plan}
    again = propose(agsg, verdict, (*past, Attempt.model_validate(fields)), SETTINGS)
    assert again.step is Step.SYMBOLIC
    assert again.plan.kept is None
    assert again.plan.values == first.plan.values
    # Nowhere else either: on with what else can be at fault.
    gone = {**fields, 'step': Step.SYMBOLIC, 'plan': again.plan}
    rows = (Attempt.model_validate(fields), Attempt.model_validate(gone))
    assert propose(agsg, verdict, (*past, *rows), SETTINGS).plan not in (first.plan, again.plan)
