# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""From a grounded graph to loads, roster, world and a run with simple simulators."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
import shapely

from aurora_core.agsg.build import build_agsg
from aurora_core.errors import ExecutionError
from aurora_core.execution.faults import Fault, read_fault
from aurora_core.execution.observe import Observation
from aurora_core.execution.plan import (
    EXECUTOR_VERSION,
    UAV_SIZE_M,
    Execution,
    build_execution,
)
from aurora_core.execution.step_output import StepOutput
from aurora_core.geometry.polyline import Polyline
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.settings import Settings
from aurora_core.knowledge.world import SurfaceKind
from aurora_core.outcomes.agsg import Agsg, Stage
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import LinkOcclusion
from aurora_core.temporal.schedule import plan_time
from aurora_core.trace.hashing import trace_sha256
from aurora_core.trace.layout import (
    GROUND_WIDTH,
    UAV_WIDTH,
    GroundColumn,
    GroundCommandKind,
    UavColumn,
    UavMode,
)
from aurora_core.trace.records import LinkEventKind, LossReason, ScenarioEventKind
from aurora_core.trace.trace import Trace

FloatArray = npt.NDArray[np.float64]
MAP = 'junction'
PAPER = ['survey', 'motorcycle', 'convoy', 'tailgate']


class Simulators:
    """Agents that slide along their routes and UAVs that are where they are told to be."""

    def __init__(self, execution: Execution) -> None:
        self._execution = execution
        roster = execution.roster
        self._lines = [Polyline(np.array(a.route_xy_m)) for a in roster.agents]
        self._arcs = [0.0] * len(roster.agents)
        self._wanted = [0.0] * len(roster.agents)
        self._factors = [a.speed_factor for a in execution.ground_load.agents]
        self.ground = np.zeros((len(roster.agents), GROUND_WIDTH))
        self.ground[:, GroundColumn.PRESENT] = 1.0
        self.uav = np.zeros((len(roster.uavs), UAV_WIDTH))
        self.uav[:, UavColumn.QW] = self.uav[:, UavColumn.LANDED] = 1.0
        for k, home in enumerate(execution.air_load.homes):
            self.uav[k, UavColumn.X], self.uav[k, UavColumn.Y] = home.x_m, home.y_m
        self._place()

    def advance(self, output: StepOutput) -> None:
        """Take the commands of a step and move on by one tick."""
        dt_s = self._execution.roster.dt_s
        for command in output.ground_commands:
            row = command.agent
            if command.kind is GroundCommandKind.SET_SPEED:
                self._wanted[row] = command.value
            elif command.kind is GroundCommandKind.RELEASE_SPEED:
                self._wanted[row] = 12.0 * self._factors[row]
            elif command.kind is GroundCommandKind.REMOVE:
                self.ground[row, GroundColumn.PRESENT] = 0.0
        for row, wanted in enumerate(self._wanted):
            speed = self.ground[row, GroundColumn.SPEED]
            speed += min(3.0 * dt_s, max(-6.0 * dt_s, wanted - speed))
            self.ground[row, GroundColumn.SPEED] = speed
            self._arcs[row] = min(self._arcs[row] + speed * dt_s, self._lines[row].length_m)
        self._place()
        for k, row_of in enumerate(output.uav_commands):
            self._fly(self.uav[k], row_of, dt_s)

    def _place(self) -> None:
        for row, line in enumerate(self._lines):
            self.ground[row, : GroundColumn.SPEED] = line.at(self._arcs[row])

    def _fly(self, state: FloatArray, command: FloatArray, dt_s: float) -> None:
        mode = int(command[0])
        before = state[: UavColumn.Z + 1].copy()
        if mode == UavMode.TAKEOFF:
            state[UavColumn.Z] = min(command[8], state[UavColumn.Z] + 3.0 * dt_s)
        elif mode == UavMode.OFFBOARD:
            state[: UavColumn.Z + 1] = command[1:4]
        elif mode == UavMode.LAND:
            state[UavColumn.Z] = max(0.0, state[UavColumn.Z] - 1.5 * dt_s)
        state[UavColumn.VX : UavColumn.VZ + 1] = (state[: UavColumn.Z + 1] - before) / dt_s
        down = state[UavColumn.Z] <= 0.0
        state[UavColumn.LANDED] = float(down)
        state[UavColumn.ARMED] = float(
            mode != UavMode.IDLE and not (down and mode == UavMode.LAND)
        )


