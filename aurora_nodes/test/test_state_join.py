# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Both states of a tick, in order."""

from __future__ import annotations

import numpy as np
import pytest

from aurora_core.errors import ExecutionError
from aurora_nodes.state_join import StateJoin

RUN = 5
ROWS = np.zeros((1, 7))


def test_a_tick_is_complete_with_its_last_state_in_any_order() -> None:
    join = StateJoin(RUN, ('ground', 'air'))
    assert join.put('ground', RUN, 0, ROWS) is None
    ready = join.put('air', RUN, 0, ROWS + 1.0)
    assert ready is not None
    tick, rows = ready
    assert tick == 0
    assert rows['air'][0, 0] == 1.0
    assert join.put('air', RUN, 1, ROWS) is None
    ready = join.put('ground', RUN, 1, ROWS)
    assert ready is not None
    assert ready[0] == 1


def test_the_missing_state_that_came_last_before_is_told_first() -> None:
    join = StateJoin(RUN, ('ground', 'air'))
    assert join.missing == 'air'
    join.put('air', RUN, 0, ROWS)
    assert join.missing == 'ground'
    join.put('ground', RUN, 0, ROWS)
    assert join.missing == 'ground'
    join.put('ground', RUN, 1, ROWS)
    assert join.missing == 'air'
    join.put('air', RUN, 1, ROWS)
    assert join.missing == 'air'


def test_without_uavs_the_ground_state_is_enough() -> None:
    join = StateJoin(RUN, ('ground',))
    assert [join.put('ground', RUN, tick, ROWS) is not None for tick in range(3)] == [True] * 3
    assert join.put('air', RUN, 3, ROWS) is None


def test_other_runs_and_old_ticks_are_ignored() -> None:
    join = StateJoin(RUN, ('ground',))
    assert join.put('ground', RUN - 1, 0, ROWS) is None
    assert join.put('ground', RUN, 0, ROWS) is not None
    assert join.put('ground', RUN, 0, ROWS) is None


@pytest.mark.parametrize('source', ['ground', 'air'])
def test_a_lost_state_is_an_error(source: str) -> None:
    join = StateJoin(RUN, ('ground', 'air'))
    with pytest.raises(ExecutionError, match=f'{source} state of tick 0, found tick 1'):
        join.put(source, RUN, 1, ROWS)


def test_who_is_waited_for_is_known() -> None:
    join = StateJoin(RUN, ('ground', 'air'))
    seen = [join.lacking]
    for source in ('air', 'ground'):
        join.put(source, RUN, 0, ROWS)
        seen.append(join.lacking)
    assert seen == [('ground', 'air'), ('ground',), ('ground', 'air')]
