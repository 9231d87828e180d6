# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from aurora_core.report.picture.placing import Placer, Rectangle


def _rectangle(centre: tuple[float, float], width: float, height: float) -> Rectangle:
    return Rectangle(
        left=centre[0] - width / 2, bottom=centre[1] - height / 2, width=width, height=height
    )


def test_labels_of_one_point_do_not_cover_each_other() -> None:
    placer = Placer(width=400.0, height=300.0)
    rooms = [_rectangle(placer.place(200.0, 150.0, 40.0, 12.0, 6.0), 40.0, 12.0) for _ in range(8)]
    overlaps = [
        a.overlap(b) for k, a in enumerate(rooms) for b in rooms[k + 1 :] if a.overlap(b) > 0.0
    ]
    assert overlaps == []


def test_labels_stay_inside_the_axes() -> None:
    placer = Placer(width=400.0, height=300.0)
    x, y = placer.place(399.0, 299.0, 60.0, 12.0, 6.0)
    assert x + 30.0 <= 400.0
    assert y + 6.0 <= 300.0


def test_labels_keep_off_what_is_reserved() -> None:
    placer = Placer(width=400.0, height=300.0)
    placer.keep_free([(220.0 + 4.0 * k, 162.0) for k in range(10)], 8.0)
    room = _rectangle(placer.place(200.0, 150.0, 40.0, 12.0, 6.0), 40.0, 12.0)
    assert all(room.overlap(other) == 0.0 for other in placer.taken[:10])


def test_touching_is_no_overlap() -> None:
    left = Rectangle(left=0.0, bottom=0.0, width=1.0, height=1.0)
    assert left.overlap(Rectangle(left=1.0, bottom=0.0, width=1.0, height=1.0)) == 0.0
    assert left.overlap(Rectangle(left=0.5, bottom=0.5, width=1.0, height=1.0)) == 0.25
