# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The tables of a campaign, and their forms: Markdown, LaTeX, CSV."""

from __future__ import annotations

import csv
import io
from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import pairwise
from statistics import fmean, median

from aurora_bench.campaign.at_scale import cost_line_table, scale_table
from aurora_bench.campaign.executed import (
    coordination_table,
    episode_table,
    mission_table,
    program_table,
)
from aurora_bench.campaign.metrics import (
    METRICS,
    OF_SPECIFICATIONS,
    anchors_by_outcome,
    by_category,
    fidelity,
    field_fidelity,
    groups,
    paired,
    per_prompt,
    repair_outcomes,
    share,
)
from aurora_bench.campaign.paper import MODELS, TABLE
from aurora_bench.campaign.plan import Configuration
from aurora_bench.campaign.record import CampaignRun
from aurora_bench.results import Cell, Table, cell_text
from aurora_core.report.share import Share

Runs = Sequence[CampaignRun]
_STAGES = (
    'parse',
    'check',
    'ground',
    'execute',
    'verify',
    'repair',
    'checker',
    'all',
    'processor',
)


def all_tables(runs: Runs) -> Mapping[str, Table]:
    """Return every table by the name of its file."""
    tables = {
        'performance': performance_table(runs),
        'beside': beside_table(runs),
        'paper': paper_table(),
        'paired': paired_table(runs),
        'checked': checked_table(runs),
        'programs': program_table(runs),
        'categories': category_table(runs),
        'declined': declined_table(runs),
        'repair': repair_table(runs),
        'placement': placement_table(runs),
        'anchors': anchor_table(runs),
        'margins': margin_table(runs),
        'coordination': coordination_table(runs),
        'missions': mission_table(runs),
        'cost': cost_table(runs),
        'episodes': episode_table(runs),
        'cost_model': cost_line_table(runs),
        'scale': scale_table(runs),
    }
    if len({r.seed for r in runs}) > 1:
        tables['seeds'] = seed_table(runs)
    return {name: table for name, table in tables.items() if table.rows}


def performance_table(runs: Runs) -> Table:
    """Return C, RF, P, SF and Fid by reader and configuration."""
    rows: list[Sequence[Cell]] = []
    for (reader, configuration), part in groups(runs).items():
        fid, program = fidelity(part), configuration.writes_program
        rows.append(
            (
                reader, configuration.value, len(part),
                *(
                    None if program and m.name in OF_SPECIFICATIONS else told(share(part, m.of))
                    for m in METRICS
                ),
                None if program
                else f'{fid.value:.3f} [{fid.interval[0]:.3f}, {fid.interval[1]:.3f}]',
                None if program else f'{field_fidelity(part).value:.3f}',
            )
        )  # fmt: skip
    words = '; '.join(f'{m.name}: {m.about}' for m in METRICS)
    return Table(
        headings=(
            'reader', 'configuration', 'runs', *(m.name for m in METRICS), 'Fid', 'field fidelity',
        ),
        rows=rows,
        caption=f'End-to-end performance, shares with 95 % Wilson intervals ({words}; Fid: '
        'annotated requirements that the specification holds)',
    )  # fmt: skip


def beside_table(runs: Runs) -> Table:
    """Return ours beside the least and the greatest of the paper's models."""
    of = {m.name: m.of for m in METRICS}
    rows: list[Sequence[Cell]] = []
    for (reader, configuration), part in groups(runs).items():
        ours = {name: share(part, of[name]).value for name in ('C', 'RF', 'P', 'SF')}
        ours['Fid'] = fidelity(part).value
        lacks = {*OF_SPECIFICATIONS, 'Fid'} if configuration.writes_program else set()
        theirs = zip(*TABLE[configuration.value], strict=True)
        cells = (
            cell
            for name, column in zip(ours, theirs, strict=True)
            for cell in (None if name in lacks else f'{ours[name]:.3f}', _span(column))
        )
        rows.append((reader, configuration.value, *cells))
    names = ('C', 'RF', 'P', 'SF', 'Fid')
    return Table(
        headings=('reader', 'configuration', *(h for n in names for h in (n, f'paper {n}'))),
        rows=rows,
        caption="Ours, and the least and the greatest of the paper's five models (the simulators "
        'differ)',
    )


def _span(values: Sequence[float | None]) -> str:
    known = [v for v in values if v is not None]
    if not known:
        return '–'
    least, most = min(known), max(known)
    return f'{least:.3f}' if least == most else f'{least:.3f}..{most:.3f}'


def paper_table() -> Table:
    """Return the paper's numbers."""
    rows: list[Sequence[Cell]] = []
    for configuration, values in TABLE.items():
        for model, row in zip(MODELS, values, strict=True):
            rows.append((configuration, model, *row))
    return Table(
        headings=('configuration', 'model', 'C', 'RF', 'P', 'SF', 'Fid'),
        rows=rows,
        caption="The paper's own numbers (other simulators, readers and prompts)",
    )


