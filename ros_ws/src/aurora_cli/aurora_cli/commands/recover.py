# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora bag recover`: a readable bag out of a recording that was cut short."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path

from aurora_cli.bags import find_bag
from aurora_cli.output import answer_console, print_json
from aurora_core.report.terminal import headline, line
from aurora_core.trace.bag_recover import Outcome, Recovery, recover_bag
from aurora_core.trace.definitions import message_definitions

_WORDS = {
    Outcome.RECOVERED: ('recovered', 'green'),
    Outcome.ALREADY: ('recovered already', 'green'),
    Outcome.READABLE: ('nothing to recover', 'cyan'),
}


def recover_command(bag: str, out: Path | None, iteration: int | None, *, as_json: bool) -> int:
    """Recover a bag and return the exit code.

    Raises:
        UsageProblem: There is no such run or bag.
        AuroraError: Nothing in it can be judged, or the folder cannot be written.
    """
    done = recover_bag(find_bag(bag, iteration).bag, out, message_definitions())
    if as_json:
        print_json({'schema_version': 1, **asdict(done)})
    else:
        _print(done)
    return 0


def _print(done: Recovery) -> None:
    console = answer_console()
    word, colour = _WORDS[done.outcome]
    headline(console, word, colour, f'{done.bag} is readable ({done.integrity.value}).')
    kept = sum(done.kept.values())
    lost = 'an unknown number is lost' if done.lost is None else f'{done.lost} are lost'
    line(console, f'messages {kept} kept, {lost}')
    if done.last_complete_tick >= 0:
        upto = f'complete up to tick {done.last_complete_tick} ({done.complete_s:.2f} s)'
    else:
        upto = 'no tick is complete'
    behind = f'; {done.gaps} ticks up to tick {done.ticks - 1} are not' if done.gaps else ''
    line(console, f'trace    {upto}{behind}')
    for note in done.damage:
        line(console, f'damage   {note}')
    if done.outcome is not Outcome.READABLE:
        line(console, f'source   {done.source} (unchanged)')
