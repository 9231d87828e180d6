# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Grounded scenes keep what was asked, fit the map, and are the same each time."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import combinations, pairwise
from math import atan2, pi, sqrt

import numpy as np
import pytest
import shapely

from aurora_core.grounding.airspace import Airspace
from aurora_core.grounding.ground import Grounder
from aurora_core.grounding.routes import RouteFinder
from aurora_core.grounding.time_need import horizon_s
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.settings import Settings
from aurora_core.mission.plan import MissionPlan
from aurora_core.outcomes.grounded import GroundedAgent, GroundedScenario, ReleaseOn
from aurora_core.outcomes.grounding import GroundingFailure
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import MissionMode

Read = Callable[..., ScenarioSpec]
Ground = Callable[..., GroundedScenario]
Maps = Callable[[str], MapModel]

PAPER = ['survey', 'motorcycle', 'convoy', 'tailgate']
MORE = [
    'A bus drives 30 m ahead of the ego car and an ambulance follows 25 m behind it; a drone '
    'tracks the bus from 35 m at 60 m altitude.',
    'A drone flies an orbit with a radius of 40 m around the intersection at 35 m altitude.',
    'A drone hovers 40 m above the ego car for 20 seconds.',
    'The ego car drives; a drone tracks a motorcycle at 25 m altitude while four background cars '
    'circulate.',
]
CASES = [('downtown', p) for p in PAPER + MORE] + [('junction', p) for p in PAPER]


@pytest.fixture(params=CASES, ids=lambda c: f'{c[0]}-{c[1][:24]}')
def case(
    request: pytest.FixtureRequest, read_prompt: Read, ground: Ground, map_of: Maps
) -> tuple[ScenarioSpec, GroundedScenario, MapModel]:
    """A prompt, its grounding and the map."""
    map_name, prompt = request.param
    spec = read_prompt(prompt, map_name)
    return spec, ground(spec, map_name), map_of(map_name)


Case = tuple[ScenarioSpec, GroundedScenario, MapModel]


def test_everybody_is_there_once(case: Case) -> None:
    spec, found, the_map = case
    assert isinstance(found, GroundedScenario)
    assert [a.id for a in found.agents] == [a.id for a in spec.agents]
    assert [u.id for u in found.uavs] == [u.id for u in spec.uavs]
    assert [m.id for u in found.uavs for m in u.missions] == [m.id for m in spec.missions]
    assert (found.map_name, found.map_digest) == (the_map.name, the_map.digest)
    assert found.unsupported == ()
    assert len({u.system_id for u in found.uavs}) == len(found.uavs)
    assert 0.0 <= found.score.joint <= 1.0


def test_position_lane_and_route_say_the_same_place(case: Case) -> None:
    _, found, the_map = case
    for agent in found.agents:
        lane = the_map.network.lane(agent.lane_id)
        assert not lane.is_internal, 'nobody starts inside a junction'
        half_m = agent.length_m / 2.0
        for along_m in (half_m, -half_m):  # in a bend its ends are on the line
            end = lane.line.at(agent.lane_position_m + along_m)[:2]
            x = agent.x_m + along_m * agent.heading_x
            y = agent.y_m + along_m * agent.heading_y
            # A chord is shorter than the bend below it: one metre in a radius of 15 m by 3 cm.
            assert (x, y) == pytest.approx(end, abs=0.05 if along_m < 0.0 else 1e-3)
        assert agent.edges[0] == lane.edge_id
        assert agent.route_xy_m[0] == pytest.approx((agent.x_m, agent.y_m), abs=1e-9)


def test_nobody_reaches_into_a_junction_or_into_another(case: Case) -> None:
    _, found, the_map = case
    boxes = {a.id: _box(a) for a in found.agents}
    for a, b in combinations(found.agents, 2):
        assert not boxes[a.id].intersects(boxes[b.id]), (a.id, b.id)
    for agent in found.agents:
        half = agent.length_m / 2.0
        lane = the_map.network.lane(agent.lane_id)
        assert agent.lane_position_m + half <= lane.arc_length_m + 1e-6 or len(agent.edges) > 1


def _box(agent: GroundedAgent) -> shapely.Polygon:
    hx, hy = agent.heading_x, agent.heading_y
    a, b = agent.length_m / 2.0, agent.width_m / 2.0
    return shapely.Polygon(
        [
            (agent.x_m + i * a * hx - j * b * hy, agent.y_m + i * a * hy + j * b * hx)
            for i, j in ((1, 1), (1, -1), (-1, -1), (-1, 1))
        ]
    )


