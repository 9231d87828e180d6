# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Run a request with a fault, repair it, and see what was found, mended and kept."""

from __future__ import annotations

import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from aurora_bench.repair.faults import Fault, with_fault
from aurora_bench.rulers.runs import run_into
from aurora_bench.rulers.watched import WatchedStages
from aurora_cli.installed import installed
from aurora_core.document import Document
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.grounding import GroundingOutcome
from aurora_core.outcomes.repair import Anchor, RepairPlan
from aurora_core.outcomes.verdict import VerdictStatus
from aurora_core.pipeline.repairing import anchor_of
from aurora_core.pipeline.stages import RunControl, RunRequest
from aurora_core.report.run_folder import RunFolder, StageFile
from aurora_core.report.run_report import RunReport
from aurora_core.spec.scenario import ScenarioSpec

_FIRST = 3


class Episode(Document):
    """What came of a fault.

    Attributes:
        mends: Repair may mend it; False: what is at fault is locked.
        status: Of the run.
        showed: The request holds with the good value, and is violated with the faulty one.
        repaired: Another realisation holds.
        simulations: Spent on repair.
        localized: The cause is among the first three that the localization names.
        preserved: Request and stated conditions are the same to the byte in every realisation.
        steps: Of the escalation, as they were simulated.
        seconds: Wall time of the repair, the first realisation not counted.
        times: The same, in executions of the first realisation.
    """

    key: str
    kind: str
    mends: bool = True
    status: str
    showed: bool
    repaired: bool = False
    simulations: int = 0
    localized: bool = False
    preserved: bool = True
    steps: tuple[str, ...] = ()
    seconds: float = 0.0
    times: float = 0.0


@dataclass(kw_only=True)
class RepairWork:
    """Works off faults; sent to every worker.

    Attributes:
        map_name: Map of the runs.
        budget: Co-simulations that repair may spend; None: as `aurora repair`.
        replay: Repair asks the surrogate.
    """

    map_name: str = 'downtown'
    budget: int | None = None
    replay: bool = True

    def prepare(self) -> None:
        """Load what every run needs."""
        import libsumo  # noqa: F401  (takes seconds; a run would wait for it)

        known = installed()
        known.map(self.map_name)
        if not self.replay:
            none = known.repair.surrogate.model_copy(update={'candidates': 0})
            known.repair = known.repair.model_copy(update={'surrogate': none})

    def __call__(self, fault: Fault) -> Episode:
        """Run one."""
        known = installed()
        if not self._holds(fault):
            return _unseen(fault, 'no base')
        spec, cause = with_fault(known, fault, self.map_name)
        budget = known.repair.budget if self.budget is None else self.budget
        request = RunRequest(
            prompt=fault.prompt, map_name=self.map_name, seed=fault.seed, repair=budget
        )
        episode = _unseen(fault, 'no fault')
        for place in fault.places or (None,):
            verdicts = _Verdicts()
            control = RunControl(progress=verdicts.progress)
            with tempfile.TemporaryDirectory(prefix='aurora_repair_') as name:
                stages = _Pinned(spec, place)
                report, folder = run_into(Path(name), request, stages, control)
                episode = _episode(fault, cause, report, folder, verdicts)
            if episode.showed:
                break
        return episode

    def _holds(self, fault: Fault) -> bool:
        """Tell whether the request holds with a good value: else the fault is not its cause."""
        spec, _ = with_fault(installed(), fault, self.map_name, good=True)
        request = RunRequest(
            prompt=fault.prompt, map_name=self.map_name, seed=fault.seed, repair=0
        )
        with tempfile.TemporaryDirectory(prefix='aurora_repair_') as name:
            report, _ = run_into(Path(name), request, WatchedStages(spec))
        return report.trace is not None and report.trace.verdict is VerdictStatus.VERIFIED


def _unseen(fault: Fault, status: str) -> Episode:
    return Episode(key=fault.key, kind=fault.kind, mends=fault.mends, status=status, showed=False)


class _Pinned(WatchedStages):
    """Puts the first realisation on a street that was drawn.

    Args:
        spec: What is run.
        place: Which one of all streets, in [0, 1); None: where grounding puts it.
    """

    def __init__(self, spec: ScenarioSpec, place: float | None) -> None:
        super().__init__(spec)
        self._place = place

    def ground(
        self, agsg: Agsg, request: RunRequest, plan: RepairPlan | None = None
    ) -> GroundingOutcome:
        """Ground it; the street as if it were the best one."""
        if plan is not None or self._place is None:
            return super().ground(agsg, request, plan)
        lanes = self.known.map(request.map_name).network.lanes
        streets = sorted({lane.edge_id for lane in lanes.values() if lane.id[0] != ':'})
        here = streets[int(self._place * len(streets))]
        away = tuple(
            Anchor(lane=name, position_m=0.0)
            for name, lane in sorted(lanes.items())
            if lane.edge_id != here
        )
        outcome = super().ground(agsg, request, RepairPlan(avoided=away))
        grounded = None if outcome.agsg is None else outcome.agsg.grounding
        if grounded is None:
            return outcome
        kept = anchor_of(grounded)
        self.grounding = super().ground(agsg, request, RepairPlan(kept=kept))
        return self.grounding


class _Verdicts:
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


def _episode(
    fault: Fault, cause: str, report: RunReport, folder: RunFolder, when: _Verdicts
) -> Episode:
    simulated = [repair for repair in report.repairs if repair.bag is not None]
    named = report.repairs[0].implicated if report.repairs else ()
    fields = tuple(dict.fromkeys(item.field for item in named))[:_FIRST]
    holds = report.trace is not None and report.trace.verdict is VerdictStatus.VERIFIED
    spent = max(0.0, when.end - when.first) if when.first else 0.0
    return Episode(
        key=fault.key,
        kind=fault.kind,
        mends=fault.mends,
        status=report.status.value,
        showed=bool(report.repairs),
        repaired=bool(report.repairs) and holds,
        simulations=len(simulated),
        localized=cause in fields,
        preserved=_preserved(folder, len(simulated) + 1),
        steps=tuple(repair.kind for repair in simulated),
        seconds=spent,
        times=spent / (when.first - when.begin) if when.first else 0.0,
    )


def _preserved(folder: RunFolder, number: int) -> bool:
    names = [StageFile.SPEC.name_at(k) for k in range(number)]
    texts = {folder.file(name).read_bytes() for name in names if folder.file(name).exists()}
    return len(texts) <= 1
