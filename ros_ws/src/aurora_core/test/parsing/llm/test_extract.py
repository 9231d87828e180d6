# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One JSON object out of whatever a model writes around it."""

from __future__ import annotations

import pytest

from aurora_core.parsing.llm.extract import MAX_REPLY_CHARACTERS, ReplyError, json_object

MARKS = frozenset({'clauses'})


@pytest.mark.parametrize(
    'text',
    [
        '{"clauses": [{"a": "}"}]}',
        '```json\n{"clauses": [{"a": "}"}]}\n```',
        'Sure {really}! {"x": 1} is nothing. {"clauses": [{"a": "}"}]} Anything else? {}',
    ],
)
def test_found_without_its_surroundings(text: str) -> None:
    assert json_object(text, MARKS) == '{"clauses": [{"a": "}"}]}'


@pytest.mark.parametrize(
    ('text', 'words'),
    [
        ('I cannot do that.', 'found 0'),
        ('', 'found 0'),
        ('{"clauses": [', 'the first brace opens something else'),
        ("{'clauses': []}", 'the first brace opens something else'),
        ('{"clauses": [],}', 'the first brace opens something else'),
        ('{"clauses": []} {"clauses": [1]}', 'found 2'),
        ('{"answer": {"clauses": []}}', 'found 0'),
        ('{"clauses": [], "clauses": [1]}', 'keys must not repeat: clauses'),
        ('{"clauses": [NaN]}', 'numbers must be finite'),
        ('{"clauses": ' + '[' * 100_000, 'found 0'),
        ('{"a": ' * 20_000, 'found 0'),
        ('x' * (MAX_REPLY_CHARACTERS + 1), 'more than'),
    ],
    ids=lambda value: value[:24],
)
def test_anything_else_is_turned_down(text: str, words: str) -> None:
    with pytest.raises(ReplyError, match=words):
        json_object(text, MARKS)
