# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from aurora_core.errors import ConfigError
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.repair import Anchor, Attempt, RepairPlan, ValueEdit
from aurora_core.outcomes.verdict import Verdict
from aurora_core.repair.experience import (
    Lesson,
    RepairEpisode,
    Taught,
    estimates,
    learned,
    lessons,
    move,
    remember_repairs,
)
from aurora_core.repair.helps import ANCHOR
from aurora_core.repair.localize import localize
from aurora_core.spec.parameter import Provenance

ALTITUDE = 'missions/m1/altitude_m'
SEEN = 'visible_fraction'
Failing = Callable[..., Verdict]


def attempt(iteration: int, seen: float, altitude_m: float = 30.0, lane: str = 'a') -> Attempt:
    edit = ValueEdit(
        path=ALTITUDE, requested=30.0, realised=altitude_m, provenance=Provenance.DEFAULT
    )
    document = {
        'iteration': iteration,
        'outcome': 'violated' if seen < 0.0 else 'verified',
        'anchor': Anchor(lane=lane, position_m=1.0),
        'plan': RepairPlan(values=(edit,) if altitude_m != 30.0 else ()),
        'margins': {'m1.visible': seen},
        'failed': ('m1.visible',) if seen < 0.0 else (),
    }
    return Attempt.model_validate(document)


def test_a_run_teaches_which_move_helped_which_quantity(agsg: Agsg) -> None:
    past = (attempt(0, -0.5), attempt(1, -0.7, altitude_m=20.0), attempt(2, 0.1, lane='b'))
    assert lessons(past, agsg.conditions) == (
        Lesson(move=move(SEEN, ALTITUDE, -1), helped=False),
        Lesson(move=move(SEEN, ANCHOR, 0), helped=True),
    )


def test_what_helped_before_is_tried_before_what_did_not(
    agsg: Agsg, failing: Failing, tmp_path: Path
) -> None:
    verdict = failing(m1__visible=-0.4)
    usual = [item.field for item in localize(agsg, verdict)]
    assert usual[0] == ALTITUDE
    for k in range(9):
        rows = (
            Lesson(move=move(SEEN, ALTITUDE, 1), helped=False),
            Lesson(move=move(SEEN, ANCHOR, 0), helped=True),
        )
        remember_repairs(tmp_path, RepairEpisode(id=f'run{k}', lessons=rows))
    found = localize(agsg, verdict, learned(tmp_path).moves)
    assert found[0].field == ANCHOR
    # It orders, and takes nothing in or out.
    assert {item.field for item in found} == set(usual)


def test_the_error_of_the_replay_is_what_past_runs_measured(agsg: Agsg, tmp_path: Path) -> None:
    off = attempt(1, 0.1).model_copy(update={'predicted': {'m1.visible': 0.4}})
    right = attempt(2, 0.3).model_copy(update={'predicted': {'m1.visible': 0.2}})
    missed = estimates((attempt(0, -0.5), off, right), agsg.conditions)
    assert missed == {SEEN: (0.3, 0.0)}
    for k in range(4):
        remember_repairs(tmp_path, RepairEpisode(id=f'run{k}', lessons=(), missed=missed))
    # Too few to go by.
    assert learned(tmp_path).errors == {}
    remember_repairs(tmp_path, RepairEpisode(id='run4', lessons=(), missed=missed))
    assert learned(tmp_path).errors == {SEEN: 0.3}


def test_an_empty_history_changes_nothing_and_a_damaged_one_is_told(tmp_path: Path) -> None:
    assert learned(tmp_path) == Taught()
    remember_repairs(tmp_path, RepairEpisode(id='run1', lessons=()))
    (tmp_path / 'repairs' / 'run2.json').write_text('{', encoding='utf-8')
    with pytest.raises(ConfigError, match='is no episode'):
        learned(tmp_path)
