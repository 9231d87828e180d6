# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`FeasibilityVerdict`: feasible, infeasible with a certificate, or unknown."""

from __future__ import annotations

from enum import StrEnum

from pydantic import FiniteFloat

from aurora_core.document import Document, omitted
from aurora_core.spec.parameter import Span


class Feasibility(StrEnum):
    """`unknown` goes on to execution, flagged; `infeasible` needs a certificate."""

    FEASIBLE = 'feasible'
    INFEASIBLE = 'infeasible'
    UNKNOWN = 'unknown'


class Rule(StrEnum):
    """What a certificate argues with; separate code has one derivation for each."""

    LIMIT = 'limit'  # a stated number beyond a limit
    COUNT = 'count'  # more agents or UAVs than possible
    SIGN = 'sign'  # a stated number below zero, or a zero that leaves nothing to fly
    SENSING = 'sensing'  # a flight farther from its target than the camera reaches
    RADIO = 'radio'  # flights that keep sender and receiver out of a stated range
    CLOSENESS = 'closeness'  # a condition that asks for less than the separation
    STACKING = 'stacking'  # a flight over another with less than the separation
    FLIGHT_BAND = 'flight_band'  # a condition that a stated flight cannot meet
    PURSUIT = 'pursuit'  # a target faster than UAVs fly
    AFAR = 'afar'  # a tracked target that is to stay farther away than a standoff may be
    BATTERY = 'battery'  # phases that last longer together than the battery
    DEADLINE = 'deadline'  # earlier than anything can be done
    HORIZON = 'horizon'  # what does not fit into the stated duration
    ORDER = 'order'  # a circle of orders, or an order against stated times
    PLACEMENT = 'placement'  # one pair on two sides or at two distances
    ZONE = 'zone'  # a flight at a landmark inside a no-fly zone


class FactSource(StrEnum):
    """Where a fact is read."""

    REQUEST = 'request'
    LIMITS = 'limits'
    TOLERANCES = 'tolerances'
    MAP = 'map'


class Fact(Document):
    """One thing that a proof rests on.

    Attributes:
        source: Specification, `limits.json`, `tolerances.json` or `zones.geojson` of the map.
        path: `missions/m1/altitude_m`, `sensing_range_m/fog`, `nofly_helipad/floor_m`, ...
        value: What stands there; a stated number by its value, in the unit of its name.
    """

    source: FactSource
    path: str
    value: FiniteFloat | str


class Certificate(Document):
    """Proof of infeasibility that separate code can check again.

    Attributes:
        kind: limit_exceeded, missing_element, unsupported, contradiction or
            geometric_contradiction (a stated flight against the map).
        reason: `because` of the contract (altitude_limit, comm_range, ...).
        path: Element or parameter of the specification.
        requested: Stated value (SI), when the proof is about a number.
        limit_name: Name in limits.json.
        limit: Its value.
        nearest: Nearest feasible value.
        listing: Closed list that lacks the element (missing_element, unsupported).
        rule: How it argues; None for what a closed list lacks.
        facts: What it rests on beside `requested`, `limit` and `listing`.
    """

    kind: str
    reason: str
    path: str
    requested: FiniteFloat | None = None
    unit: str = ''
    limit_name: str = ''
    limit: FiniteFloat | None = None
    nearest: FiniteFloat | None = None
    word: str = ''
    listing: tuple[str, ...] = ()
    span: Span | None = None
    sentence: str
    rule: Rule | None = omitted(None)
    facts: tuple[Fact, ...] = omitted(())


class FeasibilityVerdict(Document):
    """Outcome of the check."""

    result: Feasibility
    certificates: tuple[Certificate, ...] = ()
    notes: tuple[str, ...] = ()
