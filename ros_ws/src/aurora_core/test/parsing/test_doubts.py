# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a clause says and its elements do not is admitted; what they do say is not doubted."""

from __future__ import annotations

import pytest
from unread import unread

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.data_files import read_data
from aurora_core.parsing.doubts import bodies, clauses, deeds, flights, messages, narrated, times
from aurora_core.parsing.parser import parse_offline
from aurora_core.spec.scenario import AgentAction

LANDMARKS = ('City Hall', 'Harbor Market')
CONTEXT = ParseContext(landmark_names=LANDMARKS)


@pytest.mark.parametrize(
    'keys',
    [
        clauses.TOLD,
        clauses.MOMENTS,
        messages._GOES_ON,
        bodies._PRESENTS,
        bodies._TRANSITIVE,
        bodies._AWAITS,
        flights._CLIMBS,
        times._FROM_HERE,
        times._NEARS,
        times._ONCE,
        times._INTRANSITIVE,
        times._LETS_PASS,
        narrated._DEEDS,
    ],
    ids=sorted,
)
def test_the_verbs_that_checks_look_for_are_keys_of_the_lexicon(keys: frozenset[str]) -> None:
    assert keys <= read_data('lexicon.yaml')['verbs'].keys()


def test_an_action_of_a_uav_that_a_model_let_stop_is_no_stop_of_an_agent() -> None:
    outcome = parse_offline('A drone hovers over City Hall. At 9 s a van stops.', CONTEXT)
    assert outcome.spec is not None
    (event,) = outcome.spec.events
    stops = event.model_copy(update={'action': AgentAction(do='stop', agent='uav1')})
    spec = outcome.spec.model_copy(update={'events': (stops,)})
    assert list(deeds.stops_at_places(spec, ())) == []


_TRACKS = 'A drone tracks a van at 40 m for 30 seconds'
_NEAR = 'when the van comes within 30 m of the ego car'


