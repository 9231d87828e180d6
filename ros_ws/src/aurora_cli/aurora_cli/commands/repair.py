# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora repair`: the repair loop on a recorded run."""

from __future__ import annotations

from pathlib import Path

from aurora_cli.answers import Run, run_stages
from aurora_cli.beside.chosen import Elsewhere, chosen
from aurora_cli.files import full_path
from aurora_cli.installed import installed
from aurora_cli.interrupts import Interrupts
from aurora_cli.local_engine import LocalStages
from aurora_cli.output import answer_console, print_json, quiet_stdout, say
from aurora_cli.progress import RunProgress
from aurora_core.errors import VerificationError
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.outcomes.verdict import VerdictStatus
from aurora_core.pipeline.functions import understood
from aurora_core.pipeline.knowledge import Knowledge
from aurora_core.pipeline.recompute import recorded_faults
from aurora_core.pipeline.stages import RunControl, RunRequest
from aurora_core.pipeline.verification import load_bag, verify_content
from aurora_core.report.find_bag import find_bag
from aurora_core.report.status import exit_code
from aurora_core.report.terminal import print_report
from aurora_core.trace.bag_content import BagContent
from aurora_core.trace.hashing import trace_sha256


class RecordedStages(LocalStages):
    """The local engine on a recorded request: nothing is read anew.

    Args:
        known: What the stages work with.
        recorded: Graph of the recording.
    """

    def __init__(self, known: Knowledge, recorded: Agsg) -> None:
        super().__init__(known)
        self._recorded = recorded

    def parse(self, request: RunRequest) -> ParseOutcome:
        """Return the recorded request."""
        spec = self._recorded.spec
        outcome = ParseOutcome(spec=spec, clauses=spec.clauses)
        return understood(self.known, outcome, reader=spec.reader)


def repair_command(
    run_or_bag: str, budget: int | None, out: Path, elsewhere: Elsewhere, *, as_json: bool
) -> int:
    """Repair a recorded run in a run of its own, and return the exit code.

    The first realisation is made again, which shows that the recording can be: same trace hash.

    Args:
        run_or_bag: Run folder, run id or bag of a violated run.
        budget: Co-simulations beside that one; None: as the configuration says.
        out: Folder of the run folders.
        elsewhere: Who executes the candidates.
        as_json: Print the report as one JSON document.

    Raises:
        AuroraError: There is no such recording, it is not violated, or no run can be made of it.
    """
    known = installed()
    with quiet_stdout():
        content, recorded = load_bag(find_bag(run_or_bag, 0 if _is_run(run_or_bag) else None).bag)
        request = _request(known, content, recorded, budget)
        stages = RecordedStages(known, recorded)
        with (
            Interrupts() as interrupts,
            chosen(elsewhere) as beside,
            RunProgress() as progress,
        ):
            control = RunControl(progress=progress.update, cancelled=interrupts.cancelled)
            done = run_stages(request, stages, full_path(out), control, beside)
    _tell(done, trace_sha256(content.trace, content.world))
    if as_json:
        print_json(done.report)
        say(f'aurora: run folder {done.folder}')
    else:
        print_report(done.report, answer_console(), done.folder)
    return int(exit_code(done.status))


def _is_run(run_or_bag: str) -> bool:
    """Tell whether a recording is named by its run: then its first realisation is meant."""
    path = Path(run_or_bag)
    return not path.exists() or (path.is_dir() and not any(path.glob('*.mcap')))


def _request(
    known: Knowledge, content: BagContent, recorded: Agsg, budget: int | None
) -> RunRequest:
    if recorded.grounding is None:
        raise VerificationError('the recorded graph is not grounded')
    verdict = verify_content(known, content, recorded)
    if verdict.status is not VerdictStatus.VIOLATED:
        raise VerificationError(
            f'there is nothing to repair: the recording is {verdict.status.value}',
            hint='repair begins after a violated verdict; aurora verify shows the margins',
        )
    return RunRequest(
        prompt=recorded.spec.prompt,
        map_name=recorded.map_name,
        seed=recorded.grounding.seed,
        faults=recorded_faults(content.trace),
        repair=known.repair.budget if budget is None else budget,
    )


def _tell(done: Run, recorded_sha256: str) -> None:
    bags = done.report.bags or ()
    if bags and bags[0].trace_sha256 != recorded_sha256:
        say('aurora: made again, the first realisation is another one than was recorded: another')
        say('aurora: version, configuration or map made it')
