# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What stands in brackets or in `, which …,`."""

from __future__ import annotations

from aurora_core.parsing.segments import take_out
from aurora_core.parsing.tagging import tag
from aurora_core.parsing.tokens import tokenize


def _read(text: str) -> tuple[list[str], list[tuple[str, str]]]:
    kept, asides = take_out(tag(tokenize(text), {}).atoms)
    told = [(text[a.atoms[0].start : a.atoms[-1].end], a.head.key) for a in asides]
    return [text[a.start : a.end] for a in kept], told


def test_a_place_or_a_predicate_is_a_clause_about_the_noun_in_front() -> None:
    kept, told = _read('the ego brakes if the truck (40 m in front) stops')
    assert told == [('40 m in front', 'truck')]
    assert kept == ['the ego', 'brakes', 'if', 'the truck', 'stops']
    assert _read('the van (driving at 8 m/s) stops')[1] == [('driving at 8 m/s', 'van')]
    assert _read('the bus, which drives at 8 m/s, stops')[1] == [('drives at 8 m/s', 'bus')]


def test_values_stay_where_they_are() -> None:
    kept, told = _read('the drone orbits the ego (radius 60 m, altitude 45 m)')
    assert not told
    assert {'radius', '60 m', 'altitude', '45 m'} <= set(kept)


def test_an_open_bracket_takes_nothing_out() -> None:
    assert not _read('the van (driving at 8 m/s stops')[1]
    assert not _read('the bus, which drives at 8 m/s')[1]
