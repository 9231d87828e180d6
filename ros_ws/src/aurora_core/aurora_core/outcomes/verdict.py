# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`Verdict`: a signed margin per condition, and whether the record can be believed."""

from __future__ import annotations

from enum import StrEnum
from typing import Self

from pydantic import FiniteFloat, model_validator

from aurora_core.document import Document, omitted
from aurora_core.spec.parameter import Provenance, Span
from aurora_core.trace.air_clock import AirClock
from aurora_core.trace.trace import Integrity

VERDICT_VERSION = 1


class Reason(StrEnum):
    """Why a condition has no margin."""

    PREMISE_NEVER = 'premise_never'  # the event that it is about never happened
    EMPTY_PHASE = 'empty_phase'  # the phase that it is about has no sample
    TARGET_GONE = 'target_gone'  # the body that it is about left the simulation
    SAMPLES_MISSING = 'samples_missing'  # ticks are missing in the record
    TRACE_SHORT = 'trace_short'  # the record ends before it can be decided

    @property
    def undecided(self) -> bool:
        """Whether the record lacks what is needed, as opposed to: it shows a failure."""
        return self in (Reason.SAMPLES_MISSING, Reason.TRACE_SHORT)


class VerdictStatus(StrEnum):
    """What the trace shows."""

    VERIFIED = 'verified'
    VIOLATED = 'violated'
    INCONCLUSIVE = 'inconclusive'


class ConditionResult(Document):
    """What the trace says about one condition.

    Attributes:
        id: Of the condition.
        sentence: The condition in English.
        explanation: What happened, with numbers.
        formula: STL text; the margin is its robustness.
        source_spans: Where the prompt asks for it.
        spec_ids: Elements of the specification.
        op: Comparison with the threshold.
        threshold: In `unit`.
        tolerance: In `unit`, None when there is none.
        margin: At least 0 satisfied (`<`, `>`: above 0); None with a `reason`.
        reason: Why there is no margin.
        unit: Of threshold and margin.
        normalised: Margin divided by the threshold's scale.
        satisfied: A missing margin is not satisfied.
        exercised: The premise occurred, the phase has samples.
        worst_time_s: Simulated time of the deciding sample.
        worst_place_m: Position of the body concerned at that time, ENU metres.
        evidence: Topics and ticks that were used.
        provenance: Of the threshold.
        implied: Follows from the request; False when the prompt states it.
    """

    id: str
    sentence: str
    explanation: str
    formula: str
    source_spans: tuple[Span, ...] = ()
    spec_ids: tuple[str, ...] = ()
    op: str
    threshold: FiniteFloat
    tolerance: FiniteFloat | None = None
    margin: FiniteFloat | None = None
    reason: Reason | None = None
    unit: str
    normalised: FiniteFloat | None = None
    satisfied: bool
    exercised: bool
    worst_time_s: FiniteFloat | None = None
    worst_place_m: tuple[FiniteFloat, FiniteFloat, FiniteFloat] | None = None
    evidence: tuple[str, ...] = ()
    provenance: Provenance
    implied: bool = True

    @model_validator(mode='after')
    def _margin_or_reason(self) -> Self:
        if (self.margin is None) is (self.reason is None):
            raise ValueError(f'{self.id}: either a margin or a reason, found both or none')
        if self.margin is None and self.satisfied:
            raise ValueError(f'{self.id}: a missing margin is not satisfied')
        return self


class Finding(Document):
    """A claim of the recording that recomputation does not bear out.

    Attributes:
        kind: event, message, chance, sight, phase, end, motion; condition, roster, world, graph or
            configuration; command or claim (not what the executor gives from the states); live.
        subject: What the claim is about.
        tick: Where.
        time_s: Simulated time of that tick.
        text: Claim and recomputation.
    """

    kind: str
    subject: str
    tick: int
    time_s: FiniteFloat
    text: str


class Verdict(Document):
    """The monitor's judgement of one trace.

    Attributes:
        status: See `VerdictStatus`.
        results: One per condition, in their order.
        cross_check: Disagreements of record and recomputation.
        integrity: State of the recording.
        notes: For people.
        clocks: Of autopilots that kept their own time; () of a run in lockstep.
    """

    schema_version: int = VERDICT_VERSION
    status: VerdictStatus
    results: tuple[ConditionResult, ...]
    cross_check: tuple[Finding, ...] = ()
    integrity: Integrity
    notes: tuple[str, ...] = ()
    clocks: tuple[AirClock, ...] = omitted(())

    @property
    def worst(self) -> ConditionResult | None:
        """The result with the least normalised margin; one without a margin comes first."""
        if not self.results:
            return None
        return min(
            self.results,
            key=lambda r: float('-inf') if r.normalised is None else r.normalised,
        )
