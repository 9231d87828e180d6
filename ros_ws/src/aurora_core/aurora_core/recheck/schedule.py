# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Proofs by time: phases that outlast the battery, and bounds that exclude each other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from aurora_core.outcomes.feasibility import (
    BoundKind,
    Certificate,
    FactSource,
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
        Rule.DEADLINE: frozenset({BoundKind.DEADLINE}),
        Rule.HORIZON: frozenset({BoundKind.INSIDE}),
        Rule.ORDER: frozenset({BoundKind.ORDER, BoundKind.CAUSE, BoundKind.MESSAGE}),
    }
)
# What comes before something else, by however little: a circle of it takes no time at all.
_STRICT = frozenset({BoundKind.ORDER, BoundKind.CAUSE, BoundKind.MESSAGE})
# Rounding of sums of floating point numbers (s).
_EXACT_S = 1e-9
# The greatest share of a stated time by which it may be missed.
_MISSED = 0.10
# What can be is told to so much.
_TOLD_S = 0.1 + 1e-6


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
        key = bound.kind, bound.of, bound.earlier, bound.later
        known.setdefault(key, []).append(bound)
    return [
        (named, f'the bounds are about {proof.path}'),
        *(_follows(bound, known) for bound in proof.chain),
        *_circle(proof.chain),
        *_mended(proof),
    ]


def _mended(proof: Certificate) -> list[Step]:
    """A stated time is named with the nearest one that the bounds leave room for."""
    if proof.requested is None and proof.nearest is None:
        return []
    needed = sum(b.least_s for b in proof.chain if b.least_s is not None)
    missing = needed - sum(b.most_s for b in proof.chain if b.most_s is not None)
    asked, nearest = proof.requested, proof.nearest
    times = [f.value for f in proof.facts if f.source is FactSource.REQUEST]
    if asked is None or nearest is None or asked not in times:
        return [(False, f'{asked} is a stated time, {nearest} the nearest that can be')]
    # A phase has to be shorter, a deadline or a duration longer; told in tenths of a second.
    shorter = proof.rule is Rule.BATTERY
    more = asked - nearest if shorter else nearest - asked
    # What a phase may be missed by shrinks with it.
    most = missing / (1.0 - _MISSED) if shorter else missing
    close = missing - _EXACT_S * len(proof.chain) <= more <= most + _TOLD_S
    return [(close, f'{nearest:g} s instead of {asked:g} s make up for {missing:.3f} s')]


def _follows(bound: TimeBound, known: Mapping[_Key, Sequence[Derived]]) -> Step:
    """One bound follows from the specification, and is not tighter than it may be."""
    least, most = bound.least_s, bound.most_s
    mine = known.get((bound.kind, bound.of, bound.earlier, bound.later), ())
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
