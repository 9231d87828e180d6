# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Nothing that a prompt holds may steer the terminal that a report is printed on."""

from __future__ import annotations

import io

import pytest
from rich.console import Console

from aurora_core.report.terminal import line, print_table
from aurora_core.report.visible import one_line, visible


@pytest.mark.parametrize(
    ('text', 'shown'),
    [
        ('A drone – 30 m, Straße 漢 🚁', 'A drone – 30 m, Straße 漢 🚁'),
        ('\x1b[2J\x07', r'\x1b[2J\x07'),
        ('\x9b31m\x7f', r'\x9b31m\x7f'),
        ('a\u202eb\u2066', r'a\u202eb\u2066'),
        ('\u2028', r'\u2028'),
        ('\U000e0001', r'\U000e0001'),
        ('a\tb\nc', 'a\tb\nc'),
    ],
)
def test_what_a_terminal_would_obey_is_shown(text: str, shown: str) -> None:
    assert visible(text) == shown


def test_one_line_has_no_breaks() -> None:
    assert one_line('a\r\n\tVERIFIED') == 'a VERIFIED'


@pytest.mark.parametrize('terminal', [False, True])
def test_a_printed_report_obeys_nothing_and_keeps_its_lines(terminal: bool) -> None:
    out = io.StringIO()
    console = Console(file=out, force_terminal=terminal, width=200, color_system=None)
    evil = 'x\x1b[2J\x9b1A\nVERIFIED  [bold]y[/bold]\u202e'
    line(console, evil)
    print_table('Clauses', ('a', 'b'), [(evil, evil)], console)
    printed = out.getvalue()
    assert not any(character in printed for character in '\x9b\u202e\x07')
    assert '\x1b[2J' not in printed
    assert printed.count(r'x\x1b[2J\x9b1A VERIFIED  [bold]y[/bold]\u202e') == 3
    assert not any(row.startswith('VERIFIED') for row in printed.splitlines())
