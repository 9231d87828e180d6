# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What is said of the cases of the families, worked out once in a process."""

from __future__ import annotations

from aurora_bench.feasibility.families import Case
from aurora_bench.feasibility.judge import Judged, judged
from aurora_core.pipeline.knowledge import Knowledge

_SAID: dict[tuple[str, str, str], Judged] = {}


def judged_once(known: Knowledge, map_name: str, case: Case) -> Judged:
    """Return what `judged` says of a case of the families, which a test must not alter."""
    key = map_name, case.source, case.id
    if key not in _SAID:
        _SAID[key] = judged(known, map_name, case)
    return _SAID[key]
