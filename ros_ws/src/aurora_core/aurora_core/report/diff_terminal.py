# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora diff` in a terminal: what the runs were made of first, then where they part."""

from __future__ import annotations

from rich.console import Console

from aurora_core.report.diff_report import DiffReport, PlacedDifference
from aurora_core.report.terminal import headline, line, print_table
from aurora_core.trace.trace import Integrity


def print_diff(report: DiffReport, console: Console) -> None:
    """Print a comparison."""
    if report.equal:
        headline(
            console,
            'equal',
            'green',
            f'{report.first.ticks} ticks and every margin are the same to the last bit.',
        )
    else:
        headline(console, 'different', 'red', _summary(report))
    for name, side in (('first', report.first), ('second', report.second)):
        line(console, f'{name:8} {side.bag}')
        line(console, f'         {side.ticks} ticks, {side.integrity.value}, {side.trace_sha256}')
        if side.integrity is not Integrity.INTACT:
            line(console, f'         {side.note}')
    print_table(
        'Made of different',
        ('what', 'first', 'second'),
        [(entry.name, _short(entry.first), _short(entry.second)) for entry in report.inputs],
        console,
    )
    print_table(
        'Ticks that differ',
        ('topic', 'ticks', 'first at', 'body', 'quantity', 'first', 'second'),
        [
            (entry.topic, str(entry.differing_ticks), _time(entry.first), *_row(entry.first))
            for entry in report.topics
        ],
        console,
        right=(1, 2),
    )
    print_table(
        'State at the last common tick',
        ('topic', 'body', 'quantity', 'first', 'second'),
        [(entry.topic, *_row(entry)) for entry in report.final],
        console,
    )
    if report.margins is None:
        line(console, 'margins  not compared: a bag carries no scenario graph')
        return
    print_table(
        'Margins that differ',
        ('condition', 'first', 'second', 'difference', 'unit', 'what'),
        [
            (
                entry.condition,
                _number(entry.first),
                _number(entry.second),
                '' if entry.difference is None else f'{entry.difference:+.6g}',
                entry.unit,
                entry.what,
            )
            for entry in report.margins
        ],
        console,
        right=(1, 2, 3),
    )


def _summary(report: DiffReport) -> str:
    first = report.first_difference
    if first is not None:
        return (
            f'First at tick {first.tick} ({first.time_s:.2f} s): {first.topic}, {first.body}, '
            f'{first.quantity}: {_number(first.first)} and {_number(first.second)}.'
        )
    if report.first.ticks != report.second.ticks:
        return (
            'The same in every tick that both have; '
            f'{report.first.ticks} ticks and {report.second.ticks}.'
        )
    if report.inputs:
        return f'The same in every tick; they differ in {report.inputs[0].name}.'
    return 'The same in every tick; margins differ.'


def _row(entry: PlacedDifference) -> tuple[str, str, str, str]:
    return entry.body, entry.quantity, _number(entry.first), _number(entry.second)


def _time(entry: PlacedDifference) -> str:
    return f'{entry.tick} ({entry.time_s:.2f} s)'


def _number(value: float | str | None) -> str:
    # repr has every bit of a number.
    return 'none' if value is None else value if isinstance(value, str) else repr(value)


def _short(text: str) -> str:
    return text if len(text) <= 60 else f'{text[:57]}...'
