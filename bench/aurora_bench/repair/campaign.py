# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Run a request with a fault, repair it, and see what was found, mended and kept."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from aurora_bench.repair.faults import Draws, Fault, with_fault
from aurora_bench.repair.pinned import PinnedStages
from aurora_bench.rulers.runs import run_into
from aurora_bench.rulers.watched import WatchedStages
from aurora_cli.installed import installed
from aurora_core.document import Document
from aurora_core.outcomes.grounding import GroundingOutcome
from aurora_core.outcomes.verdict import VerdictStatus
from aurora_core.pipeline.stages import RunControl, RunRequest
from aurora_core.repair.localize import localize
from aurora_core.repair.lock import changes_of_the_request, locked_edits
from aurora_core.repair.neighbourhood import outside
from aurora_core.repair.settings import RepairSettings
from aurora_core.report.run_folder import RunFolder, StageFile
from aurora_core.report.run_report import RepairReport, RunReport

_FIRST = 3
# So often a fault is drawn until it bites: the request holds without it, and is violated with it.
_DRAWS = 5


class Episode(Document):
    """What came of a fault.

    Attributes:
        prompt: What was asked.
        mends: Repair may mend it; False: what is at fault is locked.
        status: Of the run.
        showed: The request holds with the good value, and is violated with the faulty one.
        useless: Why each draw before this one said nothing of repair.
        repaired: Another realisation holds.
        simulations: Spent on repair.
        localized: The cause is among the first three that the localization names.
        named: What these are.
        changed: What any iteration changed that it may not: nothing, or repair is broken.
        steps: Of the escalation, as they were simulated.
        missed: By condition, by how much each estimate of the replay was too good (normalised).
        seconds: Wall time of the repair, the first realisation not counted.
        times: The same, in first realisations (from the request to its verdict).
        proposing_s: Wall time of each proposal, localization and replay in it.
        first_s: Wall time of the first realisation.
        why: What repair said last, where the run stays violated; or why it was refused.
    """

    key: str
    kind: str
    prompt: str = ''
    mends: bool = True
    status: str
    showed: bool
    useless: tuple[str, ...] = ()
    repaired: bool = False
    simulations: int = 0
    localized: bool = False
    named: tuple[str, ...] = ()
    changed: tuple[str, ...] = ()
    steps: tuple[str, ...] = ()
    missed: Mapping[str, tuple[float, ...]] = {}
    seconds: float = 0.0
    times: float = 0.0
    proposing_s: tuple[float, ...] = ()
    first_s: float = 0.0
    why: str = ''

    @property
    def preserved(self) -> bool:
        """Whether request, conditions and all outside the neighbourhood stayed as they were."""
        return not self.changed


@dataclass(kw_only=True)
class RepairWork:
    """Works off faults; sent to every worker.

    Attributes:
        map_name: Map of the runs.
        budget: Co-simulations that repair may spend; None: as `aurora repair`.
        settings: What of `config/repair.yaml` is another value here, by name.
    """

    map_name: str = 'downtown'
    budget: int | None = None
    settings: Mapping[str, Any] = field(default_factory=dict)

    def prepare(self) -> None:
        """Load what every run needs."""
        import libsumo  # noqa: F401  (takes seconds; a run would wait for it)

        known = installed()
        known.map(self.map_name)
        known.repair = with_settings(known.repair, self.settings)

    def __call__(self, draws: Draws) -> Episode:
        """Run one, drawn until it bites."""
        useless: list[str] = []
        for attempt in range(_DRAWS):
            episode = self._episode(draws.drawn(attempt))
            if episode.showed:
                return episode.model_copy(update={'useless': tuple(useless)})
            useless.append(episode.status)
        return episode.model_copy(update={'useless': tuple(useless)})

    def _episode(self, fault: Fault) -> Episode:
        known = installed()
        try:
            spec, cause = with_fault(known, fault, self.map_name)
        except LookupError as err:
            return _unseen(fault, str(err))
        stages = PinnedStages(spec, fault.place)
        if not stages.finds_a_place(self._request(fault, 0)):
            return _unseen(fault, 'no such street')
        if not self._holds(fault):
            return _unseen(fault, 'does not hold without the fault')
        budget = known.repair.budget if self.budget is None else self.budget
        when = _Times()
        with tempfile.TemporaryDirectory(prefix='aurora_repair_') as name:
            control = RunControl(progress=when.progress)
            report, folder = run_into(Path(name), self._request(fault, budget), stages, control)
            return _told(fault, cause, report, folder, stages, when)

    def _request(self, fault: Fault, budget: int) -> RunRequest:
        return RunRequest(
            prompt=fault.prompt, map_name=self.map_name, seed=fault.seed, repair=budget
        )

    def _holds(self, fault: Fault) -> bool:
        """Tell whether the request holds with a good value: else the fault is not its cause."""
        spec, _ = with_fault(installed(), fault, self.map_name, good=True)
        request = self._request(fault, 0).model_copy(update={'prompt': fault.good_prompt})
        with tempfile.TemporaryDirectory(prefix='aurora_repair_') as name:
            report, _ = run_into(Path(name), request, WatchedStages(spec))
        return report.trace is not None and report.trace.verdict is VerdictStatus.VERIFIED


