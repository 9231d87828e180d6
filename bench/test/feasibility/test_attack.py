# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The attack finds what can be, goes elsewhere, and takes up where it ended."""

from __future__ import annotations

import random
from dataclasses import replace
from pathlib import Path

import pytest

from aurora_bench.feasibility import attack
from aurora_bench.feasibility.families import Case, family_cases
from aurora_bench.rulers.checking import independent_checker
from aurora_cli.installed import installed
from aurora_cli.local_engine import LocalStages


class _Lowest(random.Random):
    """Every chance comes true."""

    def random(self) -> float:
        return 0.0


def case(ident: str) -> Case:
    return next(c for c in family_cases() if c.id == ident and c.source == 'annotation')


def attacked(one: Case, place: Path, places: list[dict[str, object]]) -> dict[str, object]:
    stages = LocalStages(installed())
    tried = attack._Attacked(stages, independent_checker(), 'downtown', place)
    return tried.once(one, 0, _Lowest(), places)


def test_what_can_be_is_found_to_be_realised(tmp_path: Path) -> None:
    """An attack that finds nothing proves nothing, unless it finds what is there."""
    result = attacked(case('times-horizon-kept-1'), tmp_path, [])
    assert result['ended'] == attack.REALISED, result


def test_a_place_that_was_tried_is_left(tmp_path: Path) -> None:
    one = case('speed-pursuit-kept-1')
    first = attacked(one, tmp_path, [])['place']
    assert isinstance(first, dict)
    again = attacked(one, tmp_path, [first])['place']
    assert isinstance(again, dict)
    assert again['lane'] != first['lane']


def test_an_attack_goes_on_where_it_ended(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    chosen = [replace(case('times-horizon-refused-1'))]
    monkeypatch.setattr(attack, '_certified', lambda *_: chosen)
    ran: list[int] = []

    def once(_self: object, _case: Case, index: int, *_: object) -> dict[str, object]:
        ran.append(index)
        if len(ran) == 2:
            raise KeyboardInterrupt
        return {'ended': attack.DENIED, 'why': ['mission'], 'place': None}

    monkeypatch.setattr(attack._Attacked, 'once', once)
    options = ['--runs', '3', '--results', str(tmp_path)]
    with pytest.raises(KeyboardInterrupt):
        attack.main(options)
    assert attack.main([*options, '--resume', str(tmp_path)]) == 0
    assert ran == [0, 1, 1, 2]
    assert 'attacked 1 requests, 3 runs; realised 0' in capsys.readouterr().out
