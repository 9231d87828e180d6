# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether what is told to be the nearest value that can be is that.

With it the argument of the proof fails, and one step nearer to the stated value it still holds,
both without the tolerances of what is flown: nobody wants to be told a value that only they allow.
"""

from __future__ import annotations

import copy
from collections.abc import Callable
from functools import partial
from typing import Any, Protocol

from aurora_core.outcomes.feasibility import Certificate, Mend
from aurora_core.recheck.finding import Step
from aurora_core.recheck.request import Request, node_at, stated


class _Argument(Protocol):
    """Tells whether the argument of a proof holds for a request."""

    def __call__(self, proof: Certificate, spec: dict[str, Any] | None, *, by_any: bool) -> bool:
        """`by_any`: bounds on times that exclude each other may be others than those told."""


_STEPS = {'1': 0.01, 'deg': 1.0}
_STEP = 0.1
_COUNTED = ('waypoint_count', 'retransmissions', 'turns')
# Longer than anything lasts (s).
_FAR = 1e6
_ELEMENTS = ('uavs', 'agents')


def exact(request: Request) -> Request:
    """Let stated heights, distances and durations be met as stated ("about" still widens them)."""
    for name in ('altitude_m', 'standoff_m', 'duration_s'):
        request.tolerances[name] = {'absolute': 0.0, 'relative': 0.0}
    request.tolerances['pattern_centre_m'] = 0.0
    request.limits['tracking_horizontal_m'] = 0.0
    return request


def mends_hold(proof: Certificate, spec: dict[str, Any] | None, holds: _Argument) -> list[Step]:
    """Check every value that is told to be possible."""
    return [step for mend in proof.mends for step in _steps(proof, spec, mend, holds)]


def _steps(
    proof: Certificate, spec: dict[str, Any] | None, mend: Mend, holds: _Argument
) -> list[Step]:
    told = f'{mend.nearest:g} {mend.unit} instead of {mend.requested:g} at {mend.path}'
    if mend.path in _ELEMENTS:
        right = (mend.nearest, mend.requested) == (proof.limit, proof.requested)
        return [(right, told)]
    number = None if spec is None else node_at(spec, mend.path)
    known = spec is None or (stated(number) and number['value'] == mend.requested)
    parts = mend.path.split('/')
    whole = parts[0] == 'counts' or parts[-1] in _COUNTED
    step = 1.0 if whole else _STEPS.get(mend.unit, _STEP)
    back = mend.nearest + (step if mend.requested > mend.nearest else -step)
    if abs(mend.requested - mend.nearest) <= step:
        back = mend.requested
    exactly, by_any = partial(holds, by_any=False), partial(holds, by_any=True)
    free = not _at(proof, spec, mend, mend.nearest, exactly)
    if free and mend.unit == 's' and not proof.chain:
        # A phase as long as the battery lasts leaves no time to climb; other bounds on times may
        # exclude each other whatever this number is.
        far = 0.0 if mend.requested > mend.nearest else _FAR
        other = _at(proof, spec, mend, far, by_any)
        free = other or not _at(proof, spec, mend, mend.nearest, by_any)
    # Bounds that exclude each other with the nearest value, too, say nothing about the one before.
    barred = _at(proof, spec, mend, round(back, 2), exactly) or (
        _at(proof, spec, mend, round(back, 2), by_any)
        and not _at(proof, spec, mend, mend.nearest, by_any)
    )
    return [
        (known, f'{mend.requested:g} is stated at {mend.path}'),
        (free, f'{told} can be'),
        (barred, f'{back:g} {mend.unit} cannot'),
    ]


def _at(
    proof: Certificate,
    spec: dict[str, Any] | None,
    mend: Mend,
    value: float,
    holds: Callable[[Certificate, dict[str, Any] | None], bool],
) -> bool:
    """Whether an argument holds with another value."""
    changed = copy.deepcopy(spec)
    if changed is not None:
        number = node_at(changed, mend.path)
        if not isinstance(number, dict):
            return False
        number['value'] = value
    # The limit of a proof may be a stated number itself: the range of a link.
    is_limit = mend.path.rpartition('/')[2] == proof.limit_name and proof.limit == mend.requested
    same = proof.model_copy(update={'limit': value} if is_limit else {})
    # The number may be the one that the proof is about, or another one that is as great.
    other = same.model_copy(update={'requested': value})
    about = [] if spec is None else [same]
    about += [other] if proof.requested == mend.requested else []
    return any(holds(p, changed) for p in about)