def run(execution: Execution) -> tuple[Trace, list[StepOutput]]:
    """Run to the end."""
    simulators = Simulators(execution)
    ground, uav, outputs = [], [], []
    for tick in range(40000):
        ground.append(simulators.ground.copy())
        uav.append(simulators.uav.copy())
        output = execution.stepper.step(tick, ground[-1], uav[-1])
        outputs.append(output)
        if output.finished:
            break
        simulators.advance(output)
    flown = [np.zeros_like(outputs[0].uav_commands), *(o.uav_commands for o in outputs[:-1])]
    trace = Trace(
        roster=execution.roster,
        ground=np.array(ground),
        uav=np.array(uav),
        uav_commands=np.array(flown),
        ground_commands=((), *(o.ground_commands for o in outputs[:-1])),
        links=tuple(r for o in outputs for r in o.links),
        sights=tuple(r for o in outputs for r in o.sights),
        events=tuple(r for o in outputs for r in o.events),
    )
    return trace, outputs


@pytest.fixture
def graph(
    read_prompt: Callable[..., ScenarioSpec],
    ground: Callable[..., GroundedScenario],
    limits: Limits,
    tolerances: Tolerances,
) -> Callable[[str], Agsg]:
    """Build the grounded graph of a prompt on the junction map."""

    def build(prompt: str) -> Agsg:
        spec = read_prompt(prompt, MAP)
        found = ground(spec, MAP)
        return build_agsg(
            spec,
            map_digest=found.map_digest,
            stage=Stage.GROUNDED,
            grounding=found,
            schedule=plan_time(spec, found, limits, tolerances),
        )

    return build


Build = Callable[..., Execution]


@pytest.fixture
def build(
    graph: Callable[[str], Agsg],
    map_of: Callable[[str], MapModel],
    limits: Limits,
    tolerances: Tolerances,
    settings: Settings,
) -> Build:
    """Build the execution of a prompt or of a graph."""

    def make(agsg: Agsg | str, map_name: str = MAP, **options: Any) -> Execution:
        return build_execution(
            graph(agsg) if isinstance(agsg, str) else agsg,
            map_of(map_name),
            limits=limits,
            tolerances=tolerances,
            settings=settings,
            seed=options.pop('seed', 1),
            **options,
        )

    return make


def test_a_graph_that_is_not_grounded_is_refused(
    build: Build, graph: Callable[[str], Agsg]
) -> None:
    agsg = graph('survey')
    for field in ('grounding', 'schedule'):
        with pytest.raises(ExecutionError, match='not grounded') as caught:
            build(agsg.model_copy(update={field: None}))
        assert caught.value.hint


def test_a_graph_for_another_executor_is_refused(
    build: Build, graph: Callable[[str], Agsg]
) -> None:
    agsg = graph('survey')
    assert agsg.grounding is not None
    later = agsg.grounding.model_copy(update={'executor_version': EXECUTOR_VERSION + 1})
    with pytest.raises(ExecutionError, match='of the executor') as caught:
        build(agsg.model_copy(update={'grounding': later}))
    assert caught.value.hint


def test_another_map_than_the_grounded_one_is_refused(build: Build) -> None:
    with pytest.raises(ExecutionError, match='map digest'):
        build('survey', 'downtown')


def test_a_message_without_a_link_is_refused(build: Build, graph: Callable[[str], Agsg]) -> None:
    agsg = graph('tailgate')
    spec = ScenarioSpec.model_validate({**agsg.spec.model_dump(), 'links': ()})
    with pytest.raises(ExecutionError, match='no link between them') as caught:
        build(agsg.model_copy(update={'spec': spec}))
    assert 'uav1 to ego' in caught.value.message


@pytest.mark.parametrize(
    ('occlusion', 'sees', 'last'),
    [
        ('shortens', False, LinkEventKind.DELIVERED),
        ('blocks', False, LinkEventKind.FAILED),
        ('blocks', True, LinkEventKind.DELIVERED),
        ('ignored', False, LinkEventKind.DELIVERED),
    ],
)
def test_what_is_in_between_does_to_a_message_what_the_link_says(
    build: Build,
    graph: Callable[[str], Agsg],
    monkeypatch: pytest.MonkeyPatch,
    occlusion: str,
    sees: bool,
    last: LinkEventKind,
) -> None:
    monkeypatch.setattr(Observation, 'line_of_sight', lambda *_: sees)
    agsg = graph('tailgate')
    (link,) = agsg.spec.links
    spec = agsg.spec.model_copy(
        update={'links': (link.model_copy(update={'occlusion': LinkOcclusion(occlusion)}),)}
    )
    trace, _ = run(build(agsg.model_copy(update={'spec': spec})))
    assert trace.links[-1].kind is last
    lost = {r.reason for r in trace.links if r.kind is LinkEventKind.ATTEMPT_LOST}
    assert lost == ({LossReason.RANGE} if last is LinkEventKind.FAILED else set())