def _along(agent: GroundedAgent, x: float, y: float) -> float:
    """Return how far along an agent's route a point is, metres."""
    return float(
        shapely.line_locate_point(shapely.LineString(agent.route_xy_m), shapely.Point(x, y))
    )


def test_placement_distances_are_exact_along_the_route(case: Case) -> None:
    spec, found, _ = case
    by_id = {a.id: a for a in found.agents}
    for agent in spec.agents:
        for placement in agent.placements:
            if placement.distance_m is None or placement.of not in by_id:
                continue
            own, other = by_id[agent.id], by_id[str(placement.of)]
            rear, front = (own, other) if placement.relation.value == 'behind' else (other, own)
            gap = _along(rear, front.x_m, front.y_m)
            if placement.distance_m.provenance is Provenance.EXPLICIT:
                assert gap == pytest.approx(placement.distance_m.value, abs=0.01)
            assert gap > (own.length_m + other.length_m) / 2.0


def test_realised_values_are_measured(case: Case) -> None:
    spec, found, _ = case
    rows = {r.path: r for r in found.realised}
    assert len(rows) == len(found.realised)
    for row in rows.values():
        if row.provenance is Provenance.EXPLICIT:
            assert row.realised == pytest.approx(row.requested, abs=0.05)
    for mission in spec.missions:
        assert f'missions/{mission.id}/altitude_m' in rows


def test_explicit_values_are_flown_as_stated(case: Case) -> None:
    spec, found, _ = case
    plans = {m.id: m for u in found.uavs for m in u.missions}
    for mission in spec.missions:
        plan = plans[mission.id]
        assert plan.altitude_m == mission.altitude_m.value
        assert all(z == plan.altitude_m for _, _, z in plan.waypoints)
        if mission.standoff_m is not None and plan.mode is MissionMode.TRACK:
            away = sqrt(plan.offset_m[0] ** 2 + plan.offset_m[1] ** 2)
            assert away == pytest.approx(mission.standoff_m.value, abs=1e-9)
            assert plan.standoff_m == mission.standoff_m.value
        if mission.duration_s is not None:
            assert plan.duration_s == mission.duration_s.value
        if mission.speed_mps is not None:
            assert plan.speed_mps == mission.speed_mps.value


def test_flights_are_clear_of_buildings_and_zones(case: Case, settings: Settings) -> None:
    _, found, the_map = case
    air = Airspace(the_map.buildings, the_map.zones)
    clear = settings.grounding.clearance_m
    for uav in found.uavs:
        home = (uav.home_x_m, uav.home_y_m)
        first = uav.missions[0]
        column = ((*home, 0.5), (*home, first.altitude_m))
        assert air.way_clearance_m(column) >= settings.grounding.spot_clearance_m - 0.6
        for plan in uav.missions:
            if plan.waypoints:
                assert air.way_clearance_m(plan.waypoints) >= clear
                start = ((*home, plan.altitude_m), plan.waypoints[0])
                assert air.way_clearance_m(start) >= clear
            if plan.hover_point is not None:
                assert air.points_clearance_m(np.array([plan.hover_point])) >= clear
        for spot in uav.landing_spots:
            point = shapely.Point(spot)
            assert point.distance(the_map.network.street_surface) >= (
                settings.grounding.spot_clearance_m
            )
        assert uav.landing_spots[0] == home
        assert uav.safe_altitude_m > first.altitude_m - 1e-9


