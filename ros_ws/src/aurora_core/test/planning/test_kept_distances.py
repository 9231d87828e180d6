# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A distance that is told with motion holds on the way, unless the request changes it itself."""

from __future__ import annotations

import pytest

from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import load_limits
from aurora_core.parsing.parser import ParseContext, parse_offline
from aurora_core.planning.complete import complete
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.scenario import Placement, ScenarioSpec

CONTEXT = ParseContext(landmark_names=('City Hall',))
LIMITS = load_limits(config_path('limits.json'))


def _read(prompt: str) -> ScenarioSpec:
    read = parse_offline(prompt, CONTEXT).spec
    assert read is not None
    return complete(read, LIMITS)


def _stated(spec: ScenarioSpec) -> Placement:
    (found,) = (
        p
        for agent in spec.agents
        for p in agent.placements
        if p.distance_m is not None and p.distance_m.provenance is Provenance.EXPLICIT
    )
    return found


@pytest.mark.parametrize(
    ('prompt', 'kept'),
    [
        ('A car drives 30 m behind a bus.', True),
        ('A car follows the bus at a distance of 12 m.', True),
        ('A truck drives 25 m ahead of the ego car.', True),
        ('A bus drives at 8 m/s. A van drives 18 m behind the bus.', True),
        # Where it is at t = 0, or starts.
        ('A car is 30 m behind a bus.', False),
        ('A car starts 30 m behind a bus.', False),
        # What becomes of it says that it does not stay so.
        ('A car drives 30 m behind a bus. The bus brakes after 20 s.', False),
        ('A car drives 30 m behind a bus and overtakes it.', False),
        ('A car drives 30 m behind a bus. The car tailgates the bus.', False),
        ('A car drives 30 m behind a bus. The bus stops at City Hall.', False),
        ('A car drives 30 m behind a bus. The bus turns left.', False),
        ('A bus drives at 8 m/s. A car drives at 12 m/s 40 m behind the bus.', False),
        (
            'A car drives 30 m behind a bus. When the car comes within 15 m of the bus, a drone '
            'alerts the bus.',
            False,
        ),
        ('A car drives 30 m behind a bus. A motorcycle overtakes the car.', False),
        # What somebody else does changes nothing of it.
        ('A car drives 30 m behind a bus. A truck brakes after 20 s.', True),
        ('A car drives 30 m behind a bus. A drone alerts the car within 50 m of it.', True),
        # A bound holds whatever becomes of it.
        ('A car drives at most 30 m behind a bus. The bus brakes after 20 s.', True),
    ],
)
def test_what_is_told_with_motion_holds_on_the_way(prompt: str, kept: bool) -> None:
    done = _read(prompt)
    assert _stated(done).keeps_distance == kept
    assert complete(done, LIMITS) == done
