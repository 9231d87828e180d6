# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Candidates of one episode beside one another, with the result of one after the other.

While a candidate is executed, those that would follow if it were of no avail are executed beside
it. The loop of repair proposes, judges and counts as it does without: a recording that was made
ahead is only taken where the loop comes to the very graph that it was made from, so the number of
processes changes no result.
"""

from __future__ import annotations

import logging
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from aurora_core.errors import AuroraError, ReportError
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.grounding import GroundingOutcome
from aurora_core.outcomes.repair import Attempt, Proposal, ProposalOutcome, RepairPlan
from aurora_core.pipeline.beside import Beside, Candidate, Pending
from aurora_core.pipeline.knowledge import Knowledge
from aurora_core.pipeline.repairing import Realisation, best_of, realised, why_not
from aurora_core.pipeline.stages import ExecutionResult, RunControl, RunRequest, Stages

_LOG = logging.getLogger(__name__)
# Between two looks whether a candidate is done or the run cancelled.
_LOOK_S = 0.05


class Ahead:
    """What is executed beside one run.

    Args:
        beside: Who executes.
        stages: Of the run.
        request: Of the run.
        run_id: Of the run.
        known: What the run is made with.

    Attributes:
        begun: Candidates that were given away.
        used: Those of them that the run came to.
    """

    def __init__(
        self, beside: Beside, stages: Stages, request: RunRequest, run_id: str, known: Knowledge
    ) -> None:
        self._beside = beside
        self._stages = stages
        self._request = request
        self._run_id = run_id
        self._known = known
        self._pending: dict[tuple[int, str], Pending] = {}
        self._grounded: dict[tuple[int, RepairPlan], GroundingOutcome] = {}
        self.begun = 0
        self.used = 0

    def ground(self, graph: Agsg, plan: RepairPlan) -> GroundingOutcome:
        """Return what comes of a plan, which may have been grounded ahead.

        Args:
            graph: Of the request, with the iteration that it would be.
            plan: How it is to be realised.
        """
        key = graph.iteration, plan
        if key not in self._grounded:
            self._grounded[key] = self._stages.ground(graph, self._request, plan)
        return self._grounded[key]

    def execute(
        self, graph: Agsg, bag: Path, control: RunControl, following: Iterator[Agsg]
    ) -> ExecutionResult | None:
        """Return the execution of a candidate; None when it has to be executed here.

        Args:
            graph: Grounded.
            bag: Where its recording goes.
            control: A run that is cancelled waits for nobody.
            following: What would be executed next; asked for while this one is executed.

        Raises:
            ReportError: The recording cannot be written.
        """
        try:
            mine = self._pending.pop(_key(graph), None)
            if mine is None:
                self.drop()  # made for what did not come
                mine = self._begin(graph)
            if mine is None:
                return None
            while (found := mine.wait(0.0)) is None and self._look_ahead(following):
                pass
            while found is None:
                if control.cancelled():
                    mine.drop()
                    return None
                found = mine.wait(_LOOK_S)
        except AuroraError as err:
            _LOG.warning('a candidate is executed in the process of the run: %s', err)
            return None
        _write(found.files, bag)
        self.used += 1
        return found.result.model_copy(update={'bag': bag})

    def following(
        self,
        graph: Agsg,
        bag: Path,
        made: Sequence[Realisation],
        past: Sequence[Attempt],
        given: tuple[Proposal, GroundingOutcome],
        most: int,
    ) -> Iterator[Agsg]:
        """Yield what is executed next if a candidate, and those after it, are of no avail.

        Args:
            graph: Of the request.
            bag: Recording of the best realisation so far.
            made: Realisations so far.
            past: Everything that was tried.
            given: The candidate: what was proposed, and what came of it.
            most: Groundings that may be asked for.
        """
        best = best_of(made, self._request.engine)
        proposal, grounding = given
        tried, iteration = list(past), len(made)
        # Of no avail: what does not hold is as it was.
        tried.append(realised(iteration, grounding, best.verdict, proposal))
        try:
            for _ in range(most):
                proposal = self._stages.propose(best.graph, best.verdict, bag, tuple(tried))
                if proposal.outcome is not ProposalOutcome.EDITED:
                    return
                again = graph.model_copy(update={'iteration': iteration + 1})
                grounding = self.ground(again, proposal.plan)
                first = made[0].grounding
                network = self._known.map(self._request.map_name).network
                unfit = why_not(iteration + 1, proposal, grounding, first, best, tried, network)
                if unfit is not None:
                    tried.append(unfit[0])
                    continue
                assert grounding.agsg is not None  # `why_not` tells
                yield grounding.agsg
                iteration += 1
                tried.append(realised(iteration, grounding, best.verdict, proposal))
        except AuroraError as err:
            _LOG.debug('nothing is executed ahead: %s', err)

    def drop(self) -> None:
        """Take back what nobody came to."""
        for pending in self._pending.values():
            pending.drop()
        self._pending.clear()

    def _look_ahead(self, following: Iterator[Agsg]) -> bool:
        """Give the next one away that would follow; False when there is none, or no room."""
        if len(self._pending) >= self._beside.places - 1:
            return False
        graph = next(following, None)
        if graph is None:
            return False
        if _key(graph) not in self._pending:
            pending = self._begin(graph)
            if pending is None:
                return False
            self._pending[_key(graph)] = pending
        return True

    def _begin(self, graph: Agsg) -> Pending | None:
        pending = self._beside.begin(
            Candidate(
                graph=graph, request=self._request, run_id=self._run_id, basis=self._known.basis
            )
        )
        self.begun += pending is not None
        return pending


def _key(graph: Agsg) -> tuple[int, str]:
    return graph.iteration, graph.sha256


def _write(files: Mapping[str, bytes], bag: Path) -> None:
    """Write a bag that came from another process, by the names that files of a bag have."""
    try:
        bag.mkdir(parents=True)
        for name, data in files.items():
            (bag / Path(name).name).write_bytes(data)
    except OSError as err:
        raise ReportError(
            f'{bag} cannot be written: {err.strerror or err}', hint='free some room'
        ) from err
