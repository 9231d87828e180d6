# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Run the requests, break what they say, ask the checker and the conditions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from aurora_bench.checker import Checked, CheckerError, Outcome, check_bag
from aurora_bench.contradictions.altered_flights import FLIGHTS
from aurora_bench.contradictions.altered_records import RECORDS
from aurora_bench.contradictions.altered_traffic import TRAFFIC
from aurora_bench.contradictions.case import Altered, Case, Planted
from aurora_bench.contradictions.planted import PLANTED
from aurora_bench.contradictions.prompts import REQUESTS
from aurora_bench.mutation.bag import write_bag
from aurora_bench.mutation.recording import Recording, record
from aurora_bench.progress import Progress
from aurora_cli.installed import installed
from aurora_core.errors import AuroraError
from aurora_core.outcomes.verdict import Reason
from aurora_core.pipeline.verification import verify_stage
from aurora_core.trace.definitions import message_definitions
from aurora_system_tests.local_runs import run_prompt
from aurora_system_tests.sabotage import Sabotage, SabotagedStages

ALTERED: tuple[Altered, ...] = (*FLIGHTS, *TRAFFIC, *RECORDS)
SEED = 1

# Without these a condition has no margin, and nothing has failed.
_UNKNOWN = (Reason.SAMPLES_MISSING, Reason.TRACE_SHORT)


@dataclass(frozen=True, kw_only=True)
class Baseline:
    """A request that is run honestly.

    Attributes:
        contradicted: What the checker says does not hold all the same, with its reason.
        undecided: Requirements that it cannot decide.
    """

    request: str
    prompt: str
    status: str
    contradicted: tuple[str, ...]
    undecided: tuple[str, ...]

    @property
    def clean(self) -> bool:
        """Whether nothing is wrong with it."""
        return self.status == 'verified' and not self.contradicted


@dataclass(frozen=True, kw_only=True)
class Found:
    """What was said of one contradiction.

    Attributes:
        outcome: Of the checker, for the requirement that does not hold.
        why: Its reason.
        conditions: The named conditions that fail; one that cannot be judged has not failed.
        status: Of the verdict, without recomputation.
        others: Other conditions that fail, beside the named ones.
    """

    case: Case
    outcome: str
    why: str
    conditions: tuple[str, ...]
    status: str
    others: tuple[str, ...]

    @property
    def by_checker(self) -> bool:
        """Whether the checker contradicts the requirement."""
        return self.outcome == Outcome.DOES_NOT.value

    @property
    def by_condition(self) -> bool:
        """Whether a named condition fails and the run is not verified.

        What the executor claims of an altered run is not borne out either, and such a verdict is
        inconclusive; the condition has failed all the same.
        """
        return bool(self.conditions) and self.status != 'verified'


@dataclass
class Campaign:
    """The runs of a campaign.

    Args:
        folder: For recordings and bags.
        progress: Who is told.
    """

    folder: Path
    progress: Progress
    _honest: dict[str, Recording] = field(default_factory=dict)
    _sabotaged: dict[tuple[str, Sabotage], Path] = field(default_factory=dict)

    def baselines(self) -> Iterator[Baseline]:
        """Run every request honestly, and check it."""
        for name, annotated in REQUESTS.items():
            base = self.honest(name)
            checked = check_bag(base.bag, annotated)
            found = Baseline(
                request=name,
                prompt=annotated['prompt'],
                status=base.status,
                contradicted=_answers(checked, Outcome.DOES_NOT),
                undecided=_answers(checked, Outcome.CANNOT_TELL),
            )
            problems = '; '.join(found.contradicted)
            self.progress.step(f'{name}: {found.status}. {problems}'.rstrip())
            yield found

    def contradictions(self) -> Iterator[Found]:
        """Judge every run of a planted executor and every altered recording."""
        for planted in PLANTED:
            yield self.judge(planted, self.planted_bag(planted))
        for altered in ALTERED:
            yield self.judge(altered, self.altered_bag(altered))

    def honest(self, request: str) -> Recording:
        """Return the honest run of a request.

        Raises:
            AuroraError: It is not verified: nothing could be said of what contradicts it.
        """
        if request not in self._honest:
            base = record(request, REQUESTS[request]['prompt'], SEED, self.folder / 'honest')
            if base.status != 'verified':
                raise AuroraError(
                    f'{request!r} ended {base.status}, the campaign needs a verified run',
                    hint='mend what broke it, or choose another request',
                )
            self._honest[request] = base
        return self._honest[request]

    def planted_bag(self, case: Planted) -> Path:
        """Return the bag of a run of a planted executor."""
        key = (case.request, case.sabotage)
        if key not in self._sabotaged:
            prompt = REQUESTS[case.request]['prompt']
            stages = SabotagedStages(case.sabotage)
            folder = self.folder / f'planted_{len(self._sabotaged)}'
            _, self._sabotaged[key] = run_prompt(case.request, prompt, SEED, folder, stages)
        return self._sabotaged[key]

    def altered_bag(self, case: Altered) -> Path:
        """Return the bag of an altered run, which takes the place of the one before."""
        made = case.mutant(self.honest(case.request))
        return write_bag(made, self.folder / 'altered', message_definitions())

    def judge(self, case: Case, bag: Path) -> Found:
        """Ask the checker for the requirement and the monitor for its conditions alone."""
        outcome, why = _checked(bag, case)
        verdict = verify_stage(installed(), bag, recompute=False)
        failed = [r.id for r in verdict.results if not r.satisfied and r.reason not in _UNKNOWN]
        found = Found(
            case=case,
            outcome=outcome,
            why=why,
            conditions=tuple(name for name in failed if name in case.conditions),
            status=verdict.status.value,
            others=tuple(name for name in failed if name not in case.conditions),
        )
        said = f'checker {outcome} ({why}), {found.status}: {_listed(found.conditions)}'
        missed = '' if found.by_checker and found.by_condition else 'MISSED '
        self.progress.step(f'{missed}{case.request}, {case.name}: {said}')
        return found


def _checked(bag: Path, case: Case) -> tuple[str, str]:
    """Return what the checker says of the requirement that is contradicted."""
    try:
        checked = check_bag(bag, REQUESTS[case.request])
    except CheckerError as error:
        return 'refused', str(error)
    answer = next(a for a in checked.answers if a.requirement == case.requirement)
    return answer.outcome.value, answer.why


def _answers(checked: Checked, outcome: Outcome) -> tuple[str, ...]:
    return tuple(f'{a.requirement}: {a.why}' for a in checked.answers if a.outcome is outcome)


def _listed(names: tuple[str, ...]) -> str:
    return ', '.join(names) or 'none of its conditions'
