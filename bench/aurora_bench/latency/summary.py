# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""From the times of processes and stages to goals, tables and notes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from statistics import median

from aurora_bench.latency.cold import Spent
from aurora_bench.latency.warm import LOOP, STAGES, WarmProcess, WarmRun
from aurora_bench.results import Goal, Table

IMPORTS, CHECK, RUN = 'import libsumo, numpy', 'aurora check', 'aurora run'
# (what, accepted, aimed at) as multiples of the import.
COLD_GOALS = ((CHECK, 5.0, 3.0), (RUN, 9.0, 6.0))
# A warm run as a multiple of its own tick loop.
WARM_GOAL = 3.0
_START = 'start and imports'
_QUIET_SHARE = 0.15

NOTES = (
    'Cold: a new process for each sample, by turns, so that what else the machine does meets all '
    'of them; each ratio is that of one round, and its median is shown. CPU is user and system '
    'time of the process, which other work on the machine changes little; wall is the clock.',
    'Warm: one process runs the prompt again and again, each time with a run folder, bag, '
    'verdict and report; the first run is left out. The page is made when the verdict '
    'has been told, so it stands apart (cold, `aurora run` is timed to its end with it). '
    'The tick loop is what lies between the first and the last tick that the run reports: without '
    'loading the simulators, closing the bag, hashing it. The ratio is that of each run to its '
    'own loop.',
    'First run of a process, stage by stage: a stage has to load what it is the first to need. '
    '`aurora check` ends after ground.',
)


@dataclass
class Measured:
    """Everything that was measured.

    Attributes:
        cold: Samples of each command, one per round.
        processes: Each warm process, one per round.
        busy: Share of the cores that others used, each time this looked.
    """

    cold: dict[str, list[Spent]] = field(default_factory=lambda: {IMPORTS: [], CHECK: [], RUN: []})
    processes: list[WarmProcess] = field(default_factory=list)
    busy: list[float] = field(default_factory=list)

    @property
    def is_quiet(self) -> bool:
        """Whether nobody else used the machine at any of the looks."""
        return max(self.busy, default=0.0) <= _QUIET_SHARE

    @property
    def first(self) -> list[WarmRun]:
        """The first run of each process."""
        return [process.runs[0] for process in self.processes]

    @property
    def later(self) -> list[WarmRun]:
        """All runs but the first ones."""
        return [run for process in self.processes for run in process.runs[1:]]

    def cold_ratio(self, name: str) -> Spent:
        """Return a command as a multiple of the import, the median of the rounds."""
        pairs = list(zip(self.cold[name], self.cold[IMPORTS], strict=True))
        return Spent(
            wall_s=median(one.wall_s / base.wall_s for one, base in pairs),
            cpu_s=median(one.cpu_s / base.cpu_s for one, base in pairs),
        )

    def warm_ratio(self) -> Spent:
        """Return a warm run as a multiple of its tick loop, the median of the runs."""
        pairs = [(run.total, run.stages[LOOP]) for run in self.later]
        return Spent(
            wall_s=median(total.wall_s / loop.wall_s for total, loop in pairs),
            cpu_s=median(total.cpu_s / loop.cpu_s for total, loop in pairs),
        )


def goals(measured: Measured) -> tuple[Goal, ...]:
    """Return what is accepted and what was found; wall time counts on a quiet machine only."""
    quiet = measured.is_quiet
    found = [
        _goal(
            f'cold {name} / {IMPORTS}',
            f'at most {most:g} (aim {aim:g})',
            most,
            measured.cold_ratio(name),
            quiet=quiet,
        )
        for name, most, aim in COLD_GOALS
    ]
    warm = measured.warm_ratio()
    found.append(
        _goal(
            'warm run to its verdict / its tick loop',
            f'at most {WARM_GOAL:g}',
            WARM_GOAL,
            warm,
            quiet=quiet,
        )
    )
    hashes = {run.motion_sha256 for run in (*measured.first, *measured.later)}
    found.append(
        Goal(
            name='motion hashes of all runs in warm processes',
            target='1',
            figure=str(len(hashes)),
            met=len(hashes) == 1 and '' not in hashes,
        )
    )
    return tuple(found)


def _goal(name: str, target: str, most: float, ratio: Spent, *, quiet: bool) -> Goal:
    wall = f'{ratio.wall_s:.2f} wall{"" if quiet else " on a busy machine"}'
    met = ratio.cpu_s <= most and (not quiet or ratio.wall_s <= most)
    return Goal(name=name, target=target, figure=f'{ratio.cpu_s:.2f} CPU, {wall}', met=met)


def tables(measured: Measured) -> tuple[Table, ...]:
    """Return cold commands, and the stages of first and of later runs."""
    return (
        Table(
            headings=('command', 'CPU [s]', 'wall [s]', 'CPU / import', 'wall / import'),
            rows=tuple(_cold_row(measured, name) for name in measured.cold),
            caption='New processes (medians)',
        ),
        _stage_table(
            'First run of a process',
            [(_START, [process.start for process in measured.processes])],
            measured.first,
        ),
        _stage_table('Later runs of a process', [], measured.later),
    )


def _cold_row(measured: Measured, name: str) -> tuple[str | float, ...]:
    samples, ratio = measured.cold[name], measured.cold_ratio(name)
    cpu_s, wall_s = median(s.cpu_s for s in samples), median(s.wall_s for s in samples)
    return name, cpu_s, wall_s, ratio.cpu_s, ratio.wall_s


def _stage_table(
    caption: str, before: Sequence[tuple[str, list[Spent]]], runs: Sequence[WarmRun]
) -> Table:
    """Return what each stage took, in seconds and in tick loops."""
    loop_s = median(run.stages[LOOP].cpu_s for run in runs)
    names = [
        name for stage in STAGES for name in ((LOOP, stage) if stage == 'execute' else (stage,))
    ]
    parts = [*before, *((name, [run.stages[name] for run in runs]) for name in names)]
    total, page = [run.total for run in runs], [run.page for run in runs]
    rows = []
    for name, samples in [*parts, ('run to its verdict', total), ('page', page)]:
        cpu_s, wall_s = median(s.cpu_s for s in samples), median(s.wall_s for s in samples)
        told = 'execute without the loop' if name == 'execute' else name
        rows.append((told, cpu_s, wall_s, cpu_s / loop_s))
    return Table(
        headings=('stage', 'CPU [s]', 'wall [s]', 'CPU / tick loop'),
        rows=tuple(rows),
        caption=f'{caption} (medians of {len(runs)})',
    )


def notes(measured: Measured) -> tuple[str, ...]:
    """Return the paragraphs under the tables."""
    busy = ', '.join(f'{share:.0%}' for share in measured.busy)
    looks = f'Others used {busy} of the cores when this benchmark paused to look.'
    if measured.is_quiet:
        return (looks, *NOTES)
    return (f'**{looks} Goals are judged by CPU time alone.**', *NOTES)
