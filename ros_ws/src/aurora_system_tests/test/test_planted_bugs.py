# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""An executor with a bug is never believed: the verdict names what it did wrong."""

from __future__ import annotations

from pathlib import Path

import pytest

from aurora_cli.installed import installed
from aurora_core.outcomes.verdict import VerdictStatus
from aurora_core.pipeline.verification import verify_stage
from aurora_system_tests.local_runs import names_of, run_prompt
from aurora_system_tests.planted_bugs import (
    BY_RECOMPUTATION,
    PLANTED,
    Planted,
)
from aurora_system_tests.sabotage import SabotagedStages


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