def test_a_fault_on_an_unknown_subject_is_refused(build: Build) -> None:
    with pytest.raises(ExecutionError, match="'car9'"):
        build('survey', faults=(Fault(kind='target_removed', subject='car9'),))


@pytest.mark.parametrize('prompt', PAPER)
def test_roster_and_loads_name_everybody_in_order(
    prompt: str,
    build: Build,
    graph: Callable[[str], Agsg],
    agent_types: Mapping[str, AgentTypeRecord],
    settings: Settings,
) -> None:
    agsg, execution = graph(prompt), build(prompt)
    roster, found = execution.roster, agsg.grounding
    assert found is not None
    assert roster.dt_s == settings.run.dt_s == execution.ground_load.dt_s
    assert [a.body_id for a in roster.agents] == [a.id for a in agsg.spec.agents]
    assert [u.body_id for u in roster.uavs] == [u.id for u in agsg.spec.uavs]
    for entry, spec, load, placed in zip(
        roster.agents, agsg.spec.agents, execution.ground_load.agents, found.agents, strict=True
    ):
        record = agent_types[spec.type.value]
        assert (entry.length_m, entry.width_m, entry.height_m) == (
            record.length_m,
            record.width_m,
            record.height_m,
        )
        assert (entry.role, entry.type_name) == (spec.role.value, spec.type.value)
        assert (load.agent_id, load.type_name) == (spec.id, spec.type.value)
        assert load.edges == entry.route_edges == placed.edges
        assert entry.route_xy_m == placed.route_xy_m
        assert (load.lane_id, load.lane_position_m) == (placed.lane_id, placed.lane_position_m)
        assert load.speed_factor == placed.speed_factor
        assert roster.agent_index(spec.id) == agsg.spec.agents.index(spec)
    for row, (entry, home, plan) in enumerate(
        zip(roster.uavs, execution.air_load.homes, found.uavs, strict=True)
    ):
        assert (entry.length_m, entry.width_m, entry.height_m) == UAV_SIZE_M
        assert entry.system_id == home.system_id == plan.system_id
        assert (home.uav_id, home.x_m, home.y_m) == (entry.body_id, plan.home_x_m, plan.home_y_m)
        assert roster.uav_index(entry.body_id) == row
    assert roster.agent_index('uav1') is None
    assert roster.uav_index('ego') is None


def test_the_world_holds_the_whole_map(
    build: Build, map_of: Callable[[str], MapModel], limits: Limits
) -> None:
    execution, the_map = build('tailgate'), map_of(MAP)
    world = execution.world
    assert (world.map_name, world.map_digest) == (the_map.name, the_map.digest)
    assert world.buildings == the_map.buildings
    assert world.no_fly_zones == the_map.zones
    assert world.limits == limits
    driving = [s for s in world.surfaces if s.kind is SurfaceKind.DRIVING]
    area = sum(shapely.Polygon(s.ring, list(s.holes)).area for s in driving)
    assert area == pytest.approx(the_map.network.carriageway.area)
    crossings = [s for s in world.surfaces if s.kind is SurfaceKind.CROSSING]
    assert len(crossings) == len(the_map.network.crossings) > 0
    assert {c.lane_id for c in world.lanes} == {
        lane.id for lane in the_map.network.driving_lanes('passenger')
    }
    assert [p.junction_id for p in world.signals] == sorted(
        j.id for j in the_map.network.junctions.values() if j.has_signal
    )
    places = {p.name: (p.x_m, p.y_m) for p in world.places}
    marks = {f'landmark:{m.name}': (m.x_m, m.y_m) for m in the_map.landmarks}
    assert marks.items() <= places.items()
    assert {name.partition(':')[0] for name in places.keys() - marks.keys()} == {'approach'}
    assert (world.origin_lat_deg, world.origin_lon_deg) == (
        execution.air_load.origin_lat_deg,
        execution.air_load.origin_lon_deg,
    )
    assert execution.ground_load.map_digest == world.map_digest
    assert execution.ground_load.net_path.is_file()
    assert execution.ground_load.vtypes_path.is_file()


