# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Let the phases of which no length is stated last as long as the stated conditions need."""

from __future__ import annotations

from aurora_core.spec.parameter import Parameter, Provenance
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import ScenarioSpec, StatedCondition, UavMission

# Sight is lost now and then: this much longer than the time of sight that is asked. A scenario of
# stated length has no such room.
SPARE = 1.25


def lasting(spec: ScenarioSpec) -> ScenarioSpec:
    """Return the specification with default durations lengthened, inside their domains.

    "Keeps it in view for 60 s" cannot come true in a phase of 30 s, nor can a stretch without a
    break that is longer than its phase. Stated durations stay.

    Args:
        spec: The request; it is not changed.
    """
    spare = SPARE if spec.world.duration_s is None else 1.0
    need: dict[str, float] = {}
    for stated in spec.conditions:
        asked_s = _asked_s(stated)
        for mission in _of(spec, stated) if asked_s > 0.0 else ():
            need[mission.id] = max(need.get(mission.id, 0.0), spare * asked_s)
    if not need:
        return spec
    missions = tuple(_at_least(m, need.get(m.id, 0.0)) for m in spec.missions)
    return ScenarioSpec.model_validate({**dict(spec), 'missions': missions})


def _asked_s(stated: StatedCondition) -> float:
    """Return how long a phase has to be for a condition to come true in it, 0 for any."""
    asked_s = 0.0 if stated.hold_s is None else stated.hold_s.value
    if stated.quantity == QuantityName.VISIBLE_TIME and stated.op in ('>=', '>', '=='):
        asked_s = max(asked_s, stated.value.value)
    return asked_s


def _of(spec: ScenarioSpec, stated: StatedCondition) -> tuple[UavMission, ...]:
    own = tuple(m for m in spec.missions if m.uav in stated.of)
    return tuple(m for m in own if m.target in stated.of) or own


def _at_least(mission: UavMission, seconds: float) -> UavMission:
    duration = mission.duration_s
    if duration is None or duration.provenance is not Provenance.DEFAULT:
        return mission
    longer = Parameter.model_validate(
        {**duration.model_dump(), 'value': max(duration.value, min(seconds, duration.high))}
    )
    return UavMission.model_validate({**dict(mission), 'duration_s': longer})
