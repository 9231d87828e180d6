# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The local engine as a ruler uses it: it remembers what grounding said."""

from __future__ import annotations

from aurora_cli.installed import installed
from aurora_cli.local_engine import LocalStages
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.feasibility import CheckStage
from aurora_core.outcomes.grounding import GroundingOutcome
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.outcomes.repair import RepairPlan
from aurora_core.pipeline.functions import understood
from aurora_core.pipeline.stages import RunRequest
from aurora_core.spec.scenario import ScenarioSpec


class WatchedStages(LocalStages):
    """The local engine; with a specification nothing of a parser is in it.

    Attributes:
        outcome: What the prompt was read as; None before.
        grounding: What grounding said; None before.
    """

    def __init__(
        self, spec: ScenarioSpec | None = None, without: frozenset[CheckStage] = frozenset()
    ) -> None:
        """Take what is run.

        Args:
            spec: Stands in place of what the prompt would be read as; None: it is read.
            without: Levels of the check that are left out.
        """
        super().__init__(installed(), without)
        self._spec = spec
        self.outcome: ParseOutcome | None = None
        self.grounding: GroundingOutcome | None = None

    def parse(self, request: RunRequest) -> ParseOutcome:
        """Return the specification, or read the prompt."""
        if self._spec is None:
            self.outcome = super().parse(request)
        else:
            self.outcome = understood(self.known, ParseOutcome(spec=self._spec))
        return self.outcome

    def ground(
        self, agsg: Agsg, request: RunRequest, plan: RepairPlan | None = None
    ) -> GroundingOutcome:
        """Ground the graph and remember the first outcome."""
        outcome = super().ground(agsg, request, plan)
        if plan is None:
            self.grounding = outcome
        return outcome
