# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""An executor with a bug is never believed: the verdict names what it did wrong."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from aurora_cli.installed import installed
from aurora_core.execution.plan import Execution
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.verdict import VerdictStatus
from aurora_core.pipeline.stages import RunRequest
from aurora_core.pipeline.verification import verify_stage
from aurora_system_tests.local_runs import names_of, run_prompt
from aurora_system_tests.planted_bugs import (
    BY_RECOMPUTATION,
    PLANTED,
    Planted,
)
from aurora_system_tests.sabotage import SabotagedStages


class _StillAir(SabotagedStages):
    """The UAVs fly in air that does not move, whatever is recorded."""

    def __init__(self) -> None:
        super().__init__(lambda executor: executor)

    def execution(self, agsg: Agsg, request: RunRequest) -> Execution:
        """Return what is run, without its wind."""
        asked = super().execution(agsg, request)
        still = replace(
            asked.air_load,
            wind_mean_east_mps=0.0,
            wind_mean_north_mps=0.0,
            wind_gust_mps=0.0,
        )
        return replace(asked, air_load=still)


@pytest.mark.parametrize(
    ('prompt', 'names'),
    [
        (
            'A drone hovers over City Hall at 50 m for 10 s in a 10 m/s crosswind.',
            {'condition:world.wind_blown.uav1'},
        ),
        (
            'A drone hovers at 40 m for 10 s in a wind of 5 m/s with gusts of 12 m/s.',
            {'condition:world.wind_blown.uav1', 'condition:world.gust_blown.uav1'},
        ),
    ],
    ids=['wind', 'gusts'],
)
def test_a_wind_that_did_not_blow_is_named(prompt: str, names: set[str], tmp_path: Path) -> None:
    stages = _StillAir()
    report, _ = run_prompt('still', prompt, 1, tmp_path, stages)
    assert report.status == 'violated'
    assert stages.judged is not None
    assert names_of(stages.judged.verdict) == names


@pytest.mark.parametrize('planted', PLANTED, ids=lambda planted: planted.name)
def test_a_planted_bug_is_named(planted: Planted, tmp_path: Path) -> None:
    stages = SabotagedStages(planted.sabotage)
    report, bag = run_prompt(planted.name, planted.prompt, 1, tmp_path, stages)
    assert report.status in ('violated', 'inconclusive')
    assert stages.judged is not None
    assert names_of(stages.judged.verdict) & planted.names, 'by the conditions alone'
    again = verify_stage(installed(), bag)
    assert again.status is VerdictStatus.INCONCLUSIVE
    assert names_of(again) & BY_RECOMPUTATION, 'the honest executor does otherwise'
