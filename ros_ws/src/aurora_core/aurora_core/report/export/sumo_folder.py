# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A run as a scenario that `sumo` runs alone: who starts where, on which route, and when.

Without the executor SUMO drives by itself: what a scenario commands on the way (braking, changing
lanes, keeping a gap) is not in it, and soon everybody may be elsewhere than recorded. What was
recorded lies beside it as floating-car data, in SUMO's own format (`--fcd-output`).

Source: SUMO user documentation, "Definition of Vehicles, Vehicle Types, and Routes",
"Pedestrians", "FCDOutput".
"""

from __future__ import annotations

from copy import deepcopy
from xml.etree.ElementTree import Element, SubElement, fromstring, indent, tostring

import numpy as np

from aurora_core.errors import ReportError
from aurora_core.geometry.frames import heading_to_sumo_angle
from aurora_core.knowledge.road_network import RoadNetwork
from aurora_core.outcomes.grounded import GroundedAgent
from aurora_core.trace.layout import GroundColumn
from aurora_core.trace.trace import Trace

ROUTES, CONFIGURATION, RECORDED = 'scenario.rou.xml', 'scenario.sumocfg', 'recorded.fcd.xml'
# Slower than this it stands, m/s; for as long as this at least, s.
_STANDING_MPS, _STANDING_S = 0.05, 0.5
_LONG_S = 1.0e5


def routes_text(
    trace: Trace, agents: tuple[GroundedAgent, ...], network: RoadNetwork, vtypes: bytes
) -> str:
    """Return who takes part, with a vehicle type for each.

    Args:
        trace: The run: it tells when somebody who waits sets off.
        agents: As they were grounded.
        network: Of the map.
        vtypes: Additional file with the vehicle types of the run.

    Raises:
        ReportError: A type is not among them.
    """
    types = {str(e.get('id')): e for e in fromstring(vtypes).iter('vType')}  # nosec B314
    root = Element('routes')
    for agent in agents:
        if agent.type_name not in types:
            raise ReportError(f'the vehicle type {agent.type_name} of {agent.id} is not installed')
        root.append(_type_of(agent, types[agent.type_name]))
    drivers = [a for a in agents if not a.is_person]
    root.extend(_vehicle(a, network, _standing_s(trace, a.id)) for a in drivers)
    walkers = [_person(a, network, _standing_s(trace, a.id)) for a in agents if a.is_person]
    # SUMO reads departures in their order.
    root.extend(sorted(walkers, key=lambda walker: float(walker.get('depart', '0'))))
    return _xml(root)


def configuration_text(*, net: str, dt_s: float, seed: int, end_s: float) -> str:
    """Return the configuration, with the options that the run had.

    Args:
        net: Network file beside it.
        dt_s: Step length.
        seed: Of the run.
        end_s: When to end.
    """
    root = Element('configuration')
    for section, options in (
        ('input', {'net-file': net, 'route-files': ROUTES}),
        ('time', {'begin': '0', 'end': f'{end_s:.2f}', 'step-length': f'{dt_s:g}'}),
        ('processing', {
            'time-to-teleport': '-1', 'collision.action': 'warn', 'lanechange.duration': '3',
            'default.speeddev': '0', 'pedestrian.striping.dawdling': '0',
        }),
        ('random_number', {'seed': str(seed)}),
        ('report', {'no-step-log': 'true'}),
    ):  # fmt: skip
        part = SubElement(root, section)
        for name, value in options.items():
            SubElement(part, name, value=value)
    return _xml(root)


def recorded_text(trace: Trace) -> str:
    """Return the recorded motion of everybody on the ground as floating-car data.

    As in SUMO: x and y are those of the front bumper, angles count clockwise from north.
    """
    root = Element('fcd-export')
    for tick in range(trace.ticks):
        step = SubElement(root, 'timestep', time=f'{trace.time_s(tick):.2f}')
        for row, entry in enumerate(trace.roster.agents):
            state = trace.ground[tick, row]
            if not np.isfinite(state).all() or state[GroundColumn.PRESENT] < 0.5:
                continue
            hx, hy = float(state[GroundColumn.HEADING_X]), float(state[GroundColumn.HEADING_Y])
            ahead = 0.0 if entry.is_person else entry.length_m / 2.0
            SubElement(
                step, 'person' if entry.is_person else 'vehicle', id=entry.body_id,
                x=f'{state[GroundColumn.X] + ahead * hx:.2f}',
                y=f'{state[GroundColumn.Y] + ahead * hy:.2f}',
                angle=f'{heading_to_sumo_angle(hx, hy):.2f}', type=entry.type_name,
                speed=f'{state[GroundColumn.SPEED]:.2f}',
            )  # fmt: skip
    return _xml(root)


def _xml(root: Element) -> str:
    indent(root)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{tostring(root, encoding="unicode")}\n'


def _type_of(agent: GroundedAgent, base: Element) -> Element:
    """Return the type of one agent: that of its kind with what grounding decided."""
    made = deepcopy(base)
    made.tail = None
    made.set('id', f'{agent.id}_type')
    decided = {
        'tau': agent.time_gap_s,
        'minGap': agent.min_gap_m,
        'accel': agent.gentle_mps2,
        'maxSpeed': agent.drive_speed_mps,
    }
    for name, value in decided.items():
        if value is not None:
            made.set(name, f'{value:.6g}')
    made.set('speedFactor', f'{agent.speed_factor:.6g}')
    return made


def _standing_s(trace: Trace, name: str) -> float:
    """Return how long somebody stands at first, 0 when it drives from the beginning."""
    row = trace.roster.agent_index(name)
    if row is None:
        return 0.0
    moving = np.flatnonzero(trace.ground[:, row, GroundColumn.SPEED] > _STANDING_MPS)
    begin_s = trace.time_s(int(moving[0])) if len(moving) else _LONG_S
    return begin_s if begin_s >= _STANDING_S else 0.0


def _vehicle(agent: GroundedAgent, network: RoadNetwork, wait_s: float) -> Element:
    lane, front_m = _front(agent, network)
    made = Element(
        'vehicle', id=agent.id, type=f'{agent.id}_type', depart='0',
        departLane=lane.rpartition('_')[2], departPos=f'{front_m:.2f}',
        departSpeed=f'{0.0 if wait_s else agent.speed_mps:.2f}', insertionChecks='none',
    )  # fmt: skip
    SubElement(made, 'route', edges=' '.join(agent.edges))
    if wait_s or agent.parked:
        SubElement(
            made, 'stop', lane=lane, endPos=f'{front_m + 0.1:.2f}', until=f'{wait_s:.2f}',
            parking='true' if agent.parked else 'false', friendlyPos='true',
        )  # fmt: skip
    if agent.stop_lane_id:
        stands_s = _LONG_S if agent.stop_s is None else agent.stop_s
        SubElement(
            made, 'stop', lane=agent.stop_lane_id, duration=f'{stands_s:g}', friendlyPos='true',
            endPos=f'{agent.stop_position_m + agent.length_m / 2.0:.2f}',
        )  # fmt: skip
    return made


def _front(agent: GroundedAgent, network: RoadNetwork) -> tuple[str, float]:
    """Return the lane and the place of the front bumper, as far ahead as the lane goes."""
    lane = network.lane(agent.lane_id)
    front_m = agent.lane_position_m + agent.length_m / 2.0
    # SUMO counts the lane of a curve by another length than it is drawn with.
    counted_m = front_m * lane.length_m / lane.line.length_m
    return agent.lane_id, min(counted_m, lane.length_m)


def _person(agent: GroundedAgent, network: RoadNetwork, wait_s: float) -> Element:
    """Return a person who walks from when it sets off; one who never does stands."""
    stands = wait_s >= _LONG_S or len(agent.edges) == 0
    made = Element(
        'person', id=agent.id, type=f'{agent.id}_type',
        depart='0' if stands else f'{wait_s:.2f}', departPos=f'{agent.lane_position_m:.2f}',
    )  # fmt: skip
    if stands:
        edge = network.edge(agent.edges[0])
        lane = next(
            (i for i in edge.lane_ids if 'pedestrian' in network.lane(i).allows), edge.lane_ids[0]
        )
        SubElement(made, 'stop', lane=lane, duration=f'{_LONG_S:g}', friendlyPos='true',
                   endPos=f'{agent.lane_position_m:.2f}')  # fmt: skip
        return made
    walk = SubElement(made, 'walk', edges=' '.join(agent.edges))
    if agent.arrival_position_m is not None:
        walk.set('arrivalPos', f'{agent.arrival_position_m:.2f}')
    return made
