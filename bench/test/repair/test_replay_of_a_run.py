# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The kinematic replay of a violated run, held against what comes of its edits."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from aurora_bench.repair.faults import Fault, with_fault
from aurora_bench.repair.kinds import ALTITUDE
from aurora_bench.rulers.runs import run_into
from aurora_bench.rulers.watched import WatchedStages
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.repair import Attempt
from aurora_core.outcomes.verdict import Verdict
from aurora_core.pipeline.stages import RunRequest
from aurora_core.quantities.view import RunView
from aurora_core.repair.foresee import Foresight
from aurora_core.repair.localize import localize
from aurora_core.repair.settings import load_repair_settings
from aurora_core.repair.surrogate.moved import Candidates
from aurora_core.repair.surrogate.replay import Replay
from aurora_core.trace.bag_content import BagContent

FAULT = Fault(
    key='hover',
    kind='hover above the distance it has to keep',
    prompt='A drone hovers near a bus and stays within 50 meters of it.',
    good_prompt='A drone hovers near a bus and stays within 50 meters of it.',
    values={ALTITUDE: 80.0},
    cause=ALTITUDE,
    good=25.0,
    seed=1,
)
SETTINGS = load_repair_settings()


class Recorded(NamedTuple):
    graph: Agsg
    verdict: Verdict
    content: BagContent

    @property
    def view(self) -> RunView:
        return RunView(self.content.trace, self.content.world)


def _ran(folder: Path, *, good: bool = False) -> Recorded:
    stages = WatchedStages()
    spec, _ = with_fault(stages.known, FAULT, 'downtown', good=good)
    stages = WatchedStages(spec)
    request = RunRequest(prompt=FAULT.prompt, seed=FAULT.seed, repair=0)
    _, kept = run_into(folder, request, stages)
    bag = kept.bag_path(0)
    assert stages.grounding is not None
    graph = stages.grounding.agsg
    assert graph is not None
    verdict = stages.verify(graph, bag)
    content = stages.verified
    assert content is not None
    return Recorded(graph, verdict, content)


@pytest.fixture(scope='module')
def violated(tmp_path_factory: pytest.TempPathFactory) -> Recorded:
    return _ran(tmp_path_factory.mktemp('violated'))


def _replay(run: Recorded, past: tuple[Attempt, ...] = ()) -> Replay:
    return Replay(run.view, run.graph, run.verdict, past, SETTINGS.surrogate)


def _candidates(*values: float) -> Candidates:
    return Candidates(values={ALTITUDE: np.array(values)}, here={ALTITUDE: 80.0})


def _foresight(run: Recorded, past: tuple[Attempt, ...] = ()) -> Foresight:
    found = localize(run.graph, run.verdict)
    return Foresight(_replay(run, past), run.graph, found, run.verdict, SETTINGS)


def test_without_an_edit_every_margin_is_the_recorded_one(violated: Recorded) -> None:
    foreseen = _replay(violated).foresee(_candidates(80.0)).at(0)
    recorded = {row.id: row.normalised for row in violated.verdict.results}
    assert 'c1.holds' in foreseen
    for name, margin in foreseen.items():
        assert margin == pytest.approx(recorded[name], abs=1e-6), name


def test_an_edit_gives_about_what_was_foreseen(violated: Recorded, tmp_path: Path) -> None:
    foreseen = _replay(violated).foresee(_candidates(25.0)).at(0)
    came = {row.id: row.normalised for row in _ran(tmp_path, good=True).verdict.results}
    margin = came['c1.holds']
    assert margin is not None
    assert foreseen['c1.holds'] == pytest.approx(margin, abs=SETTINGS.surrogate.unknown)
    assert foreseen['c1.holds'] > 0.0


def test_a_height_that_is_not_to_be_left_moves_with_the_altitude(violated: Recorded) -> None:
    least, most = 'safety.altitude_min.uav1', 'safety.altitude_max.uav1'
    foreseen = _replay(violated).foresee(_candidates(80.0, 4.0, 119.0)).margins
    as_it_was, low, high = (
        dict(zip(foreseen, row, strict=True)) for row in zip(*foreseen.values(), strict=True)
    )
    assert low[least] < 0.1 * as_it_was[least]
    assert high[most] < as_it_was[most] < low[most]


def test_what_is_foreseen_to_hold_is_chosen_and_what_is_not_is_told(violated: Recorded) -> None:
    foresight = _foresight(violated)
    [choice, *_] = foresight.choices()
    assert set(choice.values) == {ALTITUDE}
    assert choice.values[ALTITUDE] <= 50.0
    assert choice.predicted['c1.holds'] >= 0.0
    assert foresight.fails({ALTITUDE: 110.0})
    assert not foresight.fails({ALTITUDE: 30.0})


def test_nothing_is_said_of_what_has_no_model(violated: Recorded) -> None:
    radius = 'missions/m1/radius_m'
    candidates = Candidates(values={radius: np.array([20.0])}, here={radius: 30.0})
    assert _replay(violated).foresee(candidates).margins == {}
    assert not _foresight(violated).fails({radius: 20.0})


def test_the_error_that_a_history_measured_is_the_one_that_is_believed(
    violated: Recorded,
) -> None:
    begun = Attempt.model_validate(
        {'iteration': 0, 'outcome': 'violated', 'errors': {'distance': 0.07}}
    )
    errors = _replay(violated, (begun,)).foresee(_candidates(30.0)).errors
    assert errors['c1.holds'] == 0.07
    assert errors['safety.collision'] == SETTINGS.surrogate.unknown


def test_the_record_tells_whether_a_target_was_too_far_or_hidden(violated: Recorded) -> None:
    # As if sensors reached no farther than 60 m: it was watched from 80 m above.
    world = violated.content.world
    near = world.limits.model_copy(
        update={'sensing_range_m': dict.fromkeys(world.limits.sensing_range_m, 60.0)}
    )
    world = replace(world, limits=near)
    view = RunView(violated.content.trace, world)
    [seen] = [c for c in violated.graph.conditions if c.id == 'm1.visible']
    lost = violated.verdict.model_copy(
        update={
            'results': tuple(
                row.model_copy(update={'normalised': -0.5, 'margin': -0.5, 'satisfied': False})
                for row in violated.verdict.results
                if row.id == seen.id
            )
        }
    )
    usual, shown = localize(violated.graph, lost), localize(violated.graph, lost, view=view)
    assert {item.field for item in shown} == {item.field for item in usual}
    moves = [(item.field, item.direction) for item in shown if item.field == ALTITUDE]
    assert moves[0] == (ALTITUDE, -1)
    assert 'is out of range for' in shown[0].reason
    assert next(item.direction for item in usual if item.field == ALTITUDE) == 1


def test_an_estimate_that_was_too_good_is_trusted_less(violated: Recorded) -> None:
    wrong = Attempt.model_validate(
        {
            'iteration': 1,
            'outcome': 'violated',
            'predicted': {'c1.holds': 4.0},
            'margins': {'c1.holds': -3.0},
        }
    )
    assert _replay(violated, (wrong,)).foresee(_candidates(30.0)).errors['c1.holds'] == 7.0
    # It fails by less than such estimates are off: nothing is known any more.
    assert not _foresight(violated, (wrong,)).fails({ALTITUDE: 70.0})