@pytest.mark.parametrize(
    ('prompt', 'quoted'),
    [
        (f'{_TRACKS} and warns the ego car of a bus after 20 seconds.', 'a bus'),
        (f'{_TRACKS} and reports the stopped truck to the ego car {_NEAR}.', 'the stopped truck'),
        (f'{_TRACKS} and sends its speed to the ego car {_NEAR}.', 'sends its speed'),
        (
            'A drone tracks a van and informs a second drone, which hovers at 60 m, when the van '
            'stops.',
            'hovers at 60 m',
        ),
        (
            'A drone hovers over City Hall at 40 m. Another drone hovers 12 m above it.',
            '12 m above',
        ),
        (f'{_TRACKS} and no other vehicle comes within 30 m of the van.', 'no other vehicle'),
        (
            'A drone alerts the ego car when a van comes within 30 m of it and climbs to 60 m.',
            'climbs',
        ),
        ('A drone tracks a van at 30 m and is at most 35 m from it.', 'at most 35 m from it'),
        ('A drone tracks a van at 30 m and stays at least 20 m from it.', 'at least 20 m'),
        ('A drone tracks a van and must be within 25 m of it for 10 s.', '25 m of'),
        ('Two drones hover at 30 m and never come closer than 8 m.', '8 m'),
        ('A drone tracks a bus, never getting closer than 12 m.', '12 m'),
        ('A motorcycle escapes a police car. A drone tracks the motorcycle.', 'escapes'),
        ('A red and a blue car drive. A drone tracks the red one.', 'A red'),
        ('A truck drives to City Hall and stays there. A drone tracks the truck.', 'stays there'),
        ('A bicycle rides 10 m behind a bus and stays there. A drone tracks it.', 'stays there'),
        ('A drone hovers over a bus at 40 m for 30 s. The bus drives at 10 m/s.', 'hovers over'),
        ('A drone orbits a bus with a radius of 30 m. The bus drives at 6 m/s.', 'orbits a bus'),
        (
            'A drone hovers at 50 m for 20 s, then descends to 20 m; when it reaches 20 m, the '
            'ego car starts.',
            '20 m',
        ),
        ('A drone tracks the bus at 40 m. The bus stops for 20 seconds.', '20 seconds'),
        ('A drone tracks the bus at 40 m. The bus waits for 10 seconds.', '10 seconds'),
        ('A drone hovers over City Hall at 50 m for 30 s and watches a bus.', 'watches a bus'),
        ('Two drones hover at 40 m and 60 m for 20 s, the first one at 60 m.', 'the first one'),
        ('A drone alerts the ego car while it climbs to 60 m and then tracks a van.', 'alerts'),
        ('A van stops and lets a pedestrian cross while a drone tracks the van.', 'lets a'),
        (f'A drone tracks a van and alerts the ego car at Harbor Market {_NEAR}.', 'at Harbor'),
        ('The drone warns first the ego and then the truck.', 'and then the truck'),
        ('A drone circles City Hall with a radius of less than 40 m.', 'less than 40 m'),
        (
            'A bus brakes when a pedestrian is nearer than 15 m, 5 s later it drives on.',
            'drives',
        ),
        ('The ego car slows to below 5 m/s after 20 s.', 'below 5 m/s'),
        ('The ego car accelerates to over 12 m/s after 20 s.', 'over 12 m/s'),
        ('In a scenario of under 80 s, a drone hovers at 30 m.', 'under 80 s'),
        ('A drone hovers at 30 m for 20 s, as does another one at 45 m.', 'as does another'),
        ('The drone alerts the ego, and also the truck.', 'the truck'),
        ('The truck overtakes the ego; afterwards the drone warns the ego.', 'the drone warns'),
        ('After hovering for 10 s, the drone warns the ego.', 'the drone warns the ego'),
        ('As soon as the drone has landed, the truck sets off.', 'the drone has landed'),
        ('The ego stops 10 m behind the truck.', '10 m'),
        ('The bus stops at City Hall; 5 s later it starts again.', 'City Hall'),
        ('The ego stops at the crosswalk and starts again after 10 s.', 'starts again'),
        ('A truck is parked on the right and a van on the left.', 'a van on the left'),
        ('A drone follows the bus first at 30 m and then at 60 m altitude.', 'and then at 60 m'),
        ('A drone tracks a car at 30 m for 20 s, then climbs to 60 m and tracks it.', 'climbs'),
        ('A drone circles the drone that hovers over City Hall.', 'the drone'),
        ('The drone films the bus from below.', 'from below'),
        ('The drone flies to City Hall and back.', 'and back'),
        ('The bus follows the truck without exceeding 6 m/s.', 'without exceeding'),
        ('A drone stays 40 m away from a van while it orbits City Hall.', 'while it orbits'),
        ('A car drives 20 m ahead of a van. When the gap falls below 30 m, it brakes.', 'falls'),
        ('A drone hovers over City Hall at 60 m and then tracks a van at 40 m.', '40 m'),
        ('A bus stops at City Hall and then continues.', 'and then continues'),
        ('A bus waits at City Hall for 9 s, then continues to Harbor Market.', 'then continues'),
        (
            'A drone hovers over City Hall at 60 m until a bus stops, then descends to 40 m and '
            'hovers for 10 s.',
            '10 s',
        ),
        ('The wind is 10 m/s with gusts of 3 m/s. A drone hovers over City Hall.', 'with gusts'),
        ('A drone hovers over City Hall; after 20 s it switches to tracking a bus.', '20 s'),
        ('A bus comes within 30 m of a car, and the car drives off.', 'comes within 30 m'),
        ('While a drone patrols along Main Street, it stays 50 m from a van.', 'it stays'),
        ('A drone hovers at 50 m and stays 100 m away from City Hall.', '100 m away from'),
        ('A drone flies a patrol along Main Street at 40 m.', 'a patrol'),
        ('Two drones hover over City Hall, one at 50 m, one at 70 m, for 25 s.', '25 s'),
        ('A drone flies for 60 s and tracks a bus at 40 m altitude.', 'flies for 60 s'),
        ('While the bus stops, the drone hovers over it at 40 m.', 'While the bus stops'),
        ('As long as the truck is within 40 m of the bus, the drone tracks it.', 'As long as'),
        ('A drone tracks a van for 20 s, then circles it with a radius of 30 m.', 'circles it'),
        ('A bus stops, a pedestrian crosses, and the bus drives on.', 'a pedestrian crosses'),
        ('The truck brakes, so the ego car behind it brakes too.', 'ego car behind it brakes'),
        ('A drone tracks a bus. When it has tracked the bus for 15 s, the bus stops.', 'stops'),
        (
            'A bus drives. When the ego car comes within 25 m of it, it slows to 5 m/s.',
            'of it, it',
        ),
        (
            'Drone 1 tracks a van. Drone 2 hovers at 40 m and passes on the alerts of drone 1 to '
            'the ego car.',
            'passes on the alerts of',
        ),
        (
            'A drone hovers over City Hall at 40 m for 20 s and lands. After that a second drone '
            'takes off and hovers over Harbor Market at 40 m.',
            'takes off and hovers over Harbor',
        ),
        (
            'When drone 2 has landed, drone 1 lands. Both hover over City Hall at 40 m and 60 m.',
            'When drone 2 has landed',
        ),
        (
            'When the drone descends below 20 m, the truck starts. The drone hovers over the '
            'truck at 40 m for 15 s and then lands.',
            'When the drone descends below 20 m',
        ),
        (
            'The drone sees the ego car 80 percent of the time and hovers over City Hall at 60 m.',
            'sees the ego car 80 percent',
        ),
        ('Two drones hover 30 m apart at 45 m for 40 seconds.', 'hover 30 m apart'),
        ('A drone scans the front of City Hall between 10 m and 40 m.', 'scans the front of'),
        ('At 10 s a van changes to the far left lane.', 'changes to the far left'),
        ('At 25 s the ego car stops at the crosswalk.', 'stops at the crosswalk'),
        ('The ego car yields to a pedestrian at the crosswalk.', 'at the crosswalk'),
        ('A van overtakes the ego car at the intersection.', 'at the intersection'),
        (
            'Two drones hover at 60 m for 20 s, one over City Hall and one over Harbor Market, '
            'and stay at least 100 m apart.',
            'apart',
        ),
        ('No drone may fly above 50 m. Two drones hover at 30 m.', 'No drone'),
        ('No car may exceed 40 km/h. Two cars drive along the main road.', 'No car'),
        (
            'The drone that tracks the bus hovers at 40 m; the drone that tracks the taxi lands '
            'after 30 s.',
            'the drone',
        ),
    ],
)
def test_what_no_element_says_is_admitted(prompt: str, quoted: str) -> None:
    assert any(quoted in text or text in quoted for text in unread(prompt, *LANDMARKS))