def paired_table(runs: Runs) -> Table:
    """Return paired tests between configurations that follow each other, and between the ends."""
    found = groups(runs)
    rows: list[Sequence[Cell]] = []
    for reader in dict.fromkeys(r.reader for r in runs):
        own = [c for c in Configuration if (reader, c) in found]
        pairs = list(pairwise(own))
        pairs += [(own[0], own[-1])] if len(own) > 2 else []
        for one, other in pairs:
            for metric in METRICS:
                wanted = ('C', 'right') if one.writes_program else ('C', 'P', 'right')
                if metric.name not in wanted:
                    continue
                test = paired(found[reader, one], found[reader, other], metric.of)
                rows.append(
                    (
                        reader, f'{one.value} to {other.value}', metric.name, test.pairs,
                        test.gained, test.lost, test.p,
                    )
                )  # fmt: skip
    return Table(
        headings=('reader', 'configurations', 'what', 'pairs', 'gained', 'lost', 'p'),
        rows=rows,
        caption='Exact McNemar tests on the same prompts and seeds',
    )


def checked_table(runs: Runs) -> Table:
    """Return what the independent checker says of runs whose conditions all hold."""
    rows: list[Sequence[Cell]] = []
    for (reader, configuration), part in groups(runs).items():
        if configuration.writes_program:
            continue
        passed = [r for r in part if r.passed and r.feasibility != 'infeasible']
        said = [s.outcome for r in passed for s in r.said]
        rows.append(
            (
                reader, configuration.value, len(passed), sum(r.contradicted for r in passed),
                sum(r.silent for r in part),
                sum(r.passed and r.feasibility == 'infeasible' for r in part),
                len(said), said.count('does_not'), said.count('cannot_tell'),
            )
        )  # fmt: skip
    return Table(
        headings=(
            'reader', 'configuration', 'P of possible requests', 'of these contradicted',
            'silent failures', 'P of infeasible requests', 'requirements asked', 'do not hold',
            'cannot tell',
        ),
        rows=rows,
        caption='The independent checker on runs whose monitored conditions all hold (a silent '
        'failure claims to be verified and is contradicted)',
    )  # fmt: skip


def category_table(runs: Runs) -> Table:
    """Return the metrics by category."""
    rows: list[Sequence[Cell]] = []
    for (reader, configuration), part in groups(runs).items():
        program = configuration.writes_program
        for category, some in by_category(part).items():
            first = share(some, lambda r: r.first is not None and r.first.value == 'verified')
            rows.append(
                (
                    reader, configuration.value, category, len(some),
                    *(share(some, m.of).met for m in METRICS if m.name in ('C', 'RF', 'declined')),
                    None if program else first.met,
                    None if program else share(some, lambda r: r.passed).met,
                    share(some, lambda r: r.right).met,
                    None if program else fidelity(some).value,
                )
            )  # fmt: skip
    return Table(
        headings=(
            'reader', 'configuration', 'category', 'runs', 'C', 'RF', 'declined', 'P at first',
            'P', 'right', 'Fid',
        ),
        rows=rows,
        caption='By category (numbers of runs)',
    )  # fmt: skip


def declined_table(runs: Runs) -> Table:
    """Return why runs did not complete."""
    counts = Counter(
        (r.reader, r.configuration.value, r.ending.value, r.feasibility, r.why)
        for r in runs
        if r.why
    )
    return Table(
        headings=('reader', 'configuration', 'ending', 'annotated as', 'why', 'runs'),
        rows=tuple((*key, n) for key, n in sorted(counts.items())),
        caption='Why runs did not complete',
    )


def repair_table(runs: Runs) -> Table:
    """Return what became of runs whose first realisation does not hold."""
    rows: list[Sequence[Cell]] = []
    for (reader, configuration), part in groups(runs).items():
        if configuration is not Configuration.AURORA:
            continue
        rows += [(reader, word, n, None, None) for word, n in repair_outcomes(part).items()]
        kinds = Counter((t.kind or 'nothing proposed', t.outcome) for r in part for t in r.tried)
        for (kind, outcome), number in sorted(kinds.items()):
            edits = sum(
                t.of_conditions
                for r in part
                for t in r.tried
                if (t.kind or 'nothing proposed', t.outcome) == (kind, outcome)
            )
            rows.append((reader, f'attempt: {kind}', number, outcome, edits))
        rows.append(
            (reader, 'specification changed', sum(not r.request_kept for r in part), None, None)
        )
    return Table(
        headings=('reader', 'what', 'number', 'outcome', 'edits of conditions'),
        rows=rows,
        caption='Repair: runs that did not hold at first, and the attempts',
    )


def placement_table(runs: Runs) -> Table:
    """Return placement errors at t = 0 by agent type, each prompt and seed once."""
    found: dict[str, list[float]] = {}
    for run in once(runs):
        for name, values in run.placed_m.items():
            found.setdefault(name, []).extend(values)
    return Table(
        headings=('type', 'bodies', 'median [m]', 'greatest [m]'),
        rows=tuple(
            (name, len(values), median(values), max(values))
            for name, values in sorted(found.items())
        ),
        caption='Distance between grounded and recorded place at t = 0',
    )


