# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import io
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from PIL import Image

from aurora_core.report.picture.video import gif_bytes, messages_of
from aurora_core.report.scene.story import Moment, Tone
from aurora_core.report.scene.tracks import tracks_of
from aurora_core.trace.layout import UavColumn
from aurora_core.trace.records import LinkEventKind, LinkRecord, LossReason


def test_the_bodies_move_and_the_time_is_right(make: SimpleNamespace) -> None:
    trace = make.trace()
    film: Any = Image.open(io.BytesIO(gif_bytes(trace, make.world())))
    assert film.n_frames > 10
    frames = []
    shown_s = 0.0
    for k in range(film.n_frames):
        film.seek(k)
        shown_s += film.info['duration'] / 1000.0
        frames.append(np.asarray(film.convert('RGB')).astype(int))
    assert shown_s * 4.0 == pytest.approx(trace.ticks * trace.roster.dt_s, rel=0.05)
    moved = np.abs(frames[0] - frames[len(frames) // 2]).sum(axis=2) > 60
    # Something moves, the ground does not.
    assert 20 < moved.sum() < 0.1 * moved.size


def test_the_same_run_gives_the_same_bytes(make: SimpleNamespace) -> None:
    assert gif_bytes(make.trace(), make.world()) == gif_bytes(make.trace(), make.world())


def _frames(data: bytes) -> list[Any]:
    film: Any = Image.open(io.BytesIO(data))
    frames = []
    for k in range(film.n_frames):
        film.seek(k)
        frames.append(np.asarray(film.convert('RGB')).astype(int))
    return frames


def test_what_happens_is_told_while_it_happens(make: SimpleNamespace) -> None:
    trace, world = make.trace(), make.world()
    moment = Moment(tick=200, text='motorcycle1 within 20 m of uav1', tone=Tone.EVENT)
    plain, told = (_frames(gif_bytes(trace, world, m)) for m in ((), (moment,)))
    differs = [
        bool((np.abs(a - b).sum(axis=2) > 200).any()) for a, b in zip(plain, told, strict=True)
    ]
    per_frame = trace.ticks / len(plain)
    first = differs.index(True) * per_frame
    assert first == pytest.approx(200, abs=3 * per_frame)
    # And not for ever.
    assert sum(differs) * per_frame * trace.roster.dt_s == pytest.approx(6.0, abs=0.5)


def test_it_ends_with_the_flight(make: SimpleNamespace) -> None:
    trace = make.trace()
    more = {
        name: np.concatenate([value, np.repeat(value[-1:], 2000, axis=0)])
        for name in ('ground', 'ground_commands', 'uav', 'uav_commands')
        for value in [getattr(trace, name)]
    }
    film: Any = Image.open(io.BytesIO(gif_bytes(replace(trace, **more), make.world())))
    shown_s = film.n_frames * film.info['duration'] / 1000.0 * 4.0
    assert shown_s == pytest.approx(trace.ticks * trace.roster.dt_s, rel=0.1)


def test_a_message_joins_those_who_speak(make: SimpleNamespace) -> None:
    trace = make.trace()
    sent = LinkRecord(
        tick=100, sequence=0, message=7, link='l1', event='e1', sender='uav1',
        receiver='motorcycle1', kind=LinkEventKind.SENT, attempt=0, reason=LossReason.NONE,
        distance_m=20.0, line_of_sight=True,
    )  # fmt: skip
    (message,) = messages_of(replace(trace, links=(sent,)), tracks_of(trace))
    assert (message.first, message.last, message.arrived) == (100, 140, False)
    trace.uav[:, 0, UavColumn.Y] += 30.0
    with_it = _frames(gif_bytes(replace(trace, links=(sent,)), make.world()))
    red = [int((np.abs(f - (181, 27, 27)).sum(axis=2) < 40).sum()) for f in with_it]
    per_frame = trace.ticks / len(with_it)
    assert red[round(120 / per_frame)] > red[round(60 / per_frame)] + 20
