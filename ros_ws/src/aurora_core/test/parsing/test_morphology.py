# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Regular and irregular forms."""

from __future__ import annotations

import pytest

from aurora_core.parsing.morphology import VerbForm, plural, verb_forms


@pytest.mark.parametrize(
    ('noun', 'many'),
    [
        ('bus', 'buses'),
        ('van', 'vans'),
        ('lorry', 'lorries'),
        ('relay', 'relays'),
    ],
)
def test_plural(noun: str, many: str) -> None:
    assert plural(noun) == many


@pytest.mark.parametrize(
    ('verb', 'form', 'kind'),
    [
        ('follow', 'follows', VerbForm.THIRD),
        ('stop', 'stopping', VerbForm.ING),
        ('stop', 'stopped', VerbForm.PAST),
        ('drive', 'driving', VerbForm.ING),
        ('hurry', 'hurried', VerbForm.PAST),
        ('cross', 'crosses', VerbForm.THIRD),
        ('turn left', 'turns left', VerbForm.THIRD),
        ('fly', 'flown', VerbForm.PAST),
        ('put', 'put', VerbForm.PAST),
    ],
)
def test_verb_forms(verb: str, form: str, kind: VerbForm) -> None:
    irregular = {'fly': ['flies', 'flew', 'flown', 'flying'], 'put': ['puts', 'putting']}
    assert (form, kind) in verb_forms(verb, irregular)
