# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the specification can say and no run can do or judge yet: named, never passed over."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.judging.build import Inputs, Underivable


def unsaid(inputs: Inputs) -> Iterator[Underivable]:
    """Yield every element that is neither executed nor judged."""
    spec = inputs.spec
    if spec.world.seed is not None:
        what = f'the seed {spec.world.seed} of the request: give it to the run'
        yield Underivable(element='world', what=what, span=spec.world.span)
    for mission in spec.missions:
        if mission.dwell_s is not None:
            what = 'a dwell time at waypoints'
            yield Underivable(element=mission.id, what=what, span=mission.dwell_s.span)
