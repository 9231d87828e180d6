# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What excludes itself, or what the map rules out, is refused with the reason."""

from __future__ import annotations

import pytest
from requests_by_hand import asked, judged, map_of

from aurora_core.feasibility.doubts import doubts
from aurora_core.feasibility.limits import check_limits
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import load_limits, load_tolerances
from aurora_core.knowledge.uav_record import load_uav_record
from aurora_core.outcomes.feasibility import Feasibility, FeasibilityVerdict
from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.parser import parse_offline
from aurora_core.recheck import Outcome, recheck
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import ClauseStatus

REFUSED = (
    ('In fog a drone hovers over the crosswalk at 95 m.', 'sensing_range'),
    ('At night in fog a UAV tracks a bus from a standoff of 80 m.', 'sensing_range'),
    ('A drone tracks a car that drives at 30 m/s.', 'speed_limit'),
    (
        'The UAV hovers 110 m above the ego car for 60 s and sends it a message at 40 s over a '
        'radio with a range of 80 m.',
        'comm_range',
    ),
    (
        'uav 1 hovers at 30 m over the intersection, uav 2 at 31 m, exactly above the first one',
        'separation',
    ),
    (
        'A drone hovers over City Hall at 50 m. It must stay above 80 m.',
        'spatial_contradiction',
    ),
    ('The van is 30 m ahead of the ego and 30 m behind the ego.', 'spatial_contradiction'),
    ('A bus is 20 m ahead of the ego. The bus is 60 m ahead of the ego.', 'spatial_contradiction'),
    ('The truck is ahead of the bus. The bus is ahead of the truck.', 'spatial_contradiction'),
    ('A scenario of 20 seconds. The bus brakes at 30 s.', 'temporal_contradiction'),
    (
        'A drone hovers over City Hall for 60 seconds at 30 m. It must be on the ground by 40 s.',
        'temporal_contradiction',
    ),
    (
        'The bus brakes at 30 s. The drone warns the ego after that, and the warning has to be '
        'received before 20 s.',
        'temporal_contradiction',
    ),
    (
        'A drone hovers over City Hall for 30 s and only then transmits a warning to the ego, '
        'which has to arrive no later than 10 s after the start of the scenario.',
        'temporal_contradiction',
    ),
    (
        'The drone follows the police car, but it has to stay a quarter of a kilometre away '
        'from it, horizontally.',
        'standoff',
    ),
    (
        'A drone hovers over City Hall for 900 s, then it hovers over Mercy Hospital for 700 s.',
        'endurance',
    ),
    ('A drone flies a rectangle of 100 m by -5 m at 40 m altitude.', 'spatial_contradiction'),
    ('A drone hovers over Signal Tower at 50 m.', 'geofence'),
    ('Two drones fly 2 m apart over the main road at 80 m.', 'separation'),
    (
        'The van keeps at least 400 m from the ego and warns it over a link of 150 m range.',
        'comm_range',
    ),
    (
        'The bus starts when the van starts, and the van starts when the bus starts.',
        'temporal_contradiction',
    ),
    ('A drone orbits Mercy Hospital at a radius of 100 m, 110 m above the ground.', 'geofence'),
    # Round the park as often at the speed that is asked for, not at the fastest there is.
    ('A drone circles Meadow Park 24 times at 100 m radius with 5 m/s at 60 m.', 'endurance'),
    (
        'A drone hovers over Meadow Park at 50 m. A parked car at Eastgate Stadium has to be '
        'visible to the drone all the time.',
        'sensing_range',
    ),
    # A lone `and` between two numbers says nothing of either.
    ('A drone circles Signal Tower at a radius of 30 m and 60 m altitude.', 'geofence'),
    (
        'A drone hovers over Meadow Park at 60 m. The distance between the drone and City Hall '
        'is always below 300 m.',
        'spatial_contradiction',
    ),
    (
        'A drone hovers over City Hall at 60 m. The horizontal distance between the drone and '
        'Union Station is always at least 400 m.',
        'spatial_contradiction',
    ),
    (
        'A drone hovers over Meadow Park at 60 m. A car is parked at Eastgate Stadium. The '
        'distance between the drone and the car is always below 500 m.',
        'spatial_contradiction',
    ),
    ('Two drones track a bus, never more than 2 m from each other.', 'separation'),
    (
        'A drone tracks a taxi at 50 m altitude but always flies lower than 35 m.',
        'spatial_contradiction',
    ),
)
ACCEPTED = (
    # What `and` joins was not read, and is told of by itself.
    'A drone orbits Signal Tower and Meadow Park at a radius of 30 m and 60 m altitude.',
    # Of two hovers one may be meant; a route may lead there.
    'A drone hovers over Meadow Park at 60 m and then over City Hall at 60 m. The distance '
    'between the drone and City Hall is always below 300 m.',
    'A drone hovers over Meadow Park at 60 m and then flies a line of 900 m at 60 m. The '
    'horizontal distance between the drone and City Hall is always below 300 m.',
    # Beside the road to the park that is wider than its name tells.
    'A drone hovers over Meadow Park at 60 m. A car is parked at Ridge School. The distance '
    'between the drone and the car is always below 100 m.',
    # An event that ends the phase early leaves time enough.
    'A drone hovers over City Hall for 60 s at 30 m. At 10 s it lands. It must be on the ground '
    'by 50 s.',
    'The drone tracks the police car. The horizontal distance between the drone and the police '
    'car must be at least 155 m.',
    'Two drones keep at least 4 m apart while they hover over City Hall at 40 m.',
    'The van keeps at least 100 m from the ego and warns it over a link of 150 m range.',
    'The bus starts when the van starts, and the car starts when the bus starts.',
    'In fog a drone hovers over the crosswalk at 75 m.',
    'At night, in heavy rain, the drone tracks a car from 40 m away at an altitude of 40 m.',
    'two drones 5m apart, both 50m up hovering over harbor market',
    'A drone orbits Mercy Hospital at a radius of 75 m, 110 m above the ground.',
    'A van is 30 m ahead of the ego and a bus is 30 m behind the ego.',
    'A bus is 20 m ahead of the ego. The bus is 21 m ahead of the ego.',
    'A scenario of 40 seconds. The bus brakes at 30 s.',
    'A drone hovers over City Hall for 60 seconds at 30 m. It must be on the ground by 120 s.',
    'A drone hovers over City Hall for 900 s, then it hovers over Mercy Hospital for 600 s.',
    'A drone circles Meadow Park 10 times at 100 m radius with 5 m/s at 60 m.',
    # It stands at the road that leads there, which may be far from the middle of the park.
    'A drone hovers over Meadow Park at 50 m. A parked car at Ridge School has to be visible to '
    'the drone all the time.',
    # It may drive to where it can be seen.
    'A drone hovers over Meadow Park at 50 m. A car starts at Eastgate Stadium and drives to '
    'Meadow Park. The car has to be visible to the drone for at least 10 seconds.',
    # Above the other one, not above the ground.
    'A drone hovers over City Hall at 50 m. Another drone hovers 2.5 m above it for 20 seconds.',
    'A drone hovers over City Hall at 40 m. Another drone hovers 125 m above it for 20 seconds.',
)