def with_settings(settings: RepairSettings, changes: Mapping[str, Any]) -> RepairSettings:
    """Return settings of repair with other values, by their names with dots between.

    Raises:
        ValueError: There is no such setting, or it may not have such a value.
    """
    document = settings.model_dump(mode='json')
    for name, value in changes.items():
        *groups, last = name.split('.')
        inner = document
        for group in groups:
            inner = inner[group] if isinstance(inner.get(group), dict) else {}
        if last not in inner:
            raise ValueError(f'config/repair.yaml has no {name}')
        inner[last] = value
    return RepairSettings.model_validate(document)


def _unseen(fault: Fault, status: str) -> Episode:
    return Episode(
        key=fault.key,
        kind=fault.kind,
        prompt=fault.prompt,
        mends=fault.mends,
        status=status,
        showed=False,
    )


class _Times:
    """When the first realisation began and was judged, and when the run was reported."""

    def __init__(self) -> None:
        self.begin = time.perf_counter()
        self.first = 0.0
        self.end = 0.0

    def progress(self, stage: str, _share: float, _sim_s: float) -> None:
        """Take the time of a stage."""
        now = time.perf_counter()
        if stage == 'repair' and not self.first:
            self.first = now
        if stage == 'report':
            self.end = now


def _told(
    fault: Fault,
    cause: str,
    report: RunReport,
    folder: RunFolder,
    stages: PinnedStages,
    when: _Times,
) -> Episode:
    simulated = [repair for repair in report.repairs if repair.bag is not None]
    told = [repair for repair in report.repairs if repair.implicated]
    named = stages.asked[0].proposal.implicated if stages.asked else ()
    # A request without a place is mended before anything is simulated.
    named = told[0].implicated if told and told[0].iteration == 0 else named
    fields = tuple(dict.fromkeys(item.field for item in named))[:_FIRST]
    holds = report.trace is not None and report.trace.verdict is VerdictStatus.VERIFIED
    refused = report.trace is None and report.status.value == 'infeasible'
    showed = bool(report.repairs)
    spent = max(0.0, when.end - when.first) if when.first else 0.0
    return Episode(
        key=fault.key,
        kind=fault.kind,
        prompt=fault.prompt,
        mends=fault.mends,
        status=report.status.value if showed or refused else 'the fault does no harm',
        showed=showed or (refused and not fault.mends),
        repaired=showed and holds,
        simulations=len(simulated),
        localized=cause in fields,
        named=fields,
        changed=tuple(dict.fromkeys(_changed(folder, stages))),
        steps=tuple(repair.kind for repair in simulated),
        missed=_missed(simulated),
        seconds=spent,
        times=spent / (when.first - when.begin) if when.first else 0.0,
        proposing_s=tuple(round(asked.seconds, 4) for asked in stages.asked),
        first_s=round(when.first - when.begin, 4) if when.first else 0.0,
        why=report.summary if refused else _last_said(report, holds=holds),
    )


def _last_said(report: RunReport, *, holds: bool) -> str:
    return '' if holds or not report.repairs else report.repairs[-1].reason


def _changed(folder: RunFolder, stages: PinnedStages) -> Iterator[str]:
    """Yield what any iteration changed that it may not: in its documents, and in its graph.

    The neighbourhood is worked out anew from the verdict that each edit answers to.
    """
    first = stages.grounding
    names = [StageFile.SPEC.name_at(k) for k in range(len(stages.asked) + 1)]
    texts = {folder.file(name).read_bytes() for name in names if folder.file(name).exists()}
    if len(texts) > 1:
        yield 'the documents of the request differ'
    for asked in stages.asked:
        outcome: GroundingOutcome | None = asked.outcome
        if outcome is None or outcome.agsg is None or not stages.simulated(outcome.agsg):
            continue
        yield from locked_edits(asked.graph, asked.proposal.plan)
        admissible = {item.field for item in localize(asked.graph, asked.verdict)}
        yield from outside(asked.graph, outcome.agsg, admissible)
        if first is not None and first.agsg is not None:
            yield from changes_of_the_request(first.agsg, outcome.agsg, first, outcome)


def _missed(simulated: list[RepairReport]) -> dict[str, tuple[float, ...]]:
    found: dict[str, tuple[float, ...]] = {}
    for repair in simulated:
        for row in repair.margins:
            if row.predicted is not None and row.realised is not None:
                found[row.condition] = (
                    *found.get(row.condition, ()),
                    round(row.predicted - row.realised, 4),
                )
    return found
