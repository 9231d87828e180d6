# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A campaign that was cut goes on where it was, and never with another one's outcomes."""

from __future__ import annotations

from pathlib import Path

import pytest

from aurora_bench.mutation import __main__ as command
from aurora_bench.mutation.campaign import Campaign, Outcome
from aurora_bench.mutation.prompts import SOUND
from aurora_system_tests.planted_bugs import PLANTED, Planted


def outcome(kind: str, name: str) -> Outcome:
    return Outcome(
        kind=kind, name=name, base=name, harmless=False, stamped=True, bag=True, good=True,
        status='violated', recomputed=True,
    )  # fmt: skip


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Collect what is really worked at; the third piece is cut."""
    done: list[str] = []

    def of_run(
        _options: object, _folder: Path, prompt: str, seed: int, _p: object
    ) -> list[Outcome]:
        done.append(f'{prompt}:{seed}')
        if len(done) == 3:
            raise KeyboardInterrupt
        return [outcome('teleport', prompt)]

    def plant(_campaign: Campaign, planted: Planted) -> Outcome:
        done.append(planted.name)
        return outcome('planted bug', planted.name)

    monkeypatch.setattr(command, '_of_run', of_run)
    monkeypatch.setattr(Campaign, 'plant', plant)
    return done


def test_what_is_in_the_journal_is_not_done_again(asked: list[str], tmp_path: Path) -> None:
    place = ['--results', str(tmp_path), '--resume', str(tmp_path)]
    assert command.main([*place, '--seeds', '1']) == command.INTERRUPTED
    first, second, cut = asked
    assert [first, second] == [f'{name}:1' for name in list(SOUND)[:2]]
    command.main([*place, '--seeds', '1'])
    assert asked.count(first) == asked.count(second) == 1
    assert asked.count(cut) == 2
    assert asked[-len(PLANTED) :] == [bug.name for bug in PLANTED]
    assert f'{len(PLANTED)} of {len(PLANTED)}' in (tmp_path / 'mutation.md').read_text()


def test_a_journal_of_other_options_is_refused(asked: list[str], tmp_path: Path) -> None:
    place = ['--results', str(tmp_path), '--resume', str(tmp_path)]
    assert command.main([*place, '--seeds', '1']) == command.INTERRUPTED
    done = len(asked)
    assert command.main([*place, '--seeds', '1', '--seed', '2']) == command.USAGE
    assert len(asked) == done
