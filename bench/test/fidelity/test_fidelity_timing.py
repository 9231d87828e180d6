# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Times are told as they were measured; no prompt, no figure."""

from __future__ import annotations

import pytest

from aurora_bench.fidelity.timing import seconds_per_prompt, timing_table


def test_the_figures_of_known_times() -> None:
    told = seconds_per_prompt([0.010, 0.020, 0.030, 0.040])
    assert told == pytest.approx({'mean': 0.025, 'median': 0.025, 'p95': 0.0385, 'max': 0.040})
    assert timing_table([0.010, 0.030]).rows[-1] == ('max', pytest.approx(30.0))


def test_no_prompt_no_figure() -> None:
    assert seconds_per_prompt([]) == {}
    assert timing_table([]).rows == ()
