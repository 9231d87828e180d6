# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The inputs that a fuzzer has led to, once more, without it; and that the campaign counts."""

from __future__ import annotations

import json
from itertools import islice
from pathlib import Path

import pytest

from aurora_bench.guided import __main__ as campaign
from aurora_bench.guided import corpus
from aurora_bench.guided.corpus import MOST_INPUTS, keep, keep_found, kept
from aurora_bench.guided.small_bag import SmallBag
from aurora_bench.guided.targets import TARGETS
from aurora_bench.guided.worker import BOUNDS_S, Tally


@pytest.mark.parametrize('name', sorted(TARGETS))
def test_what_was_led_to_new_code_is_still_refused_or_read(name: str, tmp_path: Path) -> None:
    attempt = TARGETS[name].make(tmp_path)
    for data in (*kept(name), *islice(TARGETS[name].seeds(), 10)):
        attempt(data)


@pytest.mark.parametrize('name', sorted(TARGETS))
def test_there_is_something_to_begin_with(name: str) -> None:
    assert sum(len(data) > 1 for data in TARGETS[name].seeds()) >= 3


def test_edits_change_a_bag_and_none_leave_it(tmp_path: Path) -> None:
    small = SmallBag.recorded(tmp_path)
    assert small.changed(b'') == small.whole
    edit = b'\x00\x02\x03\x00\x28\x00\x00\x00\x02\xff\xff'
    assert small.changed(edit) != small.whole
    in_place = small.changed(b'\x01' + edit[1:])
    assert sum(a != b for a, b in zip(in_place, small.whole, strict=True)) <= 2


def test_a_kept_input_stays_and_there_are_never_too_many(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(corpus, 'FOLDER', tmp_path)
    first = [bytes([k]) * (k + 1) for k in range(30)]
    assert keep('prompt', first, tmp_path) == 30
    assert keep('prompt', [bytes([k, 1]) for k in range(200)], tmp_path) == MOST_INPUTS
    keep_found('prompt', b'x' * 5000, tmp_path)
    assert set(kept('prompt')) >= {*first, b'x' * 5000}


def test_what_is_raised_is_kept_once_for_each_place(tmp_path: Path) -> None:
    tally = Tally(tmp_path / 'tally.json', 3)
    for data in (b'a', b'b'):
        try:
            campaign._p99_s(())  # there is nothing to take a share of
        except ValueError as err:
            tally.failed(err, data)
        tally.took(BOUNDS_S[3])
    tally.took(1e9)
    told = json.loads((tmp_path / 'tally.json').read_text())
    part = campaign.Part(**told, edges=5)
    assert [found['input'] for found in part.found.values()] == [b'a'.hex()]
    assert (part.tried, sum(part.counts), part.counts[3], part.counts[-1]) == (3, 3, 2, 1)
    assert campaign._p99_s([part]) == float('inf')
    assert campaign._p99_s([part.model_copy(update={'counts': (*part.counts[:-1], 0)})]) < 0.01
