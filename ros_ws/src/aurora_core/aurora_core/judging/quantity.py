# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What every quantity is: the arguments of a condition, and how its samples are taken."""

from __future__ import annotations

from abc import abstractmethod
from typing import ClassVar

from pydantic import FiniteFloat

from aurora_core.document import Document, omitted
from aurora_core.errors import VerificationError
from aurora_core.judging.evaluation import BoolArray, Context, Evaluation, FloatArray
from aurora_core.outcomes.condition import (
    Arguments,
    Condition,
    EventTolerances,
    MissionArguments,
    Window,
)
from aurora_core.quantities.kernels import bound_error
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.quantity import QuantityName


class Quantity(Arguments, defer_build=True):
    """A quantity as one condition asks for it.

    Attributes:
        name: The quantity of the contract that it is, or a reading of.
    """

    name: ClassVar[QuantityName]

    @abstractmethod
    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the samples of the signal, or why there are none.

        Args:
            context: The run.
            condition: The condition that these arguments belong to.
        """


class OfMission(Quantity):
    """A quantity of one mission, by default of its phase from capture to its end."""

    window: Window = Window.PHASE
    mission: MissionArguments

    @property
    def phase_topics(self) -> tuple[str, ...]:
        """Evidence of what happens in the phases of the UAV."""
        uav = self.mission.uav
        return (f'uav/state[{uav}]', f'uav/command[{uav}].phase')


class OfSight(Quantity):
    """A quantity of who sees whom: in the phases of a UAV, from the ground over the whole run."""

    window: Window = Window.PHASE

    def sight_topics(self, observer: str) -> tuple[str, ...]:
        """Return the evidence of what an observer sees."""
        if self.mission is None:
            return (f'ground/state[{observer}]',)
        uav = self.mission.uav
        return (f'uav/state[{uav}]', f'uav/command[{uav}].phase')


class OfMissions(Quantity):
    """A quantity of all missions of a UAV."""

    missions: tuple[MissionArguments, ...]


class OfEvent(Quantity):
    """A quantity of an event, at moments that the event names."""

    window: Window = Window.MOMENT
    event: str
    event_tolerances: EventTolerances


class OfLink(Quantity):
    """A quantity of what a link carries."""

    window: Window = Window.MOMENT
    link: str


class PerSample(Document):
    """What each sample is compared with, where the share of good samples counts.

    Attributes:
        bound: How the number binds.
        wanted: Number, in the unit of the quantity.
        tolerance: On it, in the same unit.
        strict: A sample that is exactly the wanted number does not count.
    """

    bound: Bound = Bound.EXACTLY
    wanted: FiniteFloat
    tolerance: FiniteFloat = 0.0
    strict: bool = omitted(False)

    @classmethod
    def of(cls, asked: Parameter, tolerance: float) -> PerSample:
        """Return the number of a request; a bound has no tolerance of its own.

        Args:
            asked: The number, and how it binds.
            tolerance: On an exact number, in its unit.
        """
        exact = asked.bound is Bound.EXACTLY
        return cls(bound=asked.bound, wanted=asked.value, tolerance=tolerance if exact else 0.0)

    def good(self, values: FloatArray) -> BoolArray:
        """Return which samples are as asked."""
        off = bound_error(values, self.wanted, self.bound)
        good: BoolArray = off < 0.0 if self.strict else off <= self.tolerance
        return good


def measure(context: Context, condition: Condition) -> Evaluation:
    """Return the samples of a condition's signal, or why there are none.

    Raises:
        VerificationError: Its arguments are those of no quantity.
    """
    asked = condition.arguments
    if not isinstance(asked, Quantity):
        raise VerificationError(
            f'condition {condition.id} is about {condition.quantity.value}, which has no measure'
        )
    return asked.measure(context, condition)
