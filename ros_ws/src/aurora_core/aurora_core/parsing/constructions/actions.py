# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What an event does: send a message, a change of a ground agent, a change of a UAV."""

from __future__ import annotations

from aurora_core.parsing import values
from aurora_core.parsing.adjuncts import Adjunct, AdjunctKind
from aurora_core.parsing.atoms import ACTORS
from aurora_core.parsing.constructions import missions
from aurora_core.parsing.constructions.flight_values import take_flight_values
from aurora_core.parsing.constructions.flyers import flyers, landed_by
from aurora_core.parsing.constructions.messages import message
from aurora_core.parsing.constructions.places import (
    add_placement,
    lane_side,
    place_of,
    placements_of,
)
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.measure import ACCELERATION
from aurora_core.parsing.pronouns import mobile
from aurora_core.parsing.reactions import REACTIONS
from aurora_core.parsing.scene import Entity, Scene
from aurora_core.spec.events import BRAKING, AgentDo
from aurora_core.spec.scenario import AgentAction, Behavior, EventAction, UavAction
from aurora_core.spec.vocabulary import AgentType, BehaviorKind, MissionMode

# What ground agents do, by verb.
_AGENT_DO: dict[str, AgentDo] = {
    **{do: do for do in REACTIONS},
    'step_onto': 'cross',
    'wait': 'stop',
    'drive': 'start',
    'walk': 'start',
    'ascend': 'start',
}
# Only as the effect of an event: a plain `drives` is a behaviour.
_ONLY_TRIGGERED = frozenset({'wait', 'drive', 'walk'})


def action(frame: Frame) -> EventAction | None:
    """Read the effect of an event."""
    return (
        message(frame)
        or _sets_to_work(frame)
        or agent_action(frame, triggered=True)
        or _uav_action(frame)
    )


def _sets_to_work(frame: Frame) -> UavAction | None:
    """`drone B tracks a bus. It may only start when drone A is done`: its flight, told before."""
    if frame.negated or frame.key not in ('start', 'ascend') or frame.free(AdjunctKind.MEASURE):
        return None
    if any(a.measure is not None for a in frame.adjuncts):
        return None
    if not frame.scene.missions:
        return None
    acting = frame.subjects() if frame.subject_nouns else frame.inherited()
    if len(acting) != 1 or not acting[0].is_uav:
        return None
    told = frame.scene.missions_of(acting[0])
    caused = [e.action.mission for e in frame.scene.events if isinstance(e.action, UavAction)]
    if not told or told[0].id in caused:
        return None
    frame.scene.became(told[0].id)
    return UavAction(do='change_mission', uav=acting[0].id, mission=told[0].id)


def agent_action(frame: Frame, *, triggered: bool = False) -> AgentAction | None:
    """Read `brakes`, `stops`, `slows to 5 m/s`, `changes lanes`."""
    if frame.negated or frame.key not in _AGENT_DO:
        return None
    if frame.key == 'ascend':
        return None
    if frame.key in _ONLY_TRIGGERED and not triggered:
        return None
    who = frame.subjects(_on_wheels if frame.key in _WITH_WHEELS else mobile)
    if len(who) != 1:
        return None
    speed = None
    adjunct = frame.attribute('speed')
    changes = adjunct is not None and adjunct.prep == 'by'  # `by 4 m/s` is no speed to reach
    if adjunct is not None and adjunct.measure is not None and not changes:
        if not values.accepts('ground_speed', adjunct.measure):
            return None
        adjunct.used = True
        speed = values.explicit('ground_speed', adjunct.measure)
        if _in_brackets(frame, adjunct):  # `the car (40 km/h) brakes`: it drives at that speed
            drive = Behavior(kind=BehaviorKind.DRIVE, speed_mps=speed, span=frame.span)
            who[0].behaviors.append(drive)
            speed = None
    if frame.key in ('yield', 'change_lane'):
        for other in frame.free(AdjunctKind.PHRASE, 'to') + frame.free(AdjunctKind.OBJECT):
            # whom it yields to has no place in an action, nor whose lane it takes
            other.used = frame.key == 'change_lane'
            frame.objects([n for n in other.nouns if n.kind in ACTORS])
    if frame.key in ('stop', 'wait'):
        _stopped_at(frame, who[0])
    if frame.key in ('cross', 'step_onto'):
        for crossed in frame.free(AdjunctKind.OBJECT):
            crossed.used = all(n.kind.value in ('street', 'place') for n in crossed.nouns)
    placed = frame.key in ('cross', 'start', 'walk', 'drive')
    if placed or _fronted_place(frame):
        for placement in placements_of(frame, who, kept=False):
            add_placement(who[0], placement)
    frame.scene.became(who[0].id)
    do = _AGENT_DO[frame.key]
    hard = frame.measure(ACCELERATION) if do in BRAKING else None
    deceleration = None
    if hard is not None and hard.measure is not None:
        hard.used = True
        deceleration = values.explicit('deceleration', hard.measure)
    side = lane_side(frame)
    return AgentAction(
        do=do, agent=who[0].id, value_mps=speed, deceleration_mps2=deceleration, side=side
    )


def _in_brackets(frame: Frame, adjunct: Adjunct) -> bool:
    told = frame.scene.prompt[: adjunct.start].rstrip()
    return told.endswith('(') and frame.verb is not None and adjunct.end <= frame.verb.start


# What nobody on foot does: in `when a boy crosses it brakes` the boy is not `it`.
_WITH_WHEELS = ('brake', 'accelerate', 'change_lane')


def _on_wheels(entity: Entity) -> bool:
    return mobile(entity) and entity.type is not AgentType.PEDESTRIAN


def _stopped_at(frame: Frame, entity: Entity) -> None:
    """`after the bus has stopped at the crosswalk`: where an event makes it stop."""
    for adjunct in frame.free(AdjunctKind.PHRASE, 'at', 'on', 'in', 'before'):
        place = place_of(frame, adjunct)
        if place is not None:
            adjunct.used = True
            stop = Behavior(kind=BehaviorKind.STOP, target=place, span=frame.span)
            entity.behaviors.append(stop)
            return


def _fronted_place(frame: Frame) -> bool:
    """`the car in front of the ego brakes`."""
    return frame.verb is not None and any(
        a.end <= frame.verb.start for a in frame.free(AdjunctKind.PLACE)
    )


def _uav_action(frame: Frame) -> UavAction | None:
    if frame.negated:
        return None
    if frame.key in ('ascend', 'descend', 'land'):
        uavs = flyers(frame)
        if len(uavs) != 1:
            return None
        found = take_flight_values(frame, MissionMode.HOVER, None)
        if frame.key != 'land' and found.altitude is None:
            found.release()
            return None
        frame.scene.became(uavs[0].id)
        return UavAction(
            do=landed_by(frame) if frame.key == 'land' else 'ascend',
            uav=uavs[0].id,
            altitude_m=found.altitude,
            vertical_mps=None if frame.key == 'land' else found.speed,
        )
    scene: Scene = frame.scene
    before = len(scene.missions)
    if frame.key in ('drive', 'be', '') or not missions.mission(frame):
        return None
    new = scene.missions[before:]
    if len(new) != 1:
        return None
    return UavAction(do='change_mission', uav=new[0].uav.id, mission=new[0].id)


def is_action(frame: Frame) -> bool:
    """Return whether a clause can be the effect of an event without a trigger of its own."""
    return frame.key in ('alert', 'send', 'report', 'receive', 'accelerate')
