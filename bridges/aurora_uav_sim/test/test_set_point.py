# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Set-points off the wire."""

from __future__ import annotations

import math
from typing import Any

import pytest

from aurora_uav_sim.set_point import SetPointReader

NAN, INF = math.nan, math.inf
FULL = 0x9C0


def fields(**changes: Any) -> tuple[Any, ...]:
    values = {
        'time': 1, 'n': 2.0, 'e': 1.0, 'd': -3.0, 'vn': 5.0, 've': 4.0, 'vd': -6.0,
        'an': 0.0, 'ae': 0.0, 'ad': 0.0, 'yaw': 0.0, 'rate': 0.0, 'mask': FULL, 'system': 1,
        'component': 1, 'frame': 1,
    }  # fmt: skip
    values.update(changes)
    return tuple(values.values())


def test_ned_becomes_enu() -> None:
    target = SetPointReader().read(fields())
    assert target is not None
    assert (target.xy, target.z, target.vxy, target.vz) == ((1.0, 2.0), 3.0, (4.0, 5.0), 6.0)
    # North is a quarter turn from east.
    assert target.sin_cos_yaw == pytest.approx((1.0, 0.0), abs=1e-15)


@pytest.mark.parametrize('name', ['n', 'e', 'd', 'vn', 've', 'vd', 'yaw'])
@pytest.mark.parametrize('bad', [NAN, INF, -INF, 1e9])
def test_what_is_not_finite_or_absurd_is_refused(name: str, bad: float) -> None:
    assert SetPointReader().read(fields(**{name: bad})) is None


@pytest.mark.parametrize(
    ('mask', 'given'),
    [
        (0x9C0 | 0x38, ('xy', 'z', 'yaw')),
        (0x9C0 | 0x07, ('vxy', 'vz', 'yaw')),
        (0x9C0 | 0x400 | 0x38, ('xy', 'z')),
        (0x9C0 | 0x03 | 0x20, ('z', 'vxy', 'yaw')),
    ],
)
def test_parts_may_be_left_out(mask: int, given: tuple[str, ...]) -> None:
    target = SetPointReader().read(fields(mask=mask))
    assert target is not None
    names = ('xy', 'z', 'vxy', 'vz', 'yaw')
    assert tuple(n for n, v in zip(names, target, strict=True) if v is not None) == given


@pytest.mark.parametrize(
    'change',
    [
        {'frame': 8},
        {'mask': 0},
        {'mask': FULL | 0x200},
        {'mask': FULL | 0x3F},
        {'mask': FULL | 0x03 | 0x18},
    ],
)
def test_what_is_not_supported_is_refused(change: dict[str, int]) -> None:
    assert SetPointReader().read(fields(**change)) is None


def test_a_refused_yaw_is_not_remembered() -> None:
    reader = SetPointReader()
    assert reader.read(fields(yaw=NAN)) is None
    assert reader.read(fields(yaw=NAN)) is None
    assert reader.read(fields(yaw=1.0)) is not None