def _read(prompt: str) -> ScenarioSpec:
    landmarks = map_of('downtown').landmarks
    context = ParseContext(landmark_names=tuple(m.name for m in landmarks))
    spec = parse_offline(prompt, context).spec
    assert spec is not None, prompt
    return spec


def _judged(prompt: str) -> FeasibilityVerdict:
    return judged(_read(prompt))


@pytest.mark.parametrize(('prompt', 'reason'), REFUSED)
def test_what_cannot_be_is_refused_with_its_reason(prompt: str, reason: str) -> None:
    verdict = _judged(prompt)
    assert verdict.result is Feasibility.INFEASIBLE
    assert {c.reason for c in verdict.certificates} == {reason}
    assert all(c.sentence for c in verdict.certificates)


@pytest.mark.parametrize('prompt', ACCEPTED)
def test_what_can_be_within_the_tolerances_is_not_refused(prompt: str) -> None:
    assert _judged(prompt).certificates == ()


def test_a_clash_with_a_half_read_clause_is_no_proof() -> None:
    prompt = 'A car starts 20 m behind a bus and ends 10 m ahead of it.'
    verdict = _judged(prompt)
    assert verdict.result is Feasibility.UNKNOWN
    assert verdict.notes


def test_hovers_out_of_reach_of_each_other_are_doubted() -> None:
    """They may start beside each other, and one may send before it goes to its place."""
    prompt = (
        'The first drone hovers over Meadow Park at 40 m, the second drone over {} at 40 m. '
        'After 40 seconds the first drone sends a message to the second drone over a link with '
        '100 m range.'
    )
    far, near = (_judged(prompt.format(place)) for place in ('Eastgate Stadium', 'Meadow Park'))
    assert (far.result, far.certificates) == (Feasibility.UNKNOWN, ())
    assert any('link reaches 100 m' in note for note in far.notes)
    assert not any('their link' in note for note in near.notes)


def test_a_flight_that_was_measured_to_empty_the_battery_is_doubted() -> None:
    """A hover of 20 minutes is flown; the same at full speed, or held in a storm, may not be."""

    def told(prompt: str) -> list[str]:
        spec = _read(prompt)
        limits = load_limits(config_path('limits.json'))
        tolerances = load_tolerances(config_path('tolerances.json'))
        found = doubts(spec, map_of('downtown'), limits, tolerances, load_uav_record())
        return [text for text in found if 'battery' in text]

    patrol = 'A drone patrols four waypoints at {} m/s at 60 m for 1300 seconds.'
    assert told('A drone hovers over City Hall at 60 m for 1300 seconds.') == []
    assert told(patrol.format(8)) == []
    (fast,) = told(patrol.format(18))
    assert 'for 1300 s at least' in fast
    (long,) = told('A drone hovers over City Hall at 60 m for 1400 seconds in a wind of 15 m/s.')
    assert 'for 1400 s at least' in long