def test_weather_reaches_world_and_simulators(build: Build, limits: Limits) -> None:
    execution = build('In heavy rain a drone hovers 20 m above the ego car.')
    wind = limits.wind_mean_mps['heavy_rain']
    assert execution.world.wind.mean_east_mps == execution.air_load.wind_mean_east_mps == wind
    assert execution.world.wind.gust_mps == execution.air_load.wind_gust_mps > 0.0
    assert execution.world.weather == execution.ground_load.weather == 'heavy_rain'


@pytest.mark.parametrize('prompt', PAPER)
def test_a_run_comes_to_its_end(prompt: str, build: Build) -> None:
    execution = build(prompt)
    trace, outputs = run(execution)
    assert outputs[-1].outcome == 'finished'
    assert trace.time_s(trace.ticks - 1) <= execution.horizon_s
    assert trace.uav[-1, :, UavColumn.LANDED].all()
    phases = [e.detail for e in trace.events if e.kind is ScenarioEventKind.PHASE]
    assert phases == ['ascent', 'm1', 'landing']
    assert trace.events[-1].kind is ScenarioEventKind.FINISHED
    held = {e.subject for e in trace.events if e.kind is ScenarioEventKind.RELEASED}
    waiting = [a.agent_id for a in execution.ground_load.agents]
    assert held <= set(waiting)


def test_the_alert_of_the_paper_is_sent_and_delivered(build: Build) -> None:
    trace, _ = run(build('tailgate'))
    kinds = [r.kind for r in trace.links]
    assert kinds == [LinkEventKind.SENT, LinkEventKind.ATTEMPT_PASSED, LinkEventKind.DELIVERED]
    sent = trace.links[0]
    van, ego = (trace.roster.agent_index(n) for n in ('van1', 'ego'))
    assert van is not None
    assert ego is not None
    apart = trace.ground[:, van, :2] - trace.ground[:, ego, :2]
    distance = np.sqrt(np.sum(apart * apart, axis=1))
    assert distance[sent.tick] <= 20.0 < distance[sent.tick - 1]
    assert trace.links[-1].tick == sent.tick + 2


def test_the_same_seed_gives_the_same_trace(build: Build) -> None:
    def digest(seed: int) -> str:
        execution = build('tailgate', seed=seed)
        return trace_sha256(run(execution)[0], execution.world)

    assert digest(1) == digest(1)


def test_chance_comes_from_the_seed(build: Build, graph: Callable[[str], Agsg]) -> None:
    agsg = graph('tailgate')
    links = [{**agsg.spec.links[0].model_dump(), 'loss': _loss(agsg)}]
    lossy = agsg.model_copy(
        update={'spec': ScenarioSpec.model_validate({**agsg.spec.model_dump(), 'links': links})}
    )

    def attempts(seed: int) -> tuple[int, ...]:
        return tuple(int(r.kind) for r in run(build(lossy, seed=seed))[0].links)

    assert attempts(1) == attempts(1)
    assert len({attempts(seed) for seed in (1, 2, 3, 4)}) > 1


def _loss(agsg: Agsg) -> dict[str, Any]:
    return {**agsg.spec.links[0].loss.model_dump(), 'value': 0.6}


@pytest.mark.parametrize(
    ('kind', 'subject', 'at_s'),
    [('target_removed', 'van1', 12.0), ('link_loss', '*', 0.0)],
)
def test_faults_change_the_run(kind: str, subject: str, at_s: float, build: Build) -> None:
    fault = Fault(kind=kind, subject=subject, at_s=at_s)  # type: ignore[arg-type]
    trace, _ = run(build('tailgate', faults=(fault,)))
    announced = [e for e in trace.events if e.kind is ScenarioEventKind.FAULT]
    assert [(read_fault(e.subject, e.detail), e.tick) for e in announced] == [
        (fault, round(at_s / 0.05))
    ]
    assert LinkEventKind.DELIVERED not in {r.kind for r in trace.links}


def test_who_is_kept_away_is_never_faster_than_the_fault_says(build: Build) -> None:
    trace, _ = run(build('tailgate', faults=(Fault(kind='keep_away', subject='van1'),)))
    row = trace.roster.agent_index('van1')
    assert row is not None
    assert trace.ground[:, row, GroundColumn.SPEED].max() == 3.0


def test_two_executions_share_nothing(build: Build) -> None:
    one, two = build('motorcycle'), build('motorcycle')
    run(one)
    fresh, _ = run(two)
    again, _ = run(build('motorcycle'))
    assert trace_sha256(fresh, two.world) == trace_sha256(again, two.world)
