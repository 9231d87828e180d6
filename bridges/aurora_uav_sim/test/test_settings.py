# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The parameter table."""

from __future__ import annotations

import pytest

from aurora_uav_sim.settings import (
    PARAMETERS,
    AutopilotSettings,
    get_parameter,
    restore_defaults,
    set_parameter,
)


def test_rows_are_sorted_named_and_default_inside_their_range() -> None:
    settings = AutopilotSettings()
    names = [row.name for row in PARAMETERS]
    assert names == sorted(names)
    for row in PARAMETERS:
        # MAVLink's param_id has 16 bytes.
        assert len(row.name) <= 16
        assert row.low <= get_parameter(settings, row) <= row.high


@pytest.mark.parametrize('row', PARAMETERS, ids=lambda row: str(row.name))
def test_out_of_range_changes_nothing(row: object) -> None:
    parameter = next(p for p in PARAMETERS if p is row)
    settings = AutopilotSettings()
    for bad in (float('nan'), float('inf'), parameter.low - 1.0, parameter.high + 1.0):
        assert not set_parameter(settings, parameter, bad)
    assert settings == AutopilotSettings()
    assert set_parameter(settings, parameter, parameter.high)
    assert get_parameter(settings, parameter) == parameter.high
    restore_defaults(settings)
    assert settings == AutopilotSettings()
