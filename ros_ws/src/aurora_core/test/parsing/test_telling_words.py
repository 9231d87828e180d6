# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Words that ask for something are admitted unless something carries them."""

from __future__ import annotations

import pytest
from unread import unread

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.parser import parse_offline

LANDMARKS = ('City Hall',)
CONTEXT = ParseContext(landmark_names=LANDMARKS)


@pytest.mark.parametrize(
    ('prompt', 'quoted'),
    [
        ('Two drones hover at 30 m and 50 m for 20 s, one after the other.', 'one after'),
        ('Two drones hover at 30 m and 50 m for 20 s and land together.', 'together'),
        (
            'A pedestrian crosses when a car is 30 m away. The pedestrian waits 2 s first.',
            'first',
        ),
        ('A drone hovers at 40 m for 20 s, lands and takes off again.', 'takes off'),
        ('A drone hovers at 40 m for 20 s, lands, waits 10 s and takes off.', 'lands, waits'),
        ('A drone lands and then hovers over City Hall at 40 m.', 'lands and then hovers'),
        ('A drone hovers at 40 m for 20 s and repeats this.', 'repeats this'),
        (
            'A drone hovers over City Hall at 50 m; a second drone flies past it at a distance of '
            'at least 20 m.',
            'flies past',
        ),
        (
            'The drone stays on the ground for 20 s and then hovers over City Hall at 50 m.',
            'stays on the ground',
        ),
        (
            'A drone hovers over City Hall at 50 m for 60 s and its drift stays below 1.5 m.',
            'drift',
        ),
        ('A drone hovers at 40 m for 20 s, and so does another one at 60 m.', 'does'),
        ('A drone starts at 40 m and hovers over City Hall for 20 s.', 'starts at 40 m'),
        ('A drone, already in the air, hovers over City Hall.', 'already in the air'),
        ('A drone starts on a rooftop and hovers over City Hall.', 'on a rooftop'),
        ('A drone hovers over City Hall for 20 s and lands on the road.', 'lands on the road'),
        ('A van does not brake until a bus comes within 20 m of it.', 'does not brake until'),
        ('A van must not slow down before a bus is within 20 m of it.', 'must not slow'),
        ('A drone flies a line of 200 m and is back after at most 60 s.', 'is back'),
        ('The scenario lasts 100 s. A drone tracks a van the whole time.', 'the whole time'),
        ('The scenario lasts 100 s. A drone hovers at 40 m throughout.', 'throughout'),
        ('A drone tracks a van and keeps it in view without interruption.', 'view without'),
        ('In heavy rain a drone hovers at 30 m in still air.', 'still air'),
        (
            'At 15 s a drone sends my car a message. It must arrive no later than 18 s.',
            'later than',
        ),
        ('A bicycle rides at 15 km/h for the whole run.', 'the whole run'),
        ('A drone tracks a bus for the entire scenario.', 'the entire scenario'),
        ('A drone hovers as high as allowed for 20 s.', 'as high as allowed'),
        ('No drone comes within 20 m of City Hall. A drone tracks a bus.', 'No drone comes'),
        ('A drone tracks a van. It alerts the ego every time the van is slow.', 'every time'),
        ('On a foggy morning a drone hovers over City Hall.', 'morning'),
        ('A drone tracks a speeding car.', 'speeding'),
        ('A drone tracks a slow bus.', 'slow'),
        ('The ego overtakes a bicycle which is slow.', 'is slow'),
        ('A drone hovers out of sight of the ego at 40 m.', 'out of sight'),
        ('A car follows a bus closely.', 'closely'),
        ('A car drives at full speed.', 'full speed'),
        ('A car drives straight ahead; a drone tracks it.', 'straight ahead'),
        ('A car accelerates by 4 m/s after 20 s.', 'by 4 m/s'),
        ('A van overtakes a bus; afterwards the bus stops.', 'the bus stops'),
        ('A van overtakes a bus before the bus stops.', 'before the bus stops'),
        ('A bus stops and a car stops, in this order.', 'in this order'),
        ('A van stops while a drone hovers over City Hall at 40 m.', 'while'),
        ('While a drone circles City Hall at 40 m, a truck drives to City Hall.', 'While'),
        ('A van stops before a drone takes off and hovers at 40 m.', 'before'),
        ('After a drone has hovered over City Hall and landed, a van turns left.', 'After'),
        ('A drone tracks a van, and after 20 seconds of tracking the van stops.', 'of tracking'),
        ('A van is stopped ahead of the ego car.', 'is stopped'),
        (
            'A drone tracks a bus at 40 m; no other vehicle comes within 30 m of the bus.',
            'no other',
        ),
        ('A drone hovers over City Hall at 50 m. It sees a van.', 'sees a'),
        ('A van stops next to a parked bus.', 'stops next to'),
        ('A pedestrian crosses in front of a bus.', 'crosses in front of'),
        ('A van stops after 20 s and stops again after 50 s.', 'stops again'),
        (
            'The ego overtakes a cyclist, keeping 1.5 m away from it.',
            'overtakes a cyclist, keeping 1.5 m',
        ),
        (
            'A drone patrols the main road and tracks the first truck that it sees.',
            'the first truck that it sees',
        ),
        ('A van turns around and drives back.', 'turns around'),
        ('The van tracks a bus and drives home.', 'home'),
        ('A van stops after 30 s because a pedestrian crosses the street.', 'because'),
        (
            'A drone tracks a van for 20 s, then hovers over City Hall just as long.',
            'just as long',
        ),
        ('A drone hovers 10 m above the roof of City Hall.', 'the roof'),
        ('A drone flies along Market Street at 40 m.', 'along Market'),
        ('A drone tracks a convoy of three trucks.', 'convoy of three'),
        ('A pedestrian sprints across the street.', 'sprints across'),
        ('The ego brakes only when a van comes within 20 m of it.', 'only when'),
        ('A drone is the only vehicle in the air and hovers over City Hall.', 'only vehicle'),
        ('When the ego stops, the drone keeps hovering over City Hall.', 'keeps hovering'),
        ('A drone must see the van all the time.', 'all the time'),
        ('Two drones hover over City Hall, at least 15 m above each other.', 'each other'),
        ('A drone hovers over City Hall; a van stops there after 20 s.', 'stops there'),
        ('A van drives until it is told to stop.', 'until it is told to'),
        ('A pedestrian might cross.', 'might'),
        ('A drone hovers over City Hall at 40 m; it may climb to 60 m.', 'it may'),
        ('The drone could follow the bus, but it must follow the van.', 'the drone could'),
        ('It is possible that a pedestrian crosses.', 'it is possible'),
        ('A bus drives at 9 m/s. A taxi is just as fast.', 'just as fast'),
        ('Ideally the drone tracks the bus from 20 m away.', 'ideally'),
        ('The drone keeps 20 m from the car that it tracks at 40 m.', 'that it tracks'),
        ('Two drones at 30 m and 50 m respectively track a bus and a van.', 'respectively'),
        ('Let four drones hover in a line at 50 m.', 'hover in a line'),
        ('A drone inspects the facade of City Hall between 10 and 40 m.', 'facade'),
        (
            'The drone should see a pedestrian who is crossing. Then it should tell the car to'
            ' stop.',
            'it should tell',
        ),
        ('A van stops at the second intersection.', 'second intersection'),
        ('A drone tracks a van. The other van stops.', 'other van'),
        ('A van brakes as a pedestrian crosses.', 'as a pedestrian'),
        ('A pedestrian crosses as the ego approaches.', 'as the ego'),
        ('A car stops at City Hall for 8 s and then turns left.', 'then turns'),
        ('A car stops at City Hall for 8 s and then drives on at 5 m/s.', 'then drives on'),
        ('A car stops at City Hall and then drives on.', 'then drives on'),
        ('A pedestrian crosses and then waits for 20 s.', 'then waits'),
        ('The car brakes only after the bus has stopped.', 'only after'),
        ('A drone flies to City Hall, turns around and lands.', 'turns around'),
        ('The ego never exceeds 30 km/h while the drone is within 50 m.', 'while the drone'),
        ('The bus may stop at the crosswalk, yet it yields to the pedestrian.', 'may'),
        ('A jogger runs through the park while a drone hovers there.', 'through the park'),
        ('A cyclist turns left in front of the ego car; the ego car brakes.', 'in front of'),
        ('A drone hovers over City Hall while a taxi approaches City Hall.', 'taxi approaches'),
        ('A drone climbs to 60 m when it loses sight of the bus it tracks.', '60 m'),
        (
            'Drone A tracks the ego car; drone B stays 25 m away from drone A and circles the'
            ' market.',
            'the market',
        ),
        ('A child runs onto the road and the van stops.', 'the van stops'),
        ('When the bus starts to change lanes, the van brakes.', 'starts to change'),
        ('The ego brakes as a pedestrian steps off the curb.', 'as a pedestrian steps off'),
        ('When a pedestrian steps off the sidewalk, the bus brakes.', 'steps off the sidewalk'),
        ('Once the van leaves the intersection, the drone lands.', 'leaves the intersection'),
        ('When a pedestrian enters the crosswalk, the ego car brakes.', 'enters the crosswalk'),
        ('When the drone sees a pedestrian on the road, it alerts the ego car.', 'on the road'),
        ('Two drones patrol the road at 40 m.', 'patrol the road'),
        ('Once the truck arrives at City Hall, the drone lands there.', 'lands there'),
        ('When a bus reaches City Hall, the drone hovers there at 35 m.', 'hovers there'),
        ('Each of three drones hovers over a different intersection.', 'a different intersection'),
        ('Drone A hovers as high as drone B, which hovers at 35 m.', 'as high as'),
        (
            'By the time the ego car reaches the intersection, the drone must be hovering there '
            'at 40 m.',
            'By the time',
        ),
        ('Drone one tracks the taxi for 20 s before drone two takes over.', 'takes over'),
        (
            'The drone does not start to follow the van until the van has left the intersection.',
            'has left the intersection',
        ),
        ('The drone must see the truck 75 % of the time during 40 s.', '75 % of the time'),
    ],
)
def test_admitted(prompt: str, quoted: str) -> None:
    assert any(quoted.lower() in text.lower() for text in unread(prompt, *LANDMARKS)), unread(
        prompt, *LANDMARKS
    )


