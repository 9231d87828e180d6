# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Record, alter, judge, count."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from aurora_bench.bags.forge import mcap_of, rewrite, stamp
from aurora_bench.mutation.bag import write_bag
from aurora_bench.mutation.harmless import UNTOUCHED
from aurora_bench.mutation.judge import (
    Judgement,
    by_recomputation,
    in_memory,
    judge_bag,
    through_bag,
    unstamped_in_memory,
)
from aurora_bench.mutation.kinds import breaking_mutants, harmless_mutants
from aurora_bench.mutation.mutant import Mutant, mutant
from aurora_bench.mutation.prompts import FAILING, SOUND
from aurora_bench.mutation.recording import Recording, record
from aurora_bench.progress import Progress
from aurora_cli.installed import installed
from aurora_core.errors import AuroraError
from aurora_core.pipeline.verification import verify_stage
from aurora_core.trace.definitions import message_definitions
from aurora_system_tests.local_runs import names_of, run_prompt
from aurora_system_tests.planted_bugs import BY_RECOMPUTATION, Planted
from aurora_system_tests.sabotage import SabotagedStages


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """One judgement of one mutant.

    Attributes:
        stamped: Every digest is in order.
        bag: It went through a bag.
        good: It was judged as it has to be.
        problem: What was said instead.
        recomputed: The executor, stepped over the recorded states, finds it too; None where that
            was not asked.
    """

    kind: str
    name: str
    base: str
    harmless: bool
    stamped: bool
    bag: bool
    good: bool
    status: str
    problem: str = ''
    recomputed: bool | None = None


@dataclass
class Campaign:
    """All outcomes of a campaign.

    Args:
        folder: For recordings and bags.
        seed: Of the alterations.
        progress: Who is told.
    """

    folder: Path
    seed: int
    progress: Progress
    outcomes: list[Outcome] = field(default_factory=list)

    def alter(self, base: Recording, bag_every: int) -> None:
        """Judge everything that breaks something in one run."""
        definitions = message_definitions()
        for number, one in enumerate(breaking_mutants(base, self.seed)):
            again = by_recomputation(one)
            self._add(one, in_memory(one), stamped=True, bag=False, recomputed=again)
            self._add(one, unstamped_in_memory(one, definitions), stamped=False, bag=False)
            # The places differ from run to run, so that every kind gets its turn.
            if (number + len(base.name)) % bag_every == 0:
                for stamped in (True, False):
                    found = through_bag(one, self.folder, definitions, stamped=stamped)
                    self._add(one, found, stamped=stamped, bag=True)

    def leave(self, base: Recording, noisy: int) -> None:
        """Judge everything that breaks nothing in one run."""
        for one in harmless_mutants(base, self.seed, noisy):
            again = by_recomputation(one) if one.kind == UNTOUCHED else None
            self._add(one, in_memory(one), stamped=True, bag=False, recomputed=again)
        for one, bag in self._other_bags(base):
            self._add(one, judge_bag(bag), stamped=True, bag=True)

    def plant(self, planted: Planted) -> Outcome:
        """Run an executor with a planted bug."""
        stages = SabotagedStages(planted.sabotage)
        report, bag = run_prompt(planted.name, planted.prompt, 1, self.folder, stages)
        names = names_of(stages.judged.verdict) if stages.judged is not None else frozenset()
        good = report.status in ('violated', 'inconclusive') and bool(names & planted.names)
        return Outcome(
            kind='planted bug',
            name=planted.name,
            base=planted.prompt,
            harmless=False,
            stamped=True,
            bag=True,
            good=good,
            status=report.status,
            problem=_named(names & planted.names if good else names),
            recomputed=bool(names_of(verify_stage(installed(), bag)) & BY_RECOMPUTATION),
        )

    def _other_bags(self, base: Recording) -> Iterator[tuple[Mutant, Path]]:
        """The same messages in other bags."""
        definitions = message_definitions()
        same = mutant('written anew', 'other chunks', base, ())
        yield same, write_bag(same, self.folder, definitions)
        more = mutant('other topics in the bag', 'texts', base, ())
        yield more, write_bag(more, self.folder, definitions, other_topics=True)
        # One chunk between two checkpoints, as another writer of the format makes them.
        bag = self.folder / base.bag.name
        shutil.rmtree(bag)
        shutil.copytree(base.bag, bag)
        rewrite(mcap_of(base.bag), mcap_of(bag))
        stamp(bag)
        yield mutant('chunked anew', 'by another writer', base, ()), bag

    def _add(
        self,
        one: Mutant,
        found: Judgement,
        *,
        stamped: bool,
        bag: bool,
        recomputed: bool | None = None,
    ) -> None:
        if one.harmless:
            good = found.status == one.base.status
        elif stamped:
            good = not found.passed and bool(found.names & one.names)
        else:
            good = found.status in ('inconclusive', 'refused')
        problem = ''
        if not good:
            problem = f'{found.status}, {_named(found.names)} {found.text}'.strip()
            self.progress.note(
                f'NOT AS IT MUST BE: {one.base.name}, {one.kind}, {one.name}: {problem}'
            )
        self.outcomes.append(
            Outcome(
                kind=one.kind,
                name=one.name,
                base=one.base.name,
                harmless=one.harmless,
                stamped=stamped,
                bag=bag,
                good=good,
                status=found.status,
                problem=problem,
                recomputed=recomputed,
            )
        )


def _named(names: frozenset[str]) -> str:
    return ', '.join(sorted(names)[:6]) or 'nothing named'


def recording(folder: Path, name: str, seed: int, progress: Progress) -> Recording | None:
    """Record a prompt; None where its run says nothing with this seed.

    Raises:
        AuroraError: With the first seed it ended otherwise than the campaign needs.
    """
    made = record(name, {**SOUND, **FAILING}[name], seed, folder)
    wanted = 'verified' if name in SOUND else 'violated'
    if seed == 1 and made.status != wanted:
        raise AuroraError(f'{name} ended {made.status}, the campaign needs {wanted}')
    if made.status not in ('verified', 'violated'):
        progress.note(f'{name}, seed {seed}: {made.status}, left out')
        return None
    return made
