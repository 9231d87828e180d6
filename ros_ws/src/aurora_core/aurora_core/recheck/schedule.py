# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Proofs by time: phases that outlast the battery, and bounds that exclude each other."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from types import MappingProxyType

from aurora_core.outcomes.feasibility import (
    BoundKind,
    Certificate,
    Rule,
    TimeBound,
)
from aurora_core.recheck.finding import Step
from aurora_core.recheck.request import Request, stated
from aurora_core.recheck.times import Derived, derived

_Key = tuple[BoundKind, str, str, str]

# What a proof by a rule has to be about.
_ABOUT: Mapping[Rule, frozenset[BoundKind]] = MappingProxyType(
    {
        Rule.BATTERY: frozenset({BoundKind.BATTERY}),
        Rule.DEADLINE: frozenset({BoundKind.DEADLINE, BoundKind.ALOFT}),
        Rule.HORIZON: frozenset({BoundKind.INSIDE}),
        Rule.ORDER: frozenset({BoundKind.ORDER, BoundKind.CAUSE, BoundKind.MESSAGE}),
    }
)
# What comes before something else, by however little: a circle of it takes no time at all.
_STRICT = frozenset({BoundKind.ORDER, BoundKind.CAUSE, BoundKind.MESSAGE})
# Rounding of sums of floating point numbers (s).
_EXACT_S = 1e-9
# By how much something comes before something else at least (s): not by nothing.
_BEFORE_S = 1e-6


def battery(proof: Certificate, request: Request) -> list[Step]:
    """The stated phases of a UAV last longer together than its battery, or its flight does."""
    if proof.chain:
        return times(proof, request)
    kind, _, uav = proof.path.partition('/')
    own = [m for m in request.all('missions') if m['uav'] == uav]
    phases = [m['duration_s'] for m in own if stated(m.get('duration_s'))]
    # "at most 700 s" may be nothing at all.
    total = sum(float(p['value']) for p in phases if p.get('bound') != 'at_most')
    most = request.limit('uav_endurance_s')
    return [
        (kind == 'uavs' and bool(phases), f'{proof.path} has stated phases'),
        (proof.limit == most, f'{proof.limit_name} is {most:g}'),
        (proof.requested in [p['value'] for p in phases], f'{proof.requested} is a phase of it'),
        (total > most, f'they last {total:g} s together, {most:g} s are possible'),
    ]


def times(proof: Certificate, request: Request) -> list[Step]:
    """Bounds in a circle: each is derived again, and together they exclude each other."""
    if not proof.chain:
        return [(None, 'it names no bounds: an older version proved otherwise')]
    about = _ABOUT.get(proof.rule) if proof.rule is not None else None
    named = any(b.of == proof.path and b.kind in (about or ()) for b in proof.chain)
    known: dict[_Key, list[Derived]] = {}
    for bound in derived(request):
        known.setdefault(_key(bound), []).append(bound)
    return [
        (named, f'the bounds are about {proof.path}'),
        *(_follows(bound, known) for bound in proof.chain),
        *_circle(proof.chain),
    ]


def excluded(request: Request) -> bool:
    """Whether the bounds of a request exclude each other, by the longest ways between them."""
    ways: dict[tuple[str, str], float] = {}
    for bound in derived(request):
        least = bound.least_s + (_BEFORE_S if bound.kind in _STRICT else 0.0)
        for way, length in (
            ((bound.earlier, bound.later), least),
            ((bound.later, bound.earlier), -bound.most_s),
        ):
            ways[way] = max(ways.get(way, -math.inf), length)
    earliest = dict.fromkeys((point for way in ways for point in way), 0.0)
    for _ in range(len(earliest) + 1):
        late = [(b, earliest[a] + length) for (a, b), length in ways.items()
                if earliest[a] + length > earliest[b] + _EXACT_S]  # fmt: skip
        if not late:
            return False
        for point, time_s in late:
            earliest[point] = max(earliest[point], time_s)
    return True


def derived_anew(proof: Certificate, request: Request) -> Certificate:
    """Return a proof with its bounds as another request has them, as tight as they are there."""
    bounds = list(derived(request))

    def anew(bound: TimeBound) -> TimeBound:
        mine = [b for b in bounds if _key(b) == _key(bound)]
        if not mine:
            return bound
        if bound.least_s is not None:
            return bound.model_copy(update={'least_s': max(b.least_s for b in mine)})
        return bound.model_copy(update={'most_s': min(b.most_s for b in mine)})

    return proof.model_copy(update={'chain': tuple(anew(b) for b in proof.chain)})


def _key(bound: TimeBound | Derived) -> _Key:
    return bound.kind, bound.of, bound.earlier, bound.later


def _follows(bound: TimeBound, known: Mapping[_Key, Sequence[Derived]]) -> Step:
    """One bound follows from the specification, and is not tighter than it may be."""
    least, most = bound.least_s, bound.most_s
    mine = known.get(_key(bound), ())
    holds = any(
        (least is None or least <= k.least_s + _EXACT_S)
        and (most is None or most >= k.most_s - _EXACT_S)
        for k in mine
    )
    size = f'at least {least:.3f} s' if least is not None else f'at most {most:.3f} s'
    return holds, f'{bound.later} comes {size} after {bound.earlier} ({bound.kind} of {bound.of})'


def _circle(chain: Sequence[TimeBound]) -> list[Step]:
    """A least bound leads from its earlier to its later point, a greatest one back."""
    ways = [(b.earlier, b.later) if b.most_s is None else (b.later, b.earlier) for b in chain]
    turned = [*ways[1:], ways[0]]
    closed = all(a[1] == b[0] for a, b in zip(ways, turned, strict=True))
    needed = sum(b.least_s for b in chain if b.least_s is not None)
    left = [b.most_s for b in chain if b.most_s is not None]
    if left:
        apart = needed - sum(left) > _EXACT_S * len(chain)
        text = f'{needed:.3f} s are needed at least, {sum(left):.3f} s are left at most'
    else:
        apart = needed > 0.0 or any(b.kind in _STRICT for b in chain)
        text = f'{chain[0].of} has to come before itself'
    return [(closed, 'each bound begins where the one before ends'), (apart, text)]
