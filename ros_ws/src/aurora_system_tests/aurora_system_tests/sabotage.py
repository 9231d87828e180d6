# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The local engine with an executor that something is wrong with."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from aurora_cli.installed import installed
from aurora_cli.local_engine import LocalStages
from aurora_core.execution.plan import Execution
from aurora_core.execution.scenario_executor import ScenarioExecutor
from aurora_core.execution.step_output import Stepper
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.verdict import Verdict
from aurora_core.pipeline.stages import RunRequest
from aurora_core.pipeline.verification import judge_content, load_bag

Sabotage = Callable[[ScenarioExecutor], Stepper]


class SabotagedStages(LocalStages):
    """The local engine with another executor.

    Args:
        sabotage: Makes it of the honest one.
    """

    def __init__(self, sabotage: Sabotage) -> None:
        super().__init__(installed())
        self._sabotage = sabotage

    def execution(self, agsg: Agsg, request: RunRequest) -> Execution:
        """Return what is run, with the sabotaged executor."""
        honest = super().execution(agsg, request)
        assert isinstance(honest.stepper, ScenarioExecutor)
        return replace(honest, stepper=self._sabotage(honest.stepper))

    def verify(self, agsg: Agsg, bag: Path) -> Verdict:
        """Judge without the honest executor beside it, which would find every bug at once."""
        content, recorded = load_bag(bag)
        self.judged = judge_content(self.known, content, recorded, recompute=False)
        return self.judged.verdict
