# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.contradictions --results docs/bench`.

Also: `make bench-contradictions`.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from aurora_bench.contradictions.campaign import ALTERED, Baseline, Campaign, Found
from aurora_bench.contradictions.case import Planted
from aurora_bench.contradictions.planted import PLANTED
from aurora_bench.contradictions.prompts import REQUESTS
from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.machine import machine_facts
from aurora_bench.progress import Progress
from aurora_bench.results import Goal, Table, told_goals, write_results

PLANTED_LEAST = 12
ALTERED_LEAST = 30
KINDS_LEAST = 15


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the campaign; return 1 when something is missed, or contradicted without a cause."""
    stop_on_sigterm()
    parser = argparse.ArgumentParser(prog='aurora_bench.contradictions', description=__doc__)
    parser.add_argument('--results', type=Path, default=Path('docs/bench'), metavar='FOLDER')
    options = parser.parse_args(arguments)
    machine = machine_facts()
    progress = Progress('contradictions', len(REQUESTS) + len(PLANTED) + len(ALTERED))
    with tempfile.TemporaryDirectory(prefix='aurora_contradictions_') as name:
        campaign = Campaign(Path(name).resolve(), progress)
        baselines = list(campaign.baselines())
        found = list(campaign.contradictions())
    goals = _goals(baselines, found)
    write_results(
        options.results,
        'contradictions',
        _results(baselines, found),
        title='Runs that contradict their request',
        goals=goals,
        tables=_tables(baselines, found),
        notes=(
            'Which requirement a run contradicts is known from what was done to it, from no '
            'verifier. The checker has to say that this requirement does not hold; the monitor, '
            'without recomputing the commands, has to fail one of the conditions that are named '
            'for it, whatever else it finds.',
        ),
        machine=machine,
    )
    code = told_goals(goals)
    sys.stdout.write(_last_line(baselines, found))
    return code


def _last_line(baselines: Sequence[Baseline], found: Sequence[Found]) -> str:
    by_checker, by_condition = _counts(found)
    clean = sum(base.clean for base in baselines)
    return (
        f'contradictions found by the checker {by_checker} of {len(found)}  '
        f'by a condition {by_condition} of {len(found)}  '
        f'baselines clean {clean} of {len(baselines)}\n'
    )


def _counts(found: Sequence[Found]) -> tuple[int, int]:
    return sum(f.by_checker for f in found), sum(f.by_condition for f in found)


def _goals(baselines: Sequence[Baseline], found: Sequence[Found]) -> list[Goal]:
    planted = [f for f in found if isinstance(f.case, Planted)]
    altered = [f for f in found if not isinstance(f.case, Planted)]
    kinds = {f.case.kind for f in altered}
    goals = [
        _counted('executors with a planted bug', len(planted), PLANTED_LEAST),
        _counted('altered recordings', len(altered), ALTERED_LEAST),
        _counted('kinds of alterations', len(kinds), KINDS_LEAST),
    ]
    for what, group in (('planted bugs', planted), ('alterations', altered)):
        by_checker, by_condition = _counts(group)
        goals.append(_all(f'{what} found by the checker', by_checker, len(group)))
        goals.append(_all(f'{what} found by a condition', by_condition, len(group)))
    clean = sum(base.clean for base in baselines)
    goals.append(_all('honest runs verified and not contradicted', clean, len(baselines)))
    return goals


def _counted(name: str, count: int, least: int) -> Goal:
    return Goal(name=name, target=f'at least {least}', figure=str(count), met=count >= least)


def _all(name: str, count: int, of: int) -> Goal:
    return Goal(name=name, target=f'{of} of {of}', figure=f'{count} of {of}', met=count == of)


def _tables(baselines: Sequence[Baseline], found: Sequence[Found]) -> list[Table]:
    headings = ('request', 'what is wrong', 'requirement', 'checker', 'condition', 'it says')
    tables = []
    for planted, caption in ((True, 'Planted bugs'), (False, 'Altered recordings')):
        rows = [
            (
                f.case.request,
                f.case.name if planted else f'{f.case.kind}: {f.case.name}',
                f.case.requirement,
                f.outcome,
                ', '.join(f.conditions) or None,
                f.why,
            )
            for f in found
            if isinstance(f.case, Planted) is planted
        ]
        tables.append(Table(headings=headings, rows=rows, caption=caption))
    tables.append(
        Table(
            headings=('request', 'prompt', 'ended', 'contradicted', 'undecided'),
            rows=[
                (
                    base.request,
                    base.prompt,
                    base.status,
                    '; '.join(base.contradicted) or None,
                    len(base.undecided),
                )
                for base in baselines
            ],
            caption='Honest runs',
        )
    )
    return tables


def _results(baselines: Sequence[Baseline], found: Sequence[Found]) -> dict[str, Any]:
    return {
        'baselines': [
            {
                'request': base.request,
                'prompt': base.prompt,
                'status': base.status,
                'contradicted': list(base.contradicted),
                'undecided': list(base.undecided),
            }
            for base in baselines
        ],
        'contradictions': [
            {
                'kind': f.case.kind,
                'name': f.case.name,
                'request': f.case.request,
                'requirement': f.case.requirement,
                'checker': f.outcome,
                'why': f.why,
                'status': f.status,
                'conditions': list(f.conditions),
                'conditions_that_count': list(f.case.conditions),
                'other_conditions': list(f.others),
            }
            for f in found
        ],
    }


if __name__ == '__main__':
    sys.exit(main())
