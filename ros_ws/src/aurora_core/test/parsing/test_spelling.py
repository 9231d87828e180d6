# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One slip is mended, two meanings or another word are not."""

from __future__ import annotations

import pytest

from aurora_core.parsing.spelling import Speller

_SPELLER = Speller(
    [
        'motorcycle',
        'intersection',
        'follow',
        'truck',
        'track',
        'delivery',
        'block',
        'van',
        'rectangle',
        'length',
        'hover',
        'drone',
    ],
    ['drone'],
)


@pytest.mark.parametrize(
    ('written', 'meant'),
    [
        ('motercycle', 'motorcycle'),
        ('intersecton', 'intersection'),
        ('folllow', 'follow'),
        ('interesction', 'intersection'),
        ('motorcycl', 'motorcycle'),
        ('rectangel', 'rectangle'),
        ('lenght', 'length'),
        ('hovr', 'hover'),
        ('rdone', 'drone'),
    ],
)
def test_one_slip(written: str, meant: str) -> None:
    assert _SPELLER.correct(written) == meant


@pytest.mark.parametrize(
    'written',
    [
        'trxck',  # truck or track
        'blocks',  # another form of a word is another word
        'delivers',
        'vam',  # too short to tell
        'notorcycle',  # another first letter
        'motrcycel',  # two slips
        'v2xlink',
    ],
)
def test_left_alone(written: str) -> None:
    assert _SPELLER.correct(written) is None
