# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The iterations of repair on the page."""

from __future__ import annotations

import re
from dataclasses import replace
from types import SimpleNamespace

from aurora_core.report.build import build_report
from aurora_core.report.html import report_html
from aurora_core.report.page.repairs import repair_figure
from aurora_core.report.run_report import MarginChange, RepairReport


def step(
    iteration: int, **realised: tuple[float | None, float | None, float | None]
) -> RepairReport:
    return RepairReport(
        iteration=iteration,
        kind='one_parameter',
        outcome='violated',
        bag=f'bag.{iteration}',
        reason='why not',
        margins=tuple(
            MarginChange(condition=name, before=b, predicted=p, realised=r)
            for name, (b, p, r) in realised.items()
        ),
    )


STEPS = (
    step(1, near=(-1.5, 0.4, -0.5), seen=(0.3, None, 0.3)),
    step(2, near=(-0.5, 0.2, 0.3), seen=(0.3, None, 0.2)),
)


def test_the_figure_has_a_line_for_what_failed_and_every_realisation_on_it() -> None:
    figure = repair_figure(STEPS)
    [points] = re.findall(r'<polyline class="course c0" points="([^"]*)"', figure)
    heights = [float(pair.split(',')[1]) for pair in points.split()]
    assert len(heights) == 3
    # Better is higher up, and the page counts downwards.
    assert heights == sorted(heights, reverse=True)
    assert figure.count('foreseen') == 2
    assert '>near</text>' in figure
    assert '>seen</text>' not in figure


def test_what_was_not_simulated_is_no_point_of_it() -> None:
    unfit = STEPS[0].model_copy(update={'bag': None, 'margins': ()})
    assert repair_figure((unfit,)) == ''
    assert repair_figure((unfit, *STEPS)) == repair_figure(STEPS)


def test_a_condition_cannot_become_markup() -> None:
    figure = repair_figure((step(1, **{'<b>x': (-1.0, None, 1.0)}),))
    assert '<b>' not in figure
    assert '&lt;b&gt;x' in figure


def test_the_reader_steps_through_the_iterations_with_all_three_margins(
    make: SimpleNamespace,
) -> None:
    page = report_html(build_report(replace(make.facts(), repairs=STEPS)))
    steps = re.findall(r'<details name="iteration".*?</details>', page, re.DOTALL)
    assert len(steps) == len(STEPS)
    assert ' open' in steps[-1].partition('>')[0]
    for shown, told in zip(steps, STEPS, strict=True):
        cells = re.findall(r'<td[^>]*>([^<]*)</td>', shown)
        row = next(row for row in told.margins if row.condition == 'near')
        assert row.before is not None
        assert row.predicted is not None
        assert row.realised is not None
        assert cells[:4] == [
            'near', f'{row.before:+.4g}', f'{row.predicted:+.4g}', f'{row.realised:+.4g}'
        ]  # fmt: skip
    assert '<svg viewBox' in page
