# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.mutation --results docs/bench` (also: `make bench-mutation`)."""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Iterable, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.machine import machine_facts
from aurora_bench.mutation.campaign import Campaign, Outcome, recording
from aurora_bench.mutation.prompts import FAILING, SOUND
from aurora_bench.progress import Progress
from aurora_bench.results import Goal, Table, told_goals, write_results
from aurora_bench.resumable.code import code_digest
from aurora_bench.resumable.journal import Journal, JournalError, JournalHead, journal_path
from aurora_core.report.versions import product_versions
from aurora_system_tests.planted_bugs import PLANTED

BREAKING_LEAST = 500
CAUGHT_LEAST = 0.99
HARMLESS_LEAST = 300
FALSE_ALARMS_MOST = 0.01
BAGS_LEAST = 60
USAGE = 64
INTERRUPTED = 130
# All that an outcome depends on.
_OPTIONS = ('seed', 'seeds', 'bag_every', 'noisy')


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the campaign; return 1 when something that must hold does not."""
    stop_on_sigterm()
    parser = argparse.ArgumentParser(prog='aurora_bench.mutation', description=__doc__)
    parser.add_argument('--results', type=Path, default=Path('docs/bench'), metavar='FOLDER')
    parser.add_argument('--seed', type=int, default=1, help='of the alterations')
    parser.add_argument('--seeds', type=int, default=2, help='runs of each prompt')
    parser.add_argument(
        '--bag-every', type=int, default=25, help='one of so many goes through a bag as well'
    )
    parser.add_argument('--noisy', type=int, default=4, help='runs with noise for each recording')
    parser.add_argument(
        '--resume',
        type=Path,
        default=None,
        metavar='PLACE',
        help='go on with the journal in this folder or file; begun where there is none',
    )
    options = parser.parse_args(arguments)
    machine = machine_facts()
    try:
        with _journal(options) as journal:
            outcomes, planted = _judged(options, journal)
            journal.end()
    except JournalError as err:
        sys.stderr.write(f'{err}\n')
        return USAGE
    except KeyboardInterrupt:
        sys.stderr.write('cancelled; --resume goes on with what the journal holds\n')
        return INTERRUPTED
    goals = _goals(outcomes, planted)
    write_results(
        options.results,
        'mutation',
        _results(options, outcomes, planted),
        title='Altered runs and executors with planted bugs',
        goals=goals,
        tables=_tables(outcomes, planted),
        notes=(
            'What an alteration breaks is known from what was done, by code of the campaign; the '
            'verifier has to name it: a condition, a finding, or the reason why there is no '
            'margin. "Stamped": every digest is that of the altered run.',
        ),
        machine=machine,
    )
    return told_goals(goals)


def _journal(options: argparse.Namespace) -> Journal:
    head = JournalHead(
        campaign='mutation',
        files={},
        options={
            **{name: str(getattr(options, name)) for name in _OPTIONS},
            **product_versions(),
            'code': code_digest(),
        },
    )
    path = journal_path(options.resume or options.results, 'mutation')
    return Journal(path, head, resume=options.resume is not None)


def _judged(options: argparse.Namespace, journal: Journal) -> tuple[list[Outcome], list[Outcome]]:
    """Return all outcomes of the runs, and of the executors with a planted bug.

    A run with all its alterations is one entry of the journal, and so is an executor.
    """
    progress = Progress('mutation', (len(SOUND) + len(FAILING)) * options.seeds + len(PLANTED))
    outcomes: list[Outcome] = []
    planted: list[Outcome] = []
    with tempfile.TemporaryDirectory(prefix='aurora_mutation_') as name:
        folder = Path(name).resolve()
        for seed in range(1, options.seeds + 1):
            for prompt in (*SOUND, *FAILING):
                key = f'run:{prompt}:{seed}'
                if key not in journal.finished:
                    found = _of_run(options, folder, prompt, seed, progress)
                    journal.add(key, {'outcomes': [asdict(o) for o in found]})
                    outcomes += found
                else:
                    outcomes += _known(journal, key)
                progress.step(f'{prompt}, seed {seed}')
        for bug in PLANTED:
            key = f'planted:{bug.name}'
            if key not in journal.finished:
                planted.append(Campaign(folder, options.seed, progress).plant(bug))
                journal.add(key, {'outcomes': [asdict(planted[-1])]})
            else:
                planted += _known(journal, key)
            progress.step(f'{bug.name}: {planted[-1].status}, {planted[-1].problem}')
    return outcomes, planted


def _known(journal: Journal, key: str) -> list[Outcome]:
    return [Outcome(**fields) for fields in journal.finished[key]['outcomes']]


def _of_run(
    options: argparse.Namespace, folder: Path, prompt: str, seed: int, progress: Progress
) -> list[Outcome]:
    """Record one prompt and judge what is done to its run; nothing where that says nothing."""
    campaign = Campaign(folder, options.seed, progress)
    base = recording(folder / 'runs', prompt, seed, progress)
    if base is None:
        return []
    if seed == 1 and prompt in SOUND:
        campaign.alter(base, options.bag_every)
    campaign.leave(base, options.noisy if seed == 1 else 2)
    return campaign.outcomes


def _goals(outcomes: Sequence[Outcome], planted: Sequence[Outcome]) -> list[Goal]:
    breaking = [o for o in outcomes if not o.harmless and o.stamped]
    unstamped = [o for o in outcomes if not o.harmless and not o.stamped]
    harmless = [o for o in outcomes if o.harmless]
    bags = [o for o in outcomes if o.bag and not o.harmless]
    caught, alarms = _good(breaking), len(harmless) - _good(harmless)
    return [
        Goal(
            name='altered runs that break something, digests stamped anew',
            target=f'at least {BREAKING_LEAST}',
            figure=str(len(breaking)),
            met=len(breaking) >= BREAKING_LEAST,
        ),
        Goal(
            name='of these found, and named for what they are',
            target=f'at least {CAUGHT_LEAST:.0%}',
            figure=f'{caught} of {len(breaking)} ({caught / max(1, len(breaking)):.2%})',
            met=caught >= CAUGHT_LEAST * len(breaking),
        ),
        Goal(
            name='the same without new digests: never better than inconclusive',
            target=f'{len(unstamped)} of {len(unstamped)}',
            figure=f'{_good(unstamped)} of {len(unstamped)}',
            met=_good(unstamped) == len(unstamped),
        ),
        Goal(
            name='untouched or harmlessly altered runs',
            target=f'at least {HARMLESS_LEAST}',
            figure=str(len(harmless)),
            met=len(harmless) >= HARMLESS_LEAST,
        ),
        Goal(
            name='of these with another status than before',
            target=f'at most {FALSE_ALARMS_MOST:.0%}',
            figure=f'{alarms} of {len(harmless)}',
            met=alarms <= FALSE_ALARMS_MOST * len(harmless),
        ),
        Goal(
            name='altered runs that went through a real bag',
            target=f'at least {BAGS_LEAST}',
            figure=f'{len(bags)}, {_good(bags)} judged as they must be',
            met=len(bags) >= BAGS_LEAST and _good(bags) == len(bags),
        ),
        Goal(
            name='executors with a planted bug, named',
            target=f'{len(planted)} of {len(planted)}',
            figure=f'{_good(planted)} of {len(planted)}',
            met=_good(planted) == len(planted),
        ),
        *_recomputed(breaking, harmless, planted),
    ]


def _recomputed(
    breaking: Sequence[Outcome], harmless: Sequence[Outcome], planted: Sequence[Outcome]
) -> Iterable[Goal]:
    """What the executor says that is stepped over the recorded states; all else is without it."""
    altered = [o for o in breaking if o.recomputed is not None]
    untouched = [o for o in harmless if o.recomputed is not None]
    by_it, wrongly = (
        sum(o.recomputed is True for o in planted),
        sum(o.recomputed is True for o in untouched),
    )
    yield Goal(
        name='planted bugs that recomputing the commands finds by itself',
        target=f'{len(planted)} of {len(planted)}',
        figure=f'{by_it} of {len(planted)}',
        met=by_it == len(planted),
    )
    yield Goal(
        name='alterations that it finds by itself',
        target='reported',
        figure=f'{sum(o.recomputed is True for o in altered)} of {len(altered)}',
        met=None,
    )
    yield Goal(
        name='untouched runs in which it finds anything',
        target=f'0 of {len(untouched)}',
        figure=f'{wrongly} of {len(untouched)}',
        met=wrongly == 0,
    )


def _good(outcomes: Iterable[Outcome]) -> int:
    return sum(outcome.good for outcome in outcomes)


def _tables(outcomes: Sequence[Outcome], planted: Sequence[Outcome]) -> list[Table]:
    tables = []
    for harmless, caption, heading in (
        (False, 'Alterations that break something', 'found and named'),
        (True, 'Runs that nothing was done to that matters', 'status kept'),
    ):
        rows = []
        chosen = [o for o in outcomes if o.harmless is harmless]
        for kind in dict.fromkeys(o.kind for o in chosen):
            stamped = [o for o in chosen if o.kind == kind and o.stamped]
            rest = [o for o in chosen if o.kind == kind and not o.stamped]
            bags = sum(o.bag for o in chosen if o.kind == kind)
            row: list[str | int] = [kind, len(stamped), _good(stamped)]
            rows.append([*row, bags] if harmless else [*row, len(rest), _good(rest), bags])
        headings = ['alteration', 'stamped', heading]
        headings += [] if harmless else ['not stamped', 'not believed']
        tables.append(Table(headings=[*headings, 'in bags'], rows=rows, caption=caption))
    missed = [o for o in outcomes if not o.good]
    if missed:
        tables.append(
            Table(
                headings=('run', 'alteration', 'stamped', 'said'),
                rows=[(o.base, f'{o.kind}: {o.name}', o.stamped, o.problem) for o in missed],
                caption='Not judged as they must be',
            )
        )
    tables.append(
        Table(
            headings=('the executor', 'ended', 'named'),
            rows=[(o.name, o.status, o.problem) for o in planted],
            caption='Planted bugs',
        )
    )
    return tables


def _results(
    options: argparse.Namespace, outcomes: Sequence[Outcome], planted: Sequence[Outcome]
) -> dict[str, Any]:
    kinds: dict[str, dict[str, int]] = {}
    for o in outcomes:
        counts = kinds.setdefault(f'{"harmless: " if o.harmless else ""}{o.kind}', {})
        for key, counted in (
            ('judged', True),
            ('good', o.good),
            ('not_stamped', not o.stamped),
            ('through_bag', o.bag),
            (o.status, True),
        ):
            counts[key] = counts.get(key, 0) + int(counted)
    return {
        'seed': options.seed,
        'seeds': options.seeds,
        'prompts': {**SOUND, **FAILING},
        'kinds': kinds,
        'not_as_they_must_be': [asdict(o) for o in outcomes if not o.good],
        'planted': [asdict(o) for o in planted],
    }


if __name__ == '__main__':
    sys.exit(main())
