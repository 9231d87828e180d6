# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The campaign of Simple Temporal Networks: some hundreds of networks, and planted faults."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from aurora_bench.stn.__main__ import main
from aurora_bench.stn.agreement import Comparison, is_negative_circle
from aurora_bench.stn.networks import MAX_POINTS, Kind, Network, network
from aurora_core.temporal.stn import Edge, Minimal, Stn


def test_networks_are_drawn_again_and_are_of_every_kind_and_size() -> None:
    drawn = [network(3, number) for number in range(600)]
    assert drawn[:9] == [network(3, number) for number in range(9)]
    sizes = {len(each.points) for each in drawn}
    assert 1 in sizes
    assert max(sizes) > 0.9 * MAX_POINTS
    assert {each.kind for each in drawn} == set(Kind)
    assert any(not each.edges for each in drawn)


def test_the_campaign_writes_its_results(tmp_path: Path) -> None:
    assert main(['--networks', '300', '--results', str(tmp_path)]) == 0
    found = json.loads((tmp_path / 'stn.json').read_text(encoding='utf-8'))
    assert (found['unequal'], found['broken']) == ([], [])
    assert found['inconsistent']['met'] == 0
    assert min(found['inconsistent']['tightened'], found['inconsistent']['free']) > 10
    assert [goal['met'] for goal in found['goals']] == [None, True, None]
    assert 'SciPy' in (tmp_path / 'stn.md').read_text(encoding='utf-8')


def _of(*edges: tuple[str, str, int]) -> Network:
    made = tuple(Edge(a, b, bound, k) for k, (a, b, bound) in enumerate(edges))
    points = tuple(dict.fromkeys(point for edge in edges for point in edge[:2]))
    return Network(number=7, kind=Kind.FREE, points=points, edges=made)


def test_a_wrong_value_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    one = _of(('a', 'b', 5), ('b', 'c', -2))
    right = Stn.minimal

    def wrong(stn: Stn[int]) -> Minimal | None:
        found = right(stn)
        assert found is not None
        return Minimal(found.points, found.bounds_us + np.eye(3, dtype=np.int64))

    monkeypatch.setattr(Stn, 'minimal', wrong)
    comparison = Comparison()
    comparison.compare(one)
    assert comparison.unequal == [7]


def test_a_circle_that_is_overlooked_or_made_up_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Stn, 'negative_cycle', lambda stn: stn.edges[:1])
    comparison = Comparison()
    comparison.compare(_of(('a', 'b', 5), ('b', 'a', -4)))
    assert (comparison.unequal, comparison.broken) == ([7], [7])
    monkeypatch.setattr(Stn, 'negative_cycle', lambda stn: ())
    comparison = Comparison()
    comparison.compare(_of(('a', 'b', 5), ('b', 'a', -6)))
    assert comparison.unequal == [7]


def test_circles_are_added_up_again() -> None:
    one = _of(('a', 'b', 5), ('b', 'a', -6), ('b', 'c', 1), ('c', 'b', -1))
    first, second, out, back = one.edges
    assert is_negative_circle(one, (first, second))
    assert not is_negative_circle(one, (first,))  # not closed
    assert not is_negative_circle(one, (out, back))  # adds up to nothing
    assert not is_negative_circle(one, (first, out, back, second))  # a point twice
    assert not is_negative_circle(one, (first, Edge('b', 'a', -9, 1)))  # another bound
