# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The arithmetic of `ros2 topic hz` and `ros2 topic bw`."""

from __future__ import annotations

from aurora_ros2cli.topic.bandwidth import BandwidthMeter
from aurora_ros2cli.topic.rate import RateMeter

MS = 1_000_000


def test_rate_and_spread_of_an_uneven_beat() -> None:
    meter = RateMeter(window=100)
    now_ns = 5 * MS
    reports = []
    for number in range(25):
        meter.arrived(now_ns)
        reports.append(meter.report())
        now_ns += (40 if number % 2 else 60) * MS

    said = [report for report in reports if report is not None]
    assert said == ['average rate: 19.811\n\tmin: 0.040s max: 0.060s std dev: 0.00999s window: 21']


def test_the_window_forgets() -> None:
    meter = RateMeter(window=2)
    times_ms = [0, 1000, 1010, 2020, 2030]
    reports = []
    for time_ms in times_ms:
        meter.arrived(time_ms * MS)
        reports.append(meter.report())

    assert reports[:3] == [None, None, None]
    assert str(reports[3]).endswith('window: 2')


def test_a_clock_that_goes_back_starts_anew() -> None:
    meter = RateMeter(window=10)
    for time_ms in (5000, 6000, 7500, 0):
        meter.arrived(time_ms * MS)
    assert meter.report() is None

    for time_ms in (100, 1300, 2600):
        meter.arrived(time_ms * MS)
        last = meter.report()
    assert str(last).startswith('average rate: 1.154\n')


def test_bandwidth_is_what_came_since_the_first_message_that_counts() -> None:
    meter = BandwidthMeter(window=3)
    for second, size in enumerate((9000, 1000, 2000, 3000)):
        meter.arrived(second * 1000 * MS, size)
        if second == 0:
            assert meter.report(500 * MS) is None

    # The first one is out of the window: 6000 bytes from 1 s to 4 s.
    said = '2.00 KB/s from 3 messages\n\tMessage size mean: 2.00 KB min: 1.00 KB max: 3.00 KB'
    assert meter.report(4000 * MS) == said
    assert str(meter.report(40_000 * MS)).startswith('154 B/s from 3')
    assert meter.report(0) is None
    assert meter.report(5000 * MS) is None
