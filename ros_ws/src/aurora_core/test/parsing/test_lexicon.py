# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The lexicon covers the vocabulary, and its file is checked."""

from __future__ import annotations

import marshal
from fractions import Fraction
from pathlib import Path

import pytest

from aurora_core.errors import ConfigError
from aurora_core.parsing.data_files import read_data
from aurora_core.parsing.lexicon import Lexicon, Tag, phrase_table, shipped_lexicon
from aurora_core.parsing.morphology import VerbForm
from aurora_core.spec.vocabulary import (
    AgentType,
    BehaviorKind,
    Pattern,
    Place,
    Relation,
    TimeOfDay,
    TrafficDensity,
    Weather,
)


def _keys(section: str) -> set[str]:
    return set(read_data('lexicon.yaml')[section])


def test_every_word_of_the_vocabulary_can_be_said() -> None:
    assert _keys('agents') == {a.value for a in AgentType}
    assert _keys('weather') == {w.value for w in Weather}
    assert _keys('time_of_day') == {t.value for t in TimeOfDay}
    assert _keys('traffic_density') == {t.value for t in TrafficDensity}
    assert _keys('places') == {p.value for p in Place}
    assert _keys('patterns') == {p.value for p in Pattern}
    assert _keys('verbs') >= {b.value for b in BehaviorKind}
    # `at`, `on` are prepositions, `parked_at` is said with the verb
    assert _keys('relations') == {r.value for r in Relation} - {'at', 'on', 'parked_at'}


def test_words_that_yaml_would_take_for_booleans_stay_words() -> None:
    known = shipped_lexicon()
    assert [s.tag for s in known.senses(('no',))] == [Tag.NEGATION]
    assert Tag.PREPOSITION in {s.tag for s in known.senses(('on',))}


def test_longest_phrase_comes_first() -> None:
    found = shipped_lexicon().matches(['fire', 'truck', 'stops'], 0)
    assert [length for length, _ in found] == [2]
    found = shipped_lexicon().matches(['in', 'front', 'of', 'it'], 0)
    assert [length for length, _ in found] == [3, 2, 1]


def test_forms_are_derived() -> None:
    senses = shipped_lexicon().senses(('overtakes',))
    assert [(s.tag, s.key, s.form) for s in senses] == [(Tag.VERB, 'overtake', VerbForm.THIRD)]
    assert any(s.plural for s in shipped_lexicon().senses(('buses',)))


def test_units_are_exact() -> None:
    assert shipped_lexicon().units['kph'].factor == Fraction(5, 18)
    assert shipped_lexicon().units['kn'].factor == Fraction(463, 900)


def test_a_new_word_needs_one_line() -> None:
    data = read_data('lexicon.yaml')
    data['agents']['van'] = [*data['agents']['van'], 'camper']
    assert [s.key for s in Lexicon(data).senses(('campers',))] == ['van']


def test_a_compiled_table_is_the_one_that_the_sections_give() -> None:
    data = read_data('lexicon.yaml')
    made, packed = Lexicon(data), Lexicon(data, marshal.loads(marshal.dumps(phrase_table(data))))
    for words in (('fire', 'truck'), ('buses',), ('on',), ('overtakes',), (), ('nowhere',)):
        assert made.senses(words) == packed.senses(words)
    assert (made.words, made.content_words) == (packed.words, packed.content_words)
    assert packed.matches(['in', 'front', 'of', 'it'], 0) == shipped_lexicon().matches(
        ['in', 'front', 'of', 'it'], 0
    )


def test_each_reader_has_data_of_its_own() -> None:
    read_data('lexicon.yaml')['agents']['van'].append('camper')
    assert 'camper' not in read_data('lexicon.yaml')['agents']['van']


def test_missing_file_is_a_configuration_error() -> None:
    with pytest.raises(ConfigError, match=r'nowhere\.yaml'):
        read_data('nowhere.yaml')


def test_file_that_is_no_mapping_is_a_configuration_error(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr('aurora_core.parsing.data_files.data_path', lambda name: tmp_path / name)
    (tmp_path / 'list.yaml').write_text('- one\n')
    with pytest.raises(ConfigError, match='mapping'):
        read_data('list.yaml')