def test_patterns_have_their_size_around_their_centre(case: Case, tolerances: Tolerances) -> None:
    spec, found, the_map = case
    plans = {m.id: m for u in found.uavs for m in u.missions}
    for mission in spec.missions:
        plan = plans[mission.id]
        if mission.mode is not MissionMode.NAVIGATE:
            continue
        points = np.array([p[:2] for p in plan.waypoints])
        middle = (points.max(axis=0) + points.min(axis=0)) / 2.0
        x, y = _target(mission.target, found, the_map)
        away = sqrt((middle[0] - x) ** 2 + (middle[1] - y) ** 2)
        assert away <= tolerances.pattern_centre_m
        if mission.size_m is not None:
            legs = [
                sqrt((b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2) for a, b in pairwise(plan.waypoints)
            ]
            length, width = (p.value for p in mission.size_m)
            assert sorted(legs) == pytest.approx(sorted([length, width] * 2))
            assert plan.waypoints[0] == plan.waypoints[-1]
        if mission.radius_m is not None:
            radii = np.sqrt(np.sum((points - (x, y)) ** 2, axis=1))
            assert radii == pytest.approx(mission.radius_m.value)
        if mission.over_streets:
            assert _best_share(plan, the_map) >= tolerances.over_carriageway_share


def _target(target: str | None, found: GroundedScenario, the_map: MapModel) -> tuple[float, float]:
    for agent in found.agents:
        if agent.id == target:
            return agent.x_m, agent.y_m
    assert target == 'intersection'
    crossings = [j for j in the_map.network.junctions.values() if j.has_signal or j.kind != 'x']
    plan = found.uavs[0].missions[-1]
    points = np.array([p[:2] for p in plan.waypoints])
    middle = points[:-1].mean(axis=0)
    near = min(crossings, key=lambda j: (j.x_m - middle[0]) ** 2 + (j.y_m - middle[1]) ** 2)
    return near.x_m, near.y_m


def _best_share(plan: MissionPlan, the_map: MapModel) -> float:
    surface = the_map.network.carriageway
    lines = [shapely.LineString([a[:2], b[:2]]) for a, b in pairwise(plan.waypoints)]
    return max(float(line.intersection(surface).length) / float(line.length) for line in lines)


def test_tracked_targets_can_be_seen_from_the_planned_place(
    case: Case, tolerances: Tolerances
) -> None:
    _, found, the_map = case
    air = Airspace(the_map.buildings, the_map.zones)
    for uav in found.uavs:
        for plan in uav.missions:
            if plan.mode is not MissionMode.TRACK:
                continue
            target = next(a for a in found.agents if a.id == plan.target)
            line = shapely.LineString(target.route_xy_m)
            spots = [line.interpolate(d) for d in np.arange(0.0, 13.0 * 30.0, 5.0)]
            ground_points = np.array([(p.x, p.y, target.height_m / 2.0) for p in spots])
            offset = np.array([*plan.offset_m, 0.0])
            above = np.array([(p.x, p.y, plan.altitude_m) for p in spots]) + offset
            assert air.seen_share(above, ground_points, 250.0) >= tolerances.visible_fraction
            assert air.points_clearance_m(above) > 3.0


def test_routes_are_long_enough_and_never_end_in_a_dead_end(
    case: Case, limits: Limits, agent_types: Mapping[str, AgentTypeRecord]
) -> None:
    spec, found, the_map = case
    for agent in found.agents:
        vclass = agent_types[agent.type_name].vclass
        finder = RouteFinder(the_map.network, vclass)
        assert all(finder.endless(e) for e in agent.edges)
        for a, b in pairwise(agent.edges):
            assert b in the_map.network.successors(a, vclass)
        length = sum(
            sqrt((b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2) for a, b in pairwise(agent.route_xy_m)
        )
        # As long as the run at the highest speed limit that such traffic drives at.
        assert length > 15.0 * horizon_s(spec, limits)


def test_background_is_around_but_apart(case: Case, settings: Settings) -> None:
    spec, found, _ = case
    free = {a.id for a in spec.agents if a.role.value == 'background'}
    low, high = settings.grounding.background_radius_m
    origin = next((a for a in found.agents if a.id not in free), None)
    for agent in found.agents:
        if agent.id not in free or origin is None:
            continue
        for other in found.agents:
            if other.id != agent.id:
                away = sqrt((agent.x_m - other.x_m) ** 2 + (agent.y_m - other.y_m) ** 2)
                assert away >= settings.grounding.background_gap_m
        assert agent.release is ReleaseOn.START
    assert low < high


def test_a_crowd_is_spread_out_or_named(
    read_prompt: Read, ground: Ground, settings: Settings
) -> None:
    prompt = 'The ego car drives while forty background cars circulate.'
    for map_name in ('downtown', 'junction'):
        found = ground(read_prompt(prompt, map_name), map_name)
        for a, b in combinations(found.agents, 2):
            away = sqrt((a.x_m - b.x_m) ** 2 + (a.y_m - b.y_m) ** 2)
            assert away >= settings.grounding.background_gap_m, (a.id, b.id)
        # Forty cars have no room on the small map: who is missing is said.
        missing = 41 - len(found.agents)
        assert (missing > 0) is (map_name == 'junction')
        assert len(found.unsupported) == missing
        assert all('no free lane' in text for text in found.unsupported)


def test_held_agents_wait_for_a_uav_that_exists(case: Case) -> None:
    _, found, _ = case
    uavs = {u.id for u in found.uavs}
    for agent in found.agents:
        if agent.release in (ReleaseOn.ASCENDED, ReleaseOn.CAPTURED, ReleaseOn.OBSERVED):
            assert agent.release_uav in uavs


def test_the_same_again(
    map_of: Maps,
    agent_types: Mapping[str, AgentTypeRecord],
    limits: Limits,
    tolerances: Tolerances,
    settings: Settings,
    read_prompt: Read,
    ground: Ground,
) -> None:
    for map_name, prompt in (('junction', 'convoy'), ('downtown', 'survey')):
        fresh = Grounder(map_of(map_name), agent_types, limits, tolerances, settings)
        spec = read_prompt(prompt, map_name)
        first = fresh.ground(spec, 1)
        assert isinstance(first, GroundedScenario)
        assert first.canonical_json() == ground(spec, map_name).canonical_json()


def test_the_seed_moves_the_background_only(read_prompt: Read, ground: Ground) -> None:
    spec = read_prompt('convoy')
    one, two = ground(spec, seed=1), ground(spec, seed=2)
    same = [a.id for a, b in zip(one.agents, two.agents, strict=True) if a == b]
    assert set(same) == {a.id for a in spec.agents if a.role.value != 'background'}
    assert one.uavs == two.uavs


def test_canonical_json_round_trip(read_prompt: Read, ground: Ground) -> None:
    found = ground(read_prompt('tailgate'))
    again = GroundedScenario.model_validate_json(found.canonical_json())
    assert again == found
    assert again.canonical_json() == found.canonical_json()


def test_weather_gives_wind_and_sensing(read_prompt: Read, ground: Ground, limits: Limits) -> None:
    spec = read_prompt('In heavy rain at night a drone hovers 20 m above the ego car.')
    found = ground(spec)
    assert (found.weather, found.time_of_day) == ('heavy_rain', 'night')
    assert found.wind_mean_east_mps == limits.wind_mean_mps['heavy_rain'] > 0.0
    assert found.wind_gust_mps == limits.wind_gust_mps['heavy_rain']


@pytest.mark.parametrize(
    ('prompt', 'reason', 'told'),
    [
        # The houses around the junction stand in the way at this height.
        (
            'A drone flies a 120 m by 120 m rectangle at 4 m altitude around the intersection.',
            'clearance',
            'a greater altitude would fit',
        ),
        # Sensing range at night in fog: 45 m.
        ('In fog at night a drone tracks a motorcycle at 100 m altitude.', 'sight', 'not see'),
        # Their boxes would overlap.
        (
            'A truck drives 2 m ahead of the ego car; a drone tracks the ego car.',
            'road',
            '6.8 m would fit',
        ),
    ],
)
def test_what_has_no_place_fails_with_its_reason(
    prompt: str, reason: str, told: str, read_prompt: Read, ground: Ground
) -> None:
    found = ground(read_prompt(prompt, 'junction'), 'junction')
    assert isinstance(found, GroundingFailure)
    assert found.reason == reason
    assert told in found.told
    assert f'{found.tried} ' in found.told or not found.tried
    assert found.tried == sum(found.rejected_by.values())
    assert (found.tried == 0) == (reason == 'road')


@pytest.mark.parametrize(
    ('prompt', 'told'),
    [
        (
            'The ego car is at Union Station. A truck is 12 m behind the ego car at City Hall.',
            ('ego at Union Station', 'truck1', 'would'),
        ),
        # Left alone, the van would start before the beginning of its street.
        (
            'The ego is at City Hall. A van is 1500 m ahead of the ego at Union Station.',
            ('ego at City Hall', 'van1', 'would'),
        ),
    ],
)
def test_vehicles_without_a_street_are_named_with_what_would_fit(
    prompt: str, told: tuple[str, ...], read_prompt: Read, ground: Ground
) -> None:
    found = ground(read_prompt(prompt, 'downtown'), 'downtown')
    assert isinstance(found, GroundingFailure)
    assert [word for word in told if word not in found.told] == []


def test_a_stated_bearing_is_kept(
    read_prompt: Read, ground: Ground, tolerances: Tolerances
) -> None:
    spec = read_prompt('A drone tracks the motorcycle from 30 m at 60 m altitude.')
    mission = spec.missions[0].model_dump()
    bearing = {**mission['altitude_m'], 'value': 90.0, 'unit': 'deg', 'low': 0.0, 'high': 360.0}
    changed = ScenarioSpec.model_validate(
        {**spec.model_dump(), 'missions': [{**mission, 'bearing_deg': bearing}]}
    )
    found = ground(changed)
    east, north = found.uavs[0].missions[0].offset_m
    compass = (90.0 - atan2(north, east) * 180.0 / pi) % 360.0
    assert abs(compass - 90.0) <= tolerances.bearing_deg
    hover = {**mission, 'mode': 'hover', 'bearing_deg': bearing}
    found = ground(ScenarioSpec.model_validate({**spec.model_dump(), 'missions': [hover]}))
    point = found.uavs[0].missions[0].hover_point
    assert point is not None
    target = found.agents[0]
    assert point[0] - target.x_m == pytest.approx(30.0, abs=1e-6)
    assert point[1] - target.y_m == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize(
    ('prompt', 'altitude_m'),
    [
        ('A drone hovers over the intersection at at least 40 m for 20 s.', 42.0),
        ('A drone hovers over the intersection at no more than 40 m for 20 s.', 38.0),
        ('A drone hovers over the intersection at at least 119 m for 20 s.', 120.0),  # the limit
        ('A drone hovers over the intersection at 40 m for 20 s.', 40.0),
    ],
)
def test_an_altitude_is_chosen_inside_its_bound(
    prompt: str, altitude_m: float, read_prompt: Read, ground: Ground
) -> None:
    (uav,) = ground(read_prompt(prompt)).uavs
    assert uav.missions[0].altitude_m == pytest.approx(altitude_m)


def test_who_receives_a_message_starts_near(read_prompt: Read, ground: Ground) -> None:
    prompt = 'When the bus goes slower than 2 m/s, the drone warns the ambulance.'
    agents = {a.id: a for a in ground(read_prompt(prompt)).agents}
    bus, ambulance = agents['bus1'], agents['ambulance1']
    assert sqrt((bus.x_m - ambulance.x_m) ** 2 + (bus.y_m - ambulance.y_m) ** 2) < 100.0


def test_who_has_to_be_faster_than_a_number_drives_so(read_prompt: Read, ground: Ground) -> None:
    prompt = 'A drone tracks a van. When the van drives faster than 11 m/s, it alerts the ego.'
    agents = {a.id: a for a in ground(read_prompt(prompt)).agents}
    assert agents['van1'].drive_speed_mps is not None
    assert 11.0 < agents['van1'].drive_speed_mps <= 13.0


def test_those_behind_one_other_stand_one_behind_the_next(
    read_prompt: Read, ground: Ground
) -> None:
    prompt = (
        'A car follows the bus, a van tailgates the bus and a motorcycle overtakes it; a drone '
        'tracks the bus.'
    )
    agents = {a.id: a for a in ground(read_prompt(prompt)).agents}
    bus = agents['bus1']
    behind = {
        name: (bus.x_m - one.x_m) * bus.heading_x + (bus.y_m - one.y_m) * bus.heading_y
        for name, one in agents.items()
    }
    assert 0.0 < behind['van1'] < behind['car1']
    assert behind['motorcycle1'] > 0.0
    assert agents['motorcycle1'].lane_id != agents['van1'].lane_id
    for one, other in combinations(agents.values(), 2):
        assert not _box(one).intersects(_box(other))


def test_the_lowest_altitude_is_never_undercut(read_prompt: Read, ground: Ground) -> None:
    (uav,) = ground(read_prompt('Hover at 3 m for ten seconds.')).uavs
    assert uav.missions[0].ascent_tolerance_m <= 0.3


def test_the_last_one_in_line_still_follows_the_first(read_prompt: Read, ground: Ground) -> None:
    prompt = 'Three cars follow a bus; a drone tracks the bus.'
    bus, *cars = sorted(
        ground(read_prompt(prompt)).agents, key=lambda a: (a.type_name != 'bus', a.id)
    )
    away = sorted(sqrt((bus.x_m - a.x_m) ** 2 + (bus.y_m - a.y_m) ** 2) for a in cars)
    assert away[-1] < 55.0
    assert min(b - a for a, b in pairwise(away)) > 10.0
    # Those in between keep the gap that they start with.
    assert all(a.time_gap_s is not None and a.time_gap_s < 0.1 for a in cars)
