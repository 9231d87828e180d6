# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""When a number of a specification counts as the annotated one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from aurora_bench.prompts.format import Requirement
from aurora_core.spec.parameter import Parameter

# Of the annotated value, where the annotation gives no tolerance.
_RELATIVE = 0.01


@dataclass(frozen=True, kw_only=True)
class NumberRule:
    """Tolerances of one requirement: its `tol` and the prompt's `variation`."""

    requirement: Requirement
    variation: Mapping[str, tuple[float, float]]

    def counts(self, path: str, wanted: object, found: Parameter | float | None) -> bool:
        """Whether a found number is the wanted one.

        Args:
            path: Field inside the requirement, e.g. `altitude_m` or `trigger.value_m`.
            wanted: Annotated value; a range (an extension of the format) never counts.
            found: In the specification, same unit.
        """
        if found is None or not isinstance(wanted, int | float):
            return False
        value = found.value if isinstance(found, Parameter) else float(found)
        tol = self.requirement.tol
        if isinstance(tol, dict):
            tol = tol.get(path.split('.')[-1])
        slack = _RELATIVE * abs(wanted) if tol is None else tol
        if path.endswith('bearing_deg'):  # 350 and -10 degrees are one direction
            value = wanted + (value - wanted + 180.0) % 360.0 - 180.0
        # A wanted zero has no relative tolerance, and decimal fractions round.
        if abs(value - wanted) <= slack + 1e-9:
            return True
        low_high = self.variation.get(f'{self.requirement.id}.{path}')
        return low_high is not None and low_high[0] - 1e-9 <= value <= low_high[1] + 1e-9
