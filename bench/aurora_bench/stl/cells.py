# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What is measured: formulas, windows and trace lengths. Standard library only (see worker.py)."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


class Kind(StrEnum):
    """A formula; w is the window of a cell, in samples."""

    ALWAYS = 'always'
    EVENTUALLY = 'eventually'
    UNTIL = 'until'
    NESTED = 'nested'
    ALWAYS_END = 'always to the end'
    UNTIL_END = 'until to the end'


# Of F, G and U; each tool has its own words for them.
SHAPES = {
    Kind.ALWAYS: 'G[0,w] x',
    Kind.EVENTUALLY: 'F[0,w] x',
    Kind.UNTIL: 'x U[w/5,2w] y',
    Kind.NESTED: 'F[0,2w] G[0,w] x',
    Kind.ALWAYS_END: 'G x',
    Kind.UNTIL_END: 'x U y',
}
_ENDLESS = (Kind.ALWAYS_END, Kind.UNTIL_END)


@dataclass(frozen=True, kw_only=True, order=True)
class Cell:
    """One measurement.

    Attributes:
        kind: Formula.
        samples: Length of the trace.
        window: w; 0 for formulas without a window.
    """

    kind: Kind
    samples: int
    window: int = 0

    @property
    def until(self) -> tuple[int, int]:
        """Interval of the witness."""
        return self.window // 5, 2 * self.window

    @property
    def reach(self) -> int:
        """How many samples ahead the formula looks, as far as that is bounded."""
        far = {Kind.UNTIL: 2, Kind.NESTED: 3}
        return self.window * far.get(self.kind, 1)

    def text(self) -> str:
        """Return the formula as most tools write it, with both predicates compared with 0."""
        x, y = '(x >= 0)', '(y >= 0)'
        w, (low, high) = self.window, self.until
        return {
            Kind.ALWAYS: f'G[0,{w}]{x}',
            Kind.EVENTUALLY: f'F[0,{w}]{x}',
            Kind.UNTIL: f'{x} U[{low},{high}] {y}',
            Kind.NESTED: f'F[0,{2 * w}](G[0,{w}]{x})',
            Kind.ALWAYS_END: f'G {x}',
            Kind.UNTIL_END: f'{x} U {y}',
        }[self.kind]


GOAL_SAMPLES, GOAL_WINDOW = 10_000, 100
LENGTHS = (1_000, 10_000, 100_000, 1_000_000)
_MORE_WINDOWS = {10_000: (10, 1_000), 1_000_000: (10, 1_000, 10_000, 100_000)}


def all_cells(longest: int) -> list[Cell]:
    """Return the cells, cheap ones first: every length with w = 100, two lengths with others."""
    found = []
    for kind in Kind:
        for samples in LENGTHS:
            if kind in _ENDLESS:
                found.append(Cell(kind=kind, samples=samples))
                continue
            more = _MORE_WINDOWS.get(samples, ()) if kind is not Kind.EVENTUALLY else ()
            found += [
                Cell(kind=kind, samples=samples, window=window)
                for window in sorted((GOAL_WINDOW, *more))
            ]
    return [cell for cell in found if cell.samples <= longest]
