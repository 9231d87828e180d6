# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Run-time faults for tests: applied between the executor and the simulators.

The executor does not know of them, feasibility and monitor cannot see them; they are recorded as
scenario events and in the report.
"""

from __future__ import annotations

import json
from typing import Annotated, Literal, Self

from pydantic import Field, FiniteFloat, ValidationError, model_validator

from aurora_core.document import Document
from aurora_core.errors import ExecutionError

# Two numbers as JSON are never longer.
_LONGEST = 100


class Fault(Document):
    """One injected fault.

    Attributes:
        kind: `target_removed`: a ground agent is taken out of the simulation.
            `route_blocked`: a ground agent or a UAV cannot get further from `at_s` on.
            `link_loss`: the link loses each transmission with probability `value`.
            `keep_away`: a ground agent never gets faster than `value`, so that it cannot catch up.
        subject: Agent, UAV or link id; `*` = every link.
        at_s: Simulated time from which it acts.
        value: `link_loss`: probability, 1 when not given; `keep_away`: speed in m/s, 3 when not
            given.
    """

    kind: Literal['target_removed', 'route_blocked', 'link_loss', 'keep_away']
    subject: str
    at_s: Annotated[FiniteFloat, Field(ge=0.0)] = 0.0
    value: Annotated[FiniteFloat, Field(ge=0.0)] | None = None

    @model_validator(mode='after')
    def _value_fits(self) -> Self:
        if self.kind == 'link_loss' and self.value is not None and self.value > 1.0:
            raise ValueError(f'value of link_loss is a probability, found {self.value}')
        return self

    def told(self) -> str:
        """Return the detail of its scenario event: the kind, and all else that it does."""
        values = json.dumps({'at_s': self.at_s, 'value': self.value}, separators=(',', ':'))
        return f'{self.kind} {values}'


def read_fault(subject: str, detail: str) -> Fault:
    """Return the fault that a recorded scenario event announces.

    Args:
        subject: Of the event.
        detail: As `Fault.told` wrote it.

    Raises:
        ExecutionError: It announces none.
    """
    kind, _, values = detail.partition(' ')
    try:
        if len(values) > _LONGEST:
            raise ValueError('too long')
        return Fault.model_validate({**json.loads(values), 'kind': kind, 'subject': subject})
    except (ValidationError, ValueError, TypeError) as err:
        raise ExecutionError(
            f'the record announces no fault that can be injected: {detail[:_LONGEST]!r}',
            hint='run the scenario again',
        ) from err


def in_order(faults: tuple[Fault, ...]) -> tuple[Fault, ...]:
    """Return faults in the order in which they act, which is also that of their records.

    Of two that hit the same the later one counts.
    """
    return tuple(sorted(faults, key=lambda fault: fault.at_s))
