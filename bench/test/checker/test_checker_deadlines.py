# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`Within 5 s`: a stop has to be over by then, braking to have begun."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest


@pytest.mark.parametrize(
    ('do', 'within_s', 'outcome'),
    [('stop', 5.0, 'holds'), ('stop', 3.0, 'does_not'), ('brake', 1.0, 'holds'),
     ('slow', 5.0, 'holds'), ('slow', 2.0, 'does_not')],
)  # fmt: skip
def test_what_has_an_end_is_over_in_time(
    stage: Any, do: str, within_s: float, outcome: str
) -> None:
    """From 20.3 s it loses 10 m/s in 4 s and more: down to 2 m/s after 3.5 s."""
    speed = ([0.0, 20.3, 22.0, 24.6, 60.0], [10.0, 10.0, 5.0, 0.0, 0.0])
    stage.drive('car1', 'car', lambda t: np.interp(t, *speed))
    action = {'do': do, 'agent': 'car1'} | ({'value_mps': 2.0} if do == 'slow' else {})
    if do == 'brake':
        stage.drive('car1', 'car', lambda t: np.interp(t, [0, 20.3, 22.3, 60], [10, 10, 0, 0]))
    event = {'kind': 'event', 'ref': 'e1', 'trigger': {'on': 'time', 'at_s': 20}}
    assert stage.says({**event, 'action': action, 'within_s': within_s}) == outcome
