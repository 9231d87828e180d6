# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora campaign report`: every table and figure of a campaign, from its files alone."""

from __future__ import annotations

from pathlib import Path

from aurora_bench.campaign.figures import draw_all
from aurora_bench.campaign.paper import DIFFERS
from aurora_bench.campaign.results import Campaign, read_campaign
from aurora_bench.campaign.tables import all_tables, as_csv, as_latex
from aurora_bench.results import machine_line, markdown_table, write_whole


def write_report(folder: Path, out: Path, *, name: str = 'campaign') -> tuple[Path, ...]:
    """Write tables (Markdown, LaTeX, CSV) and figures (PDF, SVG, PNG), and return their paths.

    No single prompt is in them: some are held out.

    Args:
        folder: Of the campaign's files.
        out: Where to.
        name: Of the Markdown file.

    Raises:
        PlanError: There is no finished campaign.
        ResultsError: A file cannot be written.
    """
    campaign, spent = read_campaign(folder)
    runs = campaign.runs
    sections = [f'# Campaign {campaign.plan["name"]}', machine_line(spent.machine), DIFFERS]
    written = []
    for key, table in all_tables(runs).items():
        sections.append(markdown_table(table))
        for ending, text in (('csv', as_csv(table)), ('tex', as_latex(table, key))):
            written.append(out / 'tables' / f'{key}.{ending}')
            write_whole(written[-1], text.encode())
    for drawn in draw_all(runs, out / 'figures'):
        sections.append(f'![{drawn.name}](figures/{drawn.name}.svg)\n\n{drawn.caption} {DIFFERS}')
        written += drawn.paths
        written.append(out / 'figures' / f'{drawn.name}.txt')
        write_whole(written[-1], f'{drawn.caption} {DIFFERS}\n'.encode())
    if campaign.quarantined:
        lines = [f'* `{key}`: {why}' for key, why in campaign.quarantined.items()]
        sections.append('Quarantined:\n\n' + '\n'.join(lines))
    sections.append('What went in:\n\n' + '\n'.join(_inputs(campaign)))
    written.insert(0, out / f'{name}.md')
    write_whole(written[0], ('\n\n'.join(sections) + '\n').encode())
    return tuple(written)


def _inputs(campaign: Campaign) -> list[str]:
    lines = [f'* {name}: sha256 {digest}' for name, digest in campaign.files.items()]
    lines += [f'* replies of {name}: sha256 {d}' for name, d in campaign.transcripts.items()]
    lines.append(f'* code and configuration: sha256 {campaign.code}')
    lines.append(f'* {", ".join(f"{n} {v}" for n, v in campaign.versions.items())}')
    return lines
