# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`FeasibilityVerdict`: feasible, infeasible with a certificate, or unknown."""

from __future__ import annotations

from enum import StrEnum
from typing import Self

from pydantic import FiniteFloat, model_validator

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
    BATTERY = 'battery'  # phases, or a whole flight, longer than the battery lasts
    DEADLINE = 'deadline'  # earlier than anything can be done
    HORIZON = 'horizon'  # what does not fit into the stated duration
    ORDER = 'order'  # a circle of orders, or an order against stated times
    PLACEMENT = 'placement'  # one pair on two sides or at two distances
    ZONE = 'zone'  # a flight at a landmark inside a no-fly zone
    HIDDEN = 'hidden'  # a hover from which buildings hide what it watches, wherever it may be
    ROUND = 'round'  # an orbit that buildings cut, wherever it may be flown
    ROOF = 'roof'  # a hover at a landmark inside a building, or too near it
    WALL = 'wall'  # a clearance from a building under the limit, asked below its roof
    BOUNDS = 'bounds'  # conditions on one quantity without a common value
    STILL = 'still'  # a hover that is asked to be fast
    WATCH = 'watch'  # longer in sight, or without a break, than phases or scenario last
    LATENCY = 'latency'  # a message that is due before the latency of its link has passed
    SCENE = 'scene'  # a count of the whole scene that leaves out what is named


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


class BoundKind(StrEnum):
    """Why one time point comes so long after another one at least, or at most."""

    START = 'start'  # nothing comes before t = 0
    TIME = 'time'  # a trigger at a stated time
    CAUSE = 'cause'  # an event waits for the end of another one
    MESSAGE = 'message'  # a message is received after it was sent
    SIGHT = 'sight'  # a UAV looks out once it is up
    ALOFT = 'aloft'  # a UAV sends once it is up
    DONE = 'done'  # a UAV's missions are over
    DELAY = 'delay'  # what happens comes after its trigger, by a stated delay
    SOON = 'soon'  # and within the time that tolerances leave
    END = 'end'  # what happens ends after it began
    BEGUN = 'begun'  # a mission that an event begins
    CLIMB = 'climb'  # from the ground to an altitude
    SEQUENCE = 'sequence'  # missions of one UAV, after its ascent, in their order
    PHASE = 'phase'  # the stated duration of a mission
    ROUTE = 'route'  # the way along a stated pattern
    WAY = 'way'  # the way to where a mission begins
    SINK = 'sink'  # from an altitude to the ground
    BATTERY = 'battery'  # from take-off to touchdown
    ORDER = 'order'  # what is asked to come later, and within which time
    DEADLINE = 'deadline'  # a stated condition on a time
    HORIZON = 'horizon'  # the stated duration of the scenario
    INSIDE = 'inside'  # what has to happen before the scenario ends


class TimeBound(Document):
    """One bound of a chain: either a least or a greatest value.

    Attributes:
        earlier: Time point: `start`, `end`, `events/e1` (with `/trigger` before and `/done` after
            it), `uavs/u1/takeoff`, `/up`, `/landed`, `missions/m1/captured`, `/over`,
            `conditions/c1`.
        later: Another one.
        least_s: Seconds by which `later` comes after `earlier` at least.
        most_s: The same, at most.
        of: Path of the element that it comes from.
        words: The same for people.
    """

    earlier: str
    later: str
    least_s: FiniteFloat | None = None
    most_s: FiniteFloat | None = None
    kind: BoundKind
    of: str
    words: str

    @model_validator(mode='after')
    def _one_side(self) -> Self:
        if (self.least_s is None) is (self.most_s is None):
            raise ValueError('a bound on times has either a least or a greatest value')
        return self


class Mend(Document):
    """A stated number that could be another one.

    Attributes:
        path: Where it stands in the specification; `uavs` and `agents` are numbers of elements.
        requested: As it is stated (SI).
        nearest: The value next to it, in the steps of the report, with which the proof fails.
        span: Where the prompt states it.
    """

    path: str
    requested: FiniteFloat
    nearest: FiniteFloat
    unit: str
    span: Span | None = None


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
        listing: Closed list that lacks the element (missing_element, unsupported).
        rule: How it argues; None for what a closed list lacks.
        facts: What it rests on beside `requested`, `limit` and `listing`.
        chain: Bounds on times in a circle, each beginning where the one before ends: together
            they ask a point to come before itself.
        clauses: What the prompt says of the elements that it rests on, in its own words.
        mends: Stated numbers of which another value, with all else as it is, could be.
    """

    kind: str
    reason: str
    path: str
    requested: FiniteFloat | None = None
    unit: str = ''
    limit_name: str = ''
    limit: FiniteFloat | None = None
    word: str = ''
    listing: tuple[str, ...] = ()
    span: Span | None = None
    sentence: str
    rule: Rule | None = omitted(None)
    facts: tuple[Fact, ...] = omitted(())
    chain: tuple[TimeBound, ...] = omitted(())
    clauses: tuple[str, ...] = omitted(())
    mends: tuple[Mend, ...] = omitted(())


class CheckStage(StrEnum):
    """A level of verification before anything runs; a benchmark can leave one out."""

    STATIC = 'static'  # parts of the specification that do not fit together
    PROOFS = 'proofs'  # what limits, map and the request itself rule out


class StaticFinding(Document):
    """Parts of a specification that do not fit together: a fault of whoever wrote it.

    Attributes:
        field: Path of the part that is wrong: `conditions/c1/of`.
        relation: What should hold between it and what.
        mend: What would make it fit.
        span: Where the prompt speaks of it.
    """

    field: str
    relation: str
    mend: str
    span: Span | None = None


class FeasibilityVerdict(Document):
    """Outcome of the check.

    Attributes:
        notes: Why it is `unknown`.
        findings: Of the static verification.
    """

    result: Feasibility
    certificates: tuple[Certificate, ...] = ()
    notes: tuple[str, ...] = ()
    findings: tuple[StaticFinding, ...] = omitted(())