@pytest.mark.parametrize(
    'prompt',
    [
        f'{_TRACKS} and alerts the ego car {_NEAR}.',
        f'{_TRACKS} and reports the van to the ego car {_NEAR}.',
        'When a van comes within 30 m of the ego car, a drone alerts it and climbs to 60 m.',
        'A drone hovers over City Hall at 50 m for 30 s and then tracks a bus for 20 s.',
        'Two UAVs track a truck, one at 25 m and the other at 35 m.',
        'A bus, which a police car is following, drives at 10 m/s.',
        'Drone B hovers over City Hall at 55 m, drone A tracks a truck at 40 m.',
        'A drone tracks a car. It stops at 9 s; 3 s after it has stopped the drone alerts it.',
        'A drone tracks a van after climbing to 40 m.',
        'A drone patrols along the main road and warns the ego car.',
        'A drone hovers over City Hall at 15 m for 20 s, climbs to 45 m and hovers there.',
        'When the van stops, the drone that tracks it at 40 m climbs to 60 m.',
        'A bus stops at City Hall for 9 s and then continues.',
        'A drone hovers at 60 m for 20 s, then descends to 40 m and hovers for 10 s.',
        'A drone hovers at 60 m for 20 s and then tracks a van.',
        'A drone tracks a van. The ego brakes because the drone has warned it.',
        'When the drone has finished its mission, a second drone lands.',
        'A car drives with a bus 20 m ahead of it and a van to its left.',
        'A car that starts 25 m behind a bus overtakes it.',
        'A pedestrian stands beside a roadside unit at Harbor Market.',
        'A roadside unit warns the drone, and the drone warns the ego.',
        'A bus brakes when a pedestrian is nearer than 15 m; 5 s later the bus drives on.',
        'A drone flies a route of 4 waypoints at under 6 m/s over City Hall.',
        'A drone tracks the ego car from more than 30 m away.',
        'A truck is placed more than 40 m ahead of the ego car.',
        'A drone hovers over City Hall at 40 m and stays there for 20 seconds.',
        'A drone hovers over the ego car at 40 m for 5 seconds.',
        'A drone hovers over a parked van. The ego car drives past it.',
        'A drone tracks a van at 30 m. The altitude of the drone is at most 40 m.',
        'A drone tracks a van at 30 m. The drone is always within 45 m of the van.',
        'A drone tracks a van and is never nearer than 12 m.',
        'A car, a van and a bus circulate. A drone tracks the van.',
        'A bus starts after 12 s. A drone tracks the bus when it starts, for 60 s.',
        'A drone hovers at 50 m for 20 s; when it reaches 20 m, the ego car starts.',
        'A drone hovers over City Hall at 50 m while a second one tracks a van.',
        'A car drives 20 m ahead of a van. When the gap is below 30 m, the van brakes.',
        'A car drives 20 m ahead of a van. When the gap falls below 10 m, the van brakes.',
        'A car drives 20 m ahead of a van. When the gap exceeds 30 m, the car brakes.',
        'While a drone tracks a van at 40 m, the van stays within 30 m of the ego car.',
        'There is a police car on Main Street. A drone hovers at 40 m.',
        'Two drones hover over City Hall for 25 s, one at 50 m and one at 70 m.',
        'Two drones hover over City Hall at 40 m and 60 m and stay at least 15 m apart.',
        'A drone flies at 40 m for 30 s.',
        'Two drones 25 m apart hover over City Hall at 50 m, never closer than 25 m.',
        'A drone hovers over City Hall at 40 m for 20 s. After that a second drone tracks a bus.',
        'A drone tracks a van at 40 m for 30 s.',
        'A drone hovers over City Hall for 20 s, then it tracks a bus.',
        'The van must come within 30 m of the ego car.',
        'A drone tracks a van. The van never comes within 10 m of the ego car.',
        'A drone tracks a van at 40 m distance for 30 s, at an altitude of 50 m.',
        'A drone hovers over City Hall for 20 s and lands.',
        'Two drones hover over City Hall at 40 m and 60 m. They stay 15 m apart.',
        'While a drone tracks a van, the van is always within 40 m of the ego car.',
        'A car turns left and a bus turns right.',
        'A bus stops at the crosswalk. At 40 s it drives on.',
        'At 25 s the ego car stops.',
        'A fire engine is on an emergency run. Five cars on the main road make way for it.',
        'A truck stops at 9 s, and a car stops at 12 s.',
        'If my car gets closer than 20 m to the truck ahead of it, it brakes.',
        'Five cars make way for a fire engine on an emergency run.',
        'A drone hovers over a van for 20 s, then tracks it.',
        'After the drone has tracked the van for 10 s, it hovers over City Hall.',
        'When a van comes within 25 m of the ego car, it changes to the left lane.',
        'Two drones hover at 30 m. No drone may fly above 50 m.',
    ],
)
def test_what_elements_say_is_not_doubted(prompt: str) -> None:
    assert unread(prompt, *LANDMARKS) == []