def test_a_message_that_is_due_before_its_drone_is_up_is_doubted_or_refused() -> None:
    prompt = 'A drone hovers over City Hall at 60 m. At {} s the drone sends a message to my car.'
    refused, near, far = (_judged(prompt.format(seconds)) for seconds in (5, 14, 20))
    (proof,) = refused.certificates
    assert 'uav1 climbs 58 m at 5 m/s at most (11.6 s)' in proof.sentence
    assert {'events/e1/trigger/at_s', 'missions/m1/altitude_m'} == {m.path for m in proof.mends}
    assert near.result is Feasibility.UNKNOWN
    assert any('uav1 is up at about 16.0 s' in note for note in near.notes)
    assert not any('is up at' in note for note in far.notes)


def test_a_route_that_is_never_to_be_slow_is_doubted() -> None:
    prompt = 'A drone flies a rectangle of 150 by 100 m at 50 m. The speed of the drone {}.'
    never, at_most = (
        _judged(prompt.format(words))
        for words in ('always stays above 3 m/s', 'always stays below 12 m/s')
    )
    assert any('slower than 3 m/s' in note for note in never.notes)
    assert not any('at rest' in note for note in at_most.notes)


def test_a_vehicle_that_is_to_come_nearer_than_any_street_is_doubted() -> None:
    prompt = 'My car drives. When my car comes within {} m of City Hall, my car brakes.'
    near, far = (_judged(prompt.format(metres)) for metres in (20, 80))
    assert (near.result, near.certificates) == (Feasibility.UNKNOWN, ())
    assert any('none is nearer to City Hall than 57 m' in note for note in near.notes)
    assert not any('City Hall' in note for note in far.notes)


def test_a_number_in_words_that_were_not_read_proves_nothing() -> None:
    """A certificate that rests on one all the same is refuted."""
    prompt = 'A drone hovers over City Hall at 50 m. Another drone hovers 2 m above it.'
    assert _judged(prompt).result is Feasibility.UNKNOWN
    spec = _read(prompt)
    whole = spec.model_copy(
        update={'clauses': tuple(c for c in spec.clauses if c.status is ClauseStatus.ENCODED)}
    )
    [proof] = check_limits(whole, load_limits(config_path('limits.json'))).certificates
    assert recheck(proof, whole.model_dump(mode='json')).valid
    assert recheck(proof, spec.model_dump(mode='json')).outcome is Outcome.REFUTED


def test_a_half_read_deadline_is_not_said_to_hang_on_the_tolerances() -> None:
    """95 m need 19 s: no tolerance makes 8 s of it."""
    verdict = _judged(
        'A drone hovers over Meadow Park at 100 m. Its altitude must be at least 95 m within the '
        'first 8 s of the scenario.'
    )
    assert verdict.result is Feasibility.UNKNOWN
    assert [note for note in verdict.notes if 'part of that clause was not read' in note]
    assert not [note for note in verdict.notes if 'tolerances' in note]


@pytest.mark.parametrize(
    'prompt',
    [
        'A drone hovers over the intersection at 40 m and, when a truck stops, climbs to 60 m. '
        'The altitude of the drone must be above 55 m.',
        'In fog a drone hovers over the crosswalk at 95 m and, when a truck stops, descends to '
        '40 m.',
    ],
)
def test_what_an_event_changes_about_a_height_is_counted(prompt: str) -> None:
    """A condition, or the sight, may be meant for the time after the event."""
    assert _judged(prompt).certificates == ()


@pytest.mark.parametrize(('lasts_s', 'at_s', 'refused'), [(5, 60, False), (60, 40, True)])
def test_who_may_report_while_it_lands_is_not_refused(
    lasts_s: int, at_s: int, refused: bool
) -> None:
    """It was, and flown it was verified: 20 m above a parked van the link reaches it."""
    verdict = _judged(
        f'A van is parked. A drone hovers 95 m above the van for {lasts_s} seconds and sends a '
        f'message to the van at {at_s} s over a link with a range of 80 m.'
    )
    assert (verdict.result is Feasibility.INFEASIBLE) is refused
    if not refused:
        assert any('Only before and after its missions' in note for note in verdict.notes)


def test_a_message_that_is_to_be_lost_may_be_out_of_range() -> None:
    spec = _read(
        'A drone hovers 110 m above the ego car for 60 seconds and sends a message to the ego at '
        '40 s over a radio with a range of 80 m.'
    )
    assert judged(spec).result is Feasibility.INFEASIBLE
    lost = asked('c1', 'delivered', ['uav1', 'ego'], '==', 0.0, '1')
    document = {**spec.model_dump(mode='json'), 'conditions': [lost]}
    assert judged(ScenarioSpec.model_validate(document)).certificates == ()


def test_a_sum_told_exactly_closes_the_scene_also_where_it_is_listed() -> None:
    """Of `exactly two vehicles, a car and a van` nothing was left of `exactly`."""
    scene = 'The scene contains exactly two vehicles, a car and a van.'
    assert [c.value.value for c in _read(scene).counts] == [2.0]
    crowded = _judged(f'{scene} There is heavy traffic.')
    assert {c.reason for c in crowded.certificates} == {'count'}
    assert _read(scene.replace('exactly ', '')).counts == ()
