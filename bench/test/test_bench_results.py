# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Results of campaigns: whole files, valid JSON, tables that read as plain text."""

from __future__ import annotations

import io
import json
from pathlib import Path

import pytest

from aurora_bench.machine import UNKNOWN, Machine, busy_share, cpu_model, machine_facts
from aurora_bench.plotting import new_figure, save_figure
from aurora_bench.progress import Progress
from aurora_bench.results import (
    Goal,
    ResultsError,
    Table,
    cell_text,
    markdown_table,
    write_results,
)
from aurora_core.errors import ReportError

MACHINE = Machine(
    date_utc='2026-01-31T12:00:00Z',
    cores=2,
    cpu='A processor',
    memory_mib=8192,
    system='Linux x86_64',
    python='3.12.1',
    load_average=(0.5, 0.25, 0.125),
    versions={'aurora': '0.1.0'},
)


def test_results_hold_machine_goals_and_values(tmp_path: Path) -> None:
    folder = tmp_path / 'docs' / 'bench'
    json_file, markdown_file = write_results(
        folder,
        'speed',
        {'rounds': 3},
        title='Speed',
        goals=(
            Goal(name='fast', target='at least 40', figure='51', met=True),
            Goal(name='small', target='at most 10 %', figure='12 %', met=False),
            Goal(name='other', target='1', figure='not measured', met=None),
        ),
        tables=(Table(headings=('engine', 'ticks'), rows=(('local', 10),), caption='Runs'),),
        notes=('A note.',),
        machine=MACHINE,
    )
    document = json.loads(json_file.read_text(encoding='utf-8'))
    assert document['benchmark'] == 'speed'
    assert document['rounds'] == 3
    assert document['machine']['cores'] == 2
    assert [goal['met'] for goal in document['goals']] == [True, False, None]
    text = markdown_file.read_text(encoding='utf-8')
    assert text.startswith('# Speed\n\n2026-01-31T12:00:00Z · 2 cores, A processor · 8 GiB')
    assert '| fast  | at least 40  | 51           | met        |' in text
    assert 'NOT MET' in text
    assert 'not judged' in text
    assert '| local  |    10 |' in text
    assert text.endswith('A note.\n')
    assert sorted(path.name for path in folder.iterdir()) == ['speed.json', 'speed.md']


def test_old_results_stay_when_new_ones_are_not_json(tmp_path: Path) -> None:
    json_file, _ = write_results(tmp_path, 'speed', {'a': 1}, title='Speed', machine=MACHINE)
    before = json_file.read_bytes()
    with pytest.raises(ReportError, match='JSON'):
        write_results(tmp_path, 'speed', {'a': float('nan')}, title='Speed', machine=MACHINE)
    assert json_file.read_bytes() == before


def test_a_folder_that_cannot_be_made_is_named(tmp_path: Path) -> None:
    (tmp_path / 'file').write_text('', encoding='utf-8')
    with pytest.raises(ResultsError, match='--results'):
        write_results(tmp_path / 'file' / 'x', 'speed', {}, title='Speed', machine=MACHINE)


def test_numbers_are_to_the_right_and_bars_escaped() -> None:
    table = Table(headings=('what', 'us'), rows=(('a|b', 12.3456), ('c', None), ('d', 4000.4)))
    assert markdown_table(table).splitlines() == [
        '| what |    us |',
        '| ---- | ----: |',
        '| a\\|b | 12.35 |',
        '| c    |     – |',
        '| d    |  4000 |',
    ]


@pytest.mark.parametrize(
    ('cell', 'text'),
    [(True, 'yes'), (None, '–'), (0.0123412, '0.01234'), (7, '7'), ('x\ny', 'x y')],
)
def test_cells(cell: str | int | float | bool | None, text: str) -> None:
    assert cell_text(cell) == text


def test_a_row_of_another_length_is_refused() -> None:
    with pytest.raises(ResultsError, match='expected 2 cells'):
        Table(headings=('a', 'b'), rows=((1,),))


def test_facts_of_this_machine() -> None:
    facts = machine_facts()
    assert facts.cores >= 1
    assert 'numpy' in facts.versions
    assert Machine.model_validate_json(facts.model_dump_json()) == facts


def test_a_cpu_that_the_kernel_does_not_name(tmp_path: Path) -> None:
    assert cpu_model(tmp_path / 'absent') == UNKNOWN
    info = tmp_path / 'cpuinfo'
    info.write_text('processor\t: 0\nmodel name\t: Some CPU @ 2 GHz\n', encoding='utf-8')
    assert cpu_model(info) == 'Some CPU @ 2 GHz'


def test_progress_counts_steps_and_seconds() -> None:
    seconds = iter([100.0, 101.0, 103.0])
    stream = io.StringIO()
    progress = Progress('speed', 2, stream, lambda: next(seconds))
    progress.step('first')
    progress.note('aside')
    assert stream.getvalue().splitlines() == [
        'speed      1 s  [1/2] first',
        'speed      3 s  aside',
    ]


def test_equal_figures_are_equal_files(tmp_path: Path) -> None:
    contents = []
    for name in ('a', 'b'):
        figure, (left, right) = new_figure(4.0, 2.0, panels=2)
        left.plot([1.0, 2.0], [3.0, 4.0])
        right.bar([0], [1.0])
        contents.append([path.read_bytes() for path in save_figure(figure, tmp_path, name)])
    assert contents[0] == contents[1]
    assert contents[0][0].startswith(b'\x89PNG')


def test_the_busy_share_counts_everything_but_idle_and_waiting(tmp_path: Path) -> None:
    stat = tmp_path / 'stat'
    stat.write_text('cpu  10 0 10 100 0 0 0 0 0 0\ncpu0 1 2\n', encoding='ascii')

    def later(_seconds: float) -> None:
        stat.write_text('cpu  20 0 15 170 10 0 0 5 0 0\ncpu0 1 2\n', encoding='ascii')

    # 100 more in all: 10 user, 5 system, 5 stolen, 70 idle, 10 waiting for a disk.
    assert busy_share(1.0, stat, later) == pytest.approx(0.2)
    assert busy_share(1.0, stat, lambda _seconds: None) == 0.0
