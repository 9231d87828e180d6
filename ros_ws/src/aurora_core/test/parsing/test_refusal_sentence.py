# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A refusal names what there is instead; of a long list what is most like the word."""

from __future__ import annotations

from aurora_core.outcomes.parse import Refusal, RefusalKind
from aurora_core.spec.parameter import Span

MANY = (*(f'Building {letter}' for letter in 'ABCDEFGHIJKLMNOPQRST'), 'Hotelli Torni')


def _refused(word: str, names: tuple[str, ...]) -> Refusal:
    return Refusal(
        kind=RefusalKind.MISSING_ELEMENT,
        word=word,
        span=Span(start=0, end=1),
        list_name='landmarks of town',
        closed_list=names,
    )


def test_a_short_list_is_named_whole_and_in_its_order() -> None:
    said = _refused('mill', ('Union Station', 'City Hall')).sentence()
    assert said == "'mill' is not one of the landmarks of town: Union Station, City Hall."
    assert _refused('mill', ()).sentence().endswith(': none.')


def test_of_a_long_list_the_most_alike_are_named_and_the_others_counted() -> None:
    refused = _refused('Hotel Torny', MANY)
    said = refused.sentence()
    assert 'landmarks of town: Hotelli Torni, Building ' in said
    assert said.endswith(' and 9 more.')
    assert said.count('Building') == 11
    assert refused.closed_list == MANY
