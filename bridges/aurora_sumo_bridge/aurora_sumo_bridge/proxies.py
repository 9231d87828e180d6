# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""UAVs in the ground world: points of interest, which SUMO shows and traffic ignores.

They are in no roster, state or count. SUMO's coordinates are those of the map frame.
"""

from __future__ import annotations

import libsumo

from aurora_core.ports.simulators import FloatArray
from aurora_core.trace.layout import UavColumn

KIND = 'uav'
_COLOUR = (230, 60, 30, 255)
# Above streets and vehicles.
_LAYER = 1000
_XY = slice(int(UavColumn.X), int(UavColumn.Y) + 1)

# Bound once, as it is called for every UAV in every tick.
_set_position = libsumo.poi.setPosition


def proxy_id(row: int) -> str:
    """Return the id of the point of the UAV in a row of the roster."""
    return f'{KIND}[{row}]'


class UavProxies:
    """The points of one run."""

    def __init__(self) -> None:
        self._ids: list[str] = []

    def show(self, rows: FloatArray) -> None:
        """Put each UAV's point below it.

        Args:
            rows: Packed states (M, UAV_WIDTH), roster order.
        """
        places = rows[:, _XY].tolist()
        for row in range(len(self._ids), len(places)):
            self._ids.append(proxy_id(row))
            libsumo.poi.add(self._ids[row], *places[row], _COLOUR, KIND, _LAYER)
        for name, (x_m, y_m) in zip(self._ids, places, strict=False):
            _set_position(name, x_m, y_m)
