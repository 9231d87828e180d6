# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The local engine as a ruler uses it: it remembers what grounding said."""

from __future__ import annotations

from aurora_cli.installed import installed
from aurora_cli.local_engine import LocalStages
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.grounding import GroundingOutcome
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.outcomes.repair import RepairPlan
from aurora_core.pipeline.functions import understood
from aurora_core.pipeline.stages import RunRequest
from aurora_core.spec.scenario import ScenarioSpec


class WatchedStages(LocalStages):
    """The local engine; with a specification nothing of a parser is in it.

    Attributes:
        grounding: What grounding said; None before.
    """

    def __init__(self, spec: ScenarioSpec | None = None) -> None:
        """Take what is run.

        Args:
            spec: Stands in place of what the prompt would be read as; None: it is read.
        """
        super().__init__(installed())
        self._spec = spec
        self.grounding: GroundingOutcome | None = None

    def parse(self, request: RunRequest) -> ParseOutcome:
        """Return the specification, or read the prompt."""
        if self._spec is None:
            return super().parse(request)
        return understood(self.known, ParseOutcome(spec=self._spec))

    def ground(
        self, agsg: Agsg, request: RunRequest, plan: RepairPlan | None = None
    ) -> GroundingOutcome:
        """Ground the graph and remember the first outcome."""
        outcome = super().ground(agsg, request, plan)
        if plan is None:
            self.grounding = outcome
        return outcome
