# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Ids for what completion adds to a request."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count

from aurora_core.spec.scenario import ScenarioSpec


def free_ids(spec: ScenarioSpec, prefix: str) -> Iterator[str]:
    """Yield the ids `prefix1`, `prefix2` … that nothing in a request has."""
    parts = (
        *spec.agents, *spec.uavs, *spec.missions, *spec.links, *spec.events, *spec.conditions,
        *spec.orders, *spec.prohibitions,
    )  # fmt: skip
    taken = {part.id for part in parts}
    return (name for k in count(1) if (name := f'{prefix}{k}') not in taken)
