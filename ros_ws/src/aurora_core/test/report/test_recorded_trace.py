# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A bag that was rewritten as a whole is found by the hash that the run reported."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from aurora_core.report.recorded_trace import believed, recorded_trace
from aurora_core.report.run_report import TraceReport
from aurora_core.trace.roster import Roster
from aurora_core.trace.trace import Integrity, Trace

TRACE = Trace(
    roster=Roster(dt_s=0.05, agents=(), uavs=()),
    ground=np.zeros((1, 0, 7)),
    uav=np.zeros((1, 0, 16)),
    uav_commands=np.zeros((1, 0, 10)),
    ground_commands=((),),
)
REPORTED = TraceReport(bag='bag.0', ticks=1, sha256='ab' * 32, integrity=Integrity.INTACT)


def test_the_reported_trace_is_believed_and_another_is_altered() -> None:
    assert believed(TRACE, 'ab' * 32, REPORTED) is TRACE
    assert believed(TRACE, 'cd' * 32, None) is TRACE
    other = believed(TRACE, 'cd' * 32, REPORTED)
    assert other.integrity is Integrity.ALTERED
    assert 'abababababab' in other.integrity_note


def test_a_bag_that_is_damaged_already_keeps_its_name() -> None:
    cut = replace(TRACE, integrity=Integrity.TRUNCATED, integrity_note='cut')
    assert believed(cut, 'cd' * 32, REPORTED) is cut


@pytest.mark.parametrize('text', [None, '', '{}', '[1]'])
def test_without_a_report_there_is_nothing_to_compare_with(
    tmp_path: Path, text: str | None
) -> None:
    if text is not None:
        (tmp_path / 'report.json').write_text(text)
    assert recorded_trace(tmp_path, 'bag.0') is None
