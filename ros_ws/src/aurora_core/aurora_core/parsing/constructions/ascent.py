# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Take-off, climb and landing around the mission phases."""

from __future__ import annotations

from aurora_core.parsing.atoms import AtomKind
from aurora_core.parsing.constructions.flight_values import take_flight_values
from aurora_core.parsing.constructions.flyers import flyers, landed_by
from aurora_core.parsing.frames import Frame
from aurora_core.spec.scenario import MissionDoneTrigger, UavAction
from aurora_core.spec.vocabulary import MissionMode


def ascent(frame: Frame) -> bool:
    """`ascends to 40 m`: the altitude of the phase that follows."""
    if frame.negated or frame.key not in ('ascend', 'descend'):
        return False
    flying = flyers(frame)
    if not flying:
        return False
    found = take_flight_values(frame, MissionMode.HOVER, None)
    if found.duration is not None or found.standoff is not None or found.ranges:
        found.release()
        return False
    place = found.target
    for uav in flying:
        if place is not None:
            frame.scene.pending_place[uav.id] = place
        if found.altitude is not None:
            frame.scene.pending_altitude[uav.id] = found.altitude
        if found.speed is not None:
            frame.scene.pending_speed[uav.id] = found.speed
    frame.scene.became(*(u.id for u in flying))
    return True


def landing(frame: Frame) -> bool:
    """`then lands`, `then returns home`, `does not land`, `stays in the air`."""
    airborne_end = None
    if frame.key in ('keep', 'be', 'land', ''):
        airborne_end = frame.mark(AtomKind.IN_FLIGHT.value)
    if frame.key != 'land' and airborne_end is None:
        return False
    flying = flyers(frame)
    if not flying:
        return False
    missions = [m for u in flying for m in frame.scene.missions_of(u)[-1:]]
    if frame.negated or airborne_end is not None:
        if not missions:
            return False
        for one in missions:
            one.ends_in_flight = True
    elif landed_by(frame) == 'return_home':
        for one in missions:
            home = UavAction(do='return_home', uav=one.uav.id)
            done = MissionDoneTrigger(on='mission_done', uav=one.uav.id)
            frame.scene.became(frame.scene.add_event(home, frame.span, done).id)
    frame.scene.became(*([m.id for m in missions] or [u.id for u in flying]))
    return True