@pytest.mark.parametrize(
    'prompt',
    [
        'A drone hovers over City Hall, tracks a bus for 20 s, then hovers over City Hall again.',
        'A police car follows a speeding motorcycle, which drives at 20 m/s.',
        'A van tailgates the ego car closely.',
        'A motorcycle overtakes a van while a drone tracks the van.',
        'A bus drives along while a drone hovers over City Hall.',
        'A drone hovers over City Hall for 20 s and only then tracks a bus.',
        'When the drone sees a bus, it lands; before that it hovers over City Hall.',
        'Ten seconds into the scenario the bus brakes.',
        'A drone flies a straight line of 200 m over City Hall.',
        'A foggy evening; a drone hovers over City Hall.',
        'A drone hovers over City Hall, tracks a bus and lands, in this order.',
        'A drone hovers over City Hall for 20 s and then lands.',
        'A car drives at most 15 m behind a bus at all times.',
        'A car always stays 20 m behind a bus.',
        'A car follows a bus at a constant distance of 20 m.',
        'A drone tracks a bus at 40 m the whole time.',
        'A van and a bus wait next to each other.',
        'Two vans circulate. The second van stops after 20 s.',
        'A van drives along as a drone tracks it.',
        'The bus brakes after 20 s; afterwards the drone lands. The drone hovers over City Hall.',
        'A drone hovers over City Hall; it may drift 2 m at most.',
        'A drone tracks a bus. I wonder whether the drone could stay 20 m away from it.',
        'A bus drives along. The drone that tracks it flies at 40 m.',
        'A drone tracks a van and does not land until the van stops.',
        'A drone hovers at 40 m for 30 s throughout.',
        'A drone hovers at 40 m in still air.',
        'A drone hovers over City Hall and lands no later than 90 s.',
        'At 10 s a drone sends my car a message, which arrives no later than 0.5 s after that.',
        'The whole scenario lasts 90 s. A drone tracks a bus.',
        'A drone tracks a bus and stays above 20 m for the whole run.',
        'The scenario lasts 100 s. A drone hovers at 40 m for 60 s the whole time.',
        'A drone tracks a van and sees it for 20 seconds without interruption.',
        'A drone tracks a van and always keeps it in view without interruption.',
        'The bus may start only after the message of the drone.',
        'No drone may fly above 50 m.',
        'The drone may fly at most 60 m high.',
        'A pedestrian starts crossing at 20 s.',
        'A drone alerts the ego car when a pedestrian starts crossing.',
        'When the bus begins to brake, the drone climbs to 50 m.',
        'The drone flies to City Hall and hovers there for 20 s at 35 m.',
        'The first drone tracks the bus for 20 s, then the second drone takes over.',
        'A drone hovers over City Hall at 50 m and sees a bus for 75 % of the time.',
        'A car stops at City Hall for 8 s and then drives on.',
        'A pedestrian waits at the crosswalk for 20 s and then crosses.',
        'The drone lands only after the bus has stopped. It tracks the bus at 35 m.',
        'A pedestrian crosses at the crosswalk only after the car has stopped.',
        'A drone flies three turns around City Hall with a radius of 60 m.',
    ],
)
def test_what_something_carries_is_read(prompt: str) -> None:
    assert unread(prompt, *LANDMARKS) == []


def test_up_to_behind_a_climb_is_where_it_ends() -> None:
    outcome = parse_offline('The drone should go up to 40 m. It tracks a bus.', CONTEXT)
    assert outcome.spec is not None
    assert [m.altitude_m.value for m in outcome.spec.missions] == [40]
    assert outcome.spec.conditions == ()


def test_who_names_a_member_is_asked_and_not_refused() -> None:
    outcome = parse_offline('The faster of two cars stops after 20 s.', CONTEXT)
    assert outcome.refusals == ()
