# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A success condition: what has to hold on the trace, frozen before the run.

A condition carries everything that its evaluation needs (thresholds, tolerances, waypoints,
horizon), so that it can be judged from the bag alone and nothing that happens later moves it.
"""

from __future__ import annotations

from enum import StrEnum
from typing import Literal, Self

from pydantic import FiniteFloat, SerializeAsAny, TypeAdapter, model_validator

from aurora_core.document import Document, canonical_json, omitted
from aurora_core.errors import VerificationError
from aurora_core.quantities.actions import ActionRules
from aurora_core.quantities.kernels import TrackRule
from aurora_core.quantities.phases import CaptureRule, RestRule
from aurora_core.spec.parameter import Bound, Provenance, Span
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.vocabulary import MissionMode
from aurora_core.stl.formula import predicates
from aurora_core.stl.syntax import parse_formula

Point3 = tuple[FiniteFloat, FiniteFloat, FiniteFloat]
Op = Literal['<=', '<', '>=', '>', '==']


class Window(StrEnum):
    """Which samples a condition is about."""

    RUN = 'run'  # every tick
    START = 'start'  # t = 0
    MISSIONS = 'missions'  # from t = 0 until the last mission ends
    PHASE = 'phase'  # of the mission in the arguments: from capture to its end
    ON_MISSION = 'on_mission'  # all mission phases of the UAV
    AIRBORNE = 'airborne'  # while the UAV flies
    TO_THE_END = 'to_the_end'  # from its last mission to the end of the run
    MOMENT = 'moment'  # moments that the quantity itself names (events, messages, waypoints)


class ClimbArguments(Document):
    """A climb that an event may ask for while a mission is flown.

    Attributes:
        event: Id.
        altitude_m: Where it leads, above ground.
        within_s: Time for it, during which the altitude of the mission is not judged.
    """

    event: str
    altitude_m: FiniteFloat
    within_s: FiniteFloat


class RestArguments(Document):
    """When a UAV that hovers where it is has come to rest, see `RestRule`."""

    speed_mps: FiniteFloat
    braking_mps2: FiniteFloat
    off_m: FiniteFloat

    @property
    def rule(self) -> RestRule:
        """The same as it is measured."""
        return RestRule(speed_mps=self.speed_mps, braking_mps2=self.braking_mps2, off_m=self.off_m)


class MissionArguments(Document):
    """A mission as its conditions measure it.

    Attributes:
        mission: Id.
        index: Place among the missions of its UAV, from 0.
        altitude_m: Wanted altitude; `altitude_bound` says how it binds.
        altitude_tolerance_m: Tolerance on it: ends the ascent, keeps the altitude.
        capture_altitude_m: Tolerance on it at capture.
        capture_horizontal_m: Hover, navigate: distance from the first point at capture.
        point_m: Hover point or first waypoint.
        standoff_m: Track: wanted horizontal distance from `target`.
        standoff_tolerance_m: Track: tolerance on it.
        tracking_altitude_m: Track: tolerance on the altitude while tracking.
        first_altitude_m: Altitude of the UAV's first mission; ends the ascent.
        first_altitude_tolerance_m: Tolerance on it.
        planned_s: Planned length of the phase (None: ends with the route).
        waypoints: Route of a navigate mission.
        waypoint_horizontal_m: Tolerance at a waypoint.
        left_by: Event that may end it before its time.
        climbs: Climbs that events may ask for while it is flown.
        rest: Hover without a point: where it comes to rest it holds.
        level_from: Its altitude is that of a mission before, the one of this index, as events
            have changed it since.
    """

    mission: str
    uav: str
    index: int
    mode: MissionMode
    target: str | None = None
    altitude_m: FiniteFloat
    altitude_bound: Bound = Bound.EXACTLY
    altitude_tolerance_m: FiniteFloat
    capture_altitude_m: FiniteFloat
    capture_horizontal_m: FiniteFloat
    point_m: tuple[FiniteFloat, FiniteFloat] | None = None
    standoff_m: FiniteFloat = 0.0
    standoff_bound: Bound = Bound.EXACTLY
    standoff_tolerance_m: FiniteFloat = 0.0
    tracking_altitude_m: FiniteFloat = 0.0
    first_altitude_m: FiniteFloat
    first_altitude_tolerance_m: FiniteFloat
    planned_s: FiniteFloat | None = None
    waypoints: tuple[Point3, ...] = ()
    waypoint_horizontal_m: FiniteFloat = 3.0
    left_by: str | None = omitted(None)
    climbs: tuple[ClimbArguments, ...] = omitted(())
    rest: RestArguments | None = omitted(None)
    level_from: int | None = omitted(None)

    @property
    def track_rule(self) -> TrackRule | None:
        """The tracking tolerance, None when the mission does not track."""
        if self.mode is not MissionMode.TRACK:
            return None
        return TrackRule(
            standoff_m=self.standoff_m,
            standoff_bound=self.standoff_bound,
            horizontal_m=self.standoff_tolerance_m,
            altitude_m=self.altitude_m,
            vertical_m=self.tracking_altitude_m,
        )

    @property
    def capture_rule(self) -> CaptureRule:
        """When the mission has captured."""
        return CaptureRule(
            altitude_m=self.altitude_m,
            altitude_tolerance_m=self.capture_altitude_m,
            horizontal_tolerance_m=self.capture_horizontal_m,
            point_m=self.point_m,
            track=self.track_rule,
            target=self.target,
            rest=None if self.rest is None else self.rest.rule,
        )


class EventTolerances(Document):
    """What the moments of events are measured with.

    Attributes:
        brake_mps2: Loss of speed that counts as braking.
        onset_mps2: Change of speed that counts as slowing down or speeding up.
        arrival_m: Distance from a place at which an agent is there.
        crosswalk_m: Distance from the outline of a crosswalk at which a person is there; None: as
            of any other place.
        actions: When the actions of ground agents are complete.
        statistics_from: Attempts before a link's losses are compared with its model.
    """

    brake_mps2: FiniteFloat
    onset_mps2: FiniteFloat
    arrival_m: FiniteFloat
    crosswalk_m: FiniteFloat | None = omitted(None)
    actions: ActionRules | None = omitted(None)
    statistics_from: int


class Arguments(Document):
    """What the evaluation of a condition needs beside its threshold.

    Each quantity has an argument type of its own with what only it needs, in
    `aurora_core.judging.quantities`; here is what all of them may have.

    Attributes:
        kind: Which of these types it is.
        horizon_s: Time by which the run has to be over; a trace that ends earlier without having
            been finished is too short.
        window: Which samples count.
        touchdown_m: Height below which a UAV that reports landed is down.
        mission: The mission that it is about.
        missions: All missions of the UAV that it is about (alerts: of the sender).
        event: Event that it is about.
        event_tolerances: What the moments of that event are measured with.
        link: Link that it is about.
    """

    kind: str = ''
    horizon_s: FiniteFloat
    window: Window
    touchdown_m: FiniteFloat
    mission: MissionArguments | None = omitted(None)
    missions: tuple[MissionArguments, ...] = omitted(())
    event: str | None = omitted(None)
    event_tolerances: EventTolerances | None = omitted(None)
    link: str | None = omitted(None)


class Condition(Document):
    """One success condition.

    Attributes:
        id: Unique in the run, `<element>.<what>`.
        sentence: English.
        formula: STL text over the one signal `signal`; its robustness is the margin.
        signal: Name of the signal in the formula.
        quantity: What the signal measures.
        of: Bodies it is about.
        op: Comparison with the threshold; `==` means within the tolerance.
        threshold: In `unit`.
        tolerance: In `unit`, None where the request leaves none.
        scale: The margin divided by it compares across conditions.
        hold_s: How long it has to hold in one stretch.
        by_s: Deadline from scenario start.
        fraction: Share of samples asked for, when the threshold is one.
        arguments: What the evaluation needs beside the threshold.
        spec_ids: Elements of the specification it comes from.
        spans: Where the prompt asks for it.
        provenance: Of the threshold.
        implied: Follows from the request; False when the prompt states it.
    """

    id: str
    sentence: str
    formula: str
    signal: str
    quantity: QuantityName
    of: tuple[str, ...]
    op: Op
    threshold: FiniteFloat
    tolerance: FiniteFloat | None = None
    unit: str
    scale: FiniteFloat
    hold_s: FiniteFloat | None = None
    by_s: FiniteFloat | None = None
    fraction: FiniteFloat | None = None
    arguments: SerializeAsAny[Arguments]
    spec_ids: tuple[str, ...] = ()
    spans: tuple[Span, ...] = ()
    provenance: Provenance
    implied: bool = True

    @model_validator(mode='after')
    def _formula_is_about_the_signal(self) -> Self:
        try:
            names = {predicate.signal for predicate in predicates(parse_formula(self.formula))}
        except VerificationError as err:
            raise ValueError(str(err)) from err
        if names != {self.signal}:
            raise ValueError(f'formula of {self.id} is over {sorted(names)}, not {self.signal!r}')
        if not self.scale > 0.0:
            raise ValueError(f'scale of {self.id} must be above 0, found {self.scale}')
        return self

    @property
    def strict(self) -> bool:
        """Whether a margin of zero violates."""
        return self.op in ('<', '>')

    def satisfied(self, margin: float) -> bool:
        """Tell whether a margin satisfies the condition."""
        return margin > 0.0 or (margin == 0.0 and not self.strict)


_CONDITIONS: TypeAdapter[tuple[Condition, ...]] = TypeAdapter(tuple[Condition, ...])


def conditions_to_json(conditions: tuple[Condition, ...]) -> str:
    """Return the one byte-exact JSON text of conditions; `judging.codec` reads it."""
    return canonical_json(_CONDITIONS.dump_python(conditions, mode='json'))
