# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Commands to ground agents as frozen values (UAV commands are packed rows, see `layout`)."""

from __future__ import annotations

from dataclasses import dataclass

from aurora_core.trace.layout import GroundCommandKind


@dataclass(frozen=True, slots=True, kw_only=True)
class GroundCommand:
    """One command to one ground agent (index in roster order); see `GroundCommandKind`."""

    agent: int
    kind: GroundCommandKind
    value: float = 0.0
    value2: float = 0.0
    text: str = ''
