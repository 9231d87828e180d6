# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Run-time faults for tests: applied between the executor and the simulators.

The executor does not know of them, feasibility and monitor cannot see them; they are recorded as
scenario events and in the report.
"""

from __future__ import annotations

from typing import Literal

from pydantic import FiniteFloat

from aurora_core.spec.parameter import Document


class Fault(Document):
    """One injected fault.

    Attributes:
        kind: `target_removed`: a ground agent is taken out of the simulation.
            `route_blocked`: a ground agent or a UAV cannot get further from `at_s` on.
            `link_loss`: the link loses each transmission with probability `value`.
            `keep_away`: a ground agent never gets faster than the agent it should reach.
        subject: Agent, UAV or link id; `*` = every link.
        at_s: Simulated time from which it acts.
        value: See `kind`; for `keep_away` the speed in m/s that the agent is held at.
    """

    kind: Literal['target_removed', 'route_blocked', 'link_loss', 'keep_away']
    subject: str
    at_s: FiniteFloat = 0.0
    value: FiniteFloat | None = None
