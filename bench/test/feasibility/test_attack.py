# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The attack finds what can be, goes elsewhere, and takes up where it ended."""

from __future__ import annotations

import random
from functools import cache
from pathlib import Path

import pytest
from judged_once import judged_once

from aurora_bench.feasibility import attack, attempt
from aurora_bench.feasibility.families import Case, family_cases
from aurora_bench.rulers.checking import independent_checker
from aurora_cli.installed import installed
from aurora_cli.local_engine import LocalStages
from aurora_core.outcomes.feasibility import Rule
from aurora_core.spec.parameter import Provenance


class _Lowest(random.Random):
    """Every chance comes true."""

    def random(self) -> float:
        return 0.0


@cache
def cases() -> tuple[Case, ...]:
    return tuple(family_cases())


def case(ident: str) -> Case:
    return next(c for c in cases() if c.id == ident and c.source == 'annotation')


def attempted(
    one: Case, place: Path, index: int = 0, earlier: list[dict[str, object]] | None = None
) -> dict[str, object]:
    stages = LocalStages(installed())
    tried = attempt.Attempts(stages, independent_checker(), 'downtown', place)
    return tried.once(one, index, _Lowest(), earlier or [])


def test_what_can_be_is_found_to_be_realised(tmp_path: Path) -> None:
    """An attack that finds nothing proves nothing, unless it finds what is there."""
    result = attempted(case('times-horizon-kept-1'), tmp_path)
    assert result['ended'] == attempt.REALISED, result


def test_a_place_that_was_tried_is_left(tmp_path: Path) -> None:
    one = case('speed-pursuit-kept-1')
    first = attempted(one, tmp_path)
    again = attempted(one, tmp_path, earlier=[first])
    places = [r['place'] for r in (first, again)]
    assert isinstance(places[0], dict)
    assert isinstance(places[1], dict)
    assert places[0]['lane'] != places[1]['lane']


def test_a_flight_without_a_place_is_flown_all_the_same(tmp_path: Path) -> None:
    """Inside the no-fly zone: the plan is made without it, the judgement is not."""
    result = attempted(case('geofence-over-refused-1'), tmp_path)
    assert (result['ended'], result['freely']) == (attempt.UNSAFE, True), result
    assert 'safety.no_fly.uav1' in str(result['why'])


def test_another_plan_bends_what_is_stated_and_keeps_its_words() -> None:
    spec = case('space-slant-refused-1').spec
    assert spec is not None
    bent = attempt.varied(spec, _Lowest())
    stated = [m.altitude_m.value for m in bent.missions], len(bent.conditions)
    assert stated != ([m.altitude_m.value for m in spec.missions], len(spec.conditions))
    assert bent.prompt == spec.prompt
    altitude = bent.missions[0].altitude_m
    assert altitude.provenance is Provenance.EXPLICIT or altitude.low <= altitude.value


def test_every_second_plan_keeps_what_is_stated() -> None:
    spec = case('sensing-night-refused-1').spec
    assert spec is not None
    other = attempt.varied(spec, random.Random(10))
    assert other != spec
    assert other.missions[0].standoff_m == spec.missions[0].standoff_m
    assert other.world == spec.world


def test_every_rule_is_attacked_and_both_ways_of_asking_are(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # Of every family the first of each way of asking; all are judged by `test_families`.
    some = [c for c in cases() if c.id.rpartition('-')[2] == '1']
    monkeypatch.setattr(attack, 'family_cases', lambda: some)
    monkeypatch.setattr(attack, 'judged', judged_once)
    certified = attack._certified('downtown', '', 400.0)
    chosen = attack._sample(certified, 1)
    assert len(chosen) == len({c.rule for c in certified}) >= 18
    assert {c.case.source for c in chosen} == {'prompt', 'annotation'}
    more = [c.case.id for c in attack._sample(certified, 2)]
    assert {c.case.id for c in chosen} <= set(more)


def test_an_attack_goes_on_where_it_ended(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    chosen = [attack.Certified(case=case('times-horizon-refused-1'), rule=Rule.HORIZON)]
    monkeypatch.setattr(attack, '_certified', lambda *_: chosen)
    ran: list[int] = []

    def once(_self: object, _case: Case, index: int, *_: object) -> dict[str, object]:
        ran.append(index)
        if len(ran) == 2:
            raise KeyboardInterrupt
        return {'ended': attempt.DENIED, 'why': ['mission'], 'place': None}

    monkeypatch.setattr(attempt.Attempts, 'once', once)
    options = ['--runs', '3', '--results', str(tmp_path)]
    with pytest.raises(KeyboardInterrupt):
        attack.main(options)
    assert attack.main([*options, '--resume', str(tmp_path)]) == 0
    assert ran == [0, 1, 1, 2]
    assert 'attacked 1 requests, 3 runs; realised 0' in capsys.readouterr().out