def anchor_table(runs: Runs) -> Table:
    """Return means of the terms of the anchor score by outcome."""
    rows: list[Sequence[Cell]] = []
    for (reader, configuration), part in groups(runs).items():
        for word, some in anchors_by_outcome(part).items():
            if not some:
                continue
            values = [r.anchor for r in some if r.anchor is not None]
            rows.append(
                (
                    reader, configuration.value, word, len(some),
                    *(fmean(getattr(v, name) for v in values) for name in ANCHOR_TERMS),
                )
            )  # fmt: skip
    return Table(
        headings=('reader', 'configuration', 'outcome', 'runs', *ANCHOR_TERMS),
        rows=rows,
        caption='Joint anchor score and its terms, means',
    )


ANCHOR_TERMS = ('road', 'air', 'sense', 'comm', 'joint')


def margin_table(runs: Runs) -> Table:
    """Return the least margins by what conditions ask, in their own units."""
    rows: list[Sequence[Cell]] = []
    for (reader, configuration), part in groups(runs).items():
        names = dict.fromkeys(name for r in part for name in sorted(r.margins))
        for name in sorted(names):
            values = [r.margins[name] for r in part if name in r.margins]
            rows.append(
                (
                    reader, configuration.value, name, len(values),
                    sum(v >= 0.0 for v in values), median(values), min(values),
                )
            )  # fmt: skip
    return Table(
        headings=(
            'reader',
            'configuration',
            'condition',
            'runs',
            'not negative',
            'median',
            'least',
        ),
        rows=rows,
        caption='Least margin per run by what a condition asks, in its own unit',
    )


def cost_table(runs: Runs) -> Table:
    """Return median seconds by stage."""
    rows: list[Sequence[Cell]] = []
    for (reader, configuration), part in groups(runs).items():
        timed = [r for r in part if r.seconds]
        for stage in _STAGES:
            values = [r.seconds[stage] for r in timed if stage in r.seconds]
            if values:
                rows.append(
                    (reader, configuration.value, stage, len(values), median(values), sum(values))
                )
    return Table(
        headings=('reader', 'configuration', 'stage', 'runs', 'median [s]', 'sum [s]'),
        rows=rows,
        caption='Wall seconds by stage of the runs that reached it; processor: of the whole run',
    )


def seed_table(runs: Runs) -> Table:
    """Return how many prompts pass with all, some and none of their seeds."""
    rows: list[Sequence[Cell]] = []
    for (reader, configuration), part in groups(runs).items():
        shares = list(per_prompt(part).values())
        every = sum(s.met == s.total for s in shares)
        none = sum(s.met == 0 for s in shares)
        mean = sum(s.value for s in shares) / len(shares)
        rows.append(
            (
                reader,
                configuration.value,
                len(shares),
                every,
                len(shares) - every - none,
                none,
                mean,
            )
        )
    return Table(
        headings=(
            'reader', 'configuration', 'prompts', 'all seeds pass', 'some', 'none', 'mean share',
        ),
        rows=rows,
        caption='Pass probability of a prompt over its seeds',
    )  # fmt: skip


def once(runs: Runs) -> list[CampaignRun]:
    """Return one run of each reader, prompt and seed that has placements."""
    found: dict[tuple[str, str, str, int], CampaignRun] = {}
    for run in runs:
        if run.placed_m:
            found.setdefault((run.reader, run.file, run.id, run.seed), run)
    return list(found.values())


def told(found: Share) -> str:
    """Return a share with its interval, as tables have it."""
    low, high = found.interval
    return f'{found.value:.2f} [{low:.2f}, {high:.2f}]'


def as_csv(table: Table) -> str:
    """Return a table as CSV: numbers unrounded, nothing for nothing."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator='\n')
    writer.writerow(table.headings)
    writer.writerows(['' if cell is None else cell for cell in row] for row in table.rows)
    return stream.getvalue()


_LATEX = {
    '\\': r'\textbackslash{}', '&': r'\&', '%': r'\%', '$': r'\$', '#': r'\#', '_': r'\_',
    '{': r'\{', '}': r'\}', '~': r'\textasciitilde{}', '^': r'\textasciicircum{}', '–': '--',
    '<': r'\textless{}', '>': r'\textgreater{}',
}  # fmt: skip


def as_latex(table: Table, label: str) -> str:
    """Return a table for LaTeX with booktabs."""
    numbers = [
        all(c is None or (isinstance(c, int | float) and not isinstance(c, bool)) for c in column)
        for column in zip(*table.rows, strict=True)
    ]
    lines = [
        r'\begin{table}', r'\centering', rf'\caption{{{_tex(table.caption)}}}',
        rf'\label{{tab:{label}}}',
        rf'\begin{{tabular}}{{@{{}}{"".join("r" if n else "l" for n in numbers)}@{{}}}}',
        r'\toprule', ' & '.join(_tex(h) for h in table.headings) + r' \\', r'\midrule',
        *(' & '.join(_tex(cell_text(c)) for c in row) + r' \\' for row in table.rows),
        r'\bottomrule', r'\end{tabular}', r'\end{table}',
    ]  # fmt: skip
    return '\n'.join(lines) + '\n'


def _tex(text: str) -> str:
    return ''.join(_LATEX.get(letter, letter) for letter in text.replace('\\|', '|'))
