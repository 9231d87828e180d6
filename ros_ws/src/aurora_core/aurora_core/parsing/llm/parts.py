# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`Parts`: what every step from a reading to a scene needs."""

from __future__ import annotations

from collections.abc import Sequence

from aurora_core.parsing.llm.facts import PromptFacts
from aurora_core.parsing.llm.numbers import StatedNumbers
from aurora_core.parsing.llm.reading import Number
from aurora_core.parsing.scene import Entity, Scene
from aurora_core.spec.parameter import Parameter, Span

# Where an element with an objection to its words is pointed to meanwhile.
_START = Span(start=0, end=1)


class Parts:
    """A scene under way, our names for the model's, and where objections go.

    Args:
        facts: The prompt.
        numbers: Turns numbers into parameters, and objects.
        complaints: Where objections go, worded for the model.

    Attributes:
        ids: Our id of every element by the model's.
    """

    def __init__(self, facts: PromptFacts, numbers: StatedNumbers, complaints: list[str]) -> None:
        self.facts = facts
        self.numbers = numbers
        self.complaints = complaints
        self.scene = Scene(facts.prompt, facts.context)
        self.ids: dict[str, str] = {}

    def name(self, given: str, ours: str) -> None:
        """Take our id for the model's."""
        if given in self.ids:
            self.complaints.append(f'ids must be unique, {given!r} is used twice')
        self.ids[given] = ours

    def name_all(self, stem: str, given: Sequence[str]) -> None:
        """Count ids of one kind."""
        for one in given:
            self.name(one, self.scene.new_id(stem))

    def ref(self, given: str) -> str:
        """Return our id for the model's; a place, or what is not there, stays as it is."""
        return self.ids.get(given, given)

    def ref_or_none(self, given: str | None) -> str | None:
        """Return our id for the model's, if there is one."""
        return None if given is None else self.ref(given)

    def actor(self, given: str, where: str, *, flies: bool | None = None) -> Entity | None:
        """Return the actor of an id; None with an objection when it is none of that kind."""
        entity = self.scene.by_id(self.ref(given))
        if entity is not None and flies in (None, entity.is_uav):
            return entity
        wanted = {None: 'an actor', True: 'a UAV', False: 'a ground agent'}[flies]
        self.complaints.append(f'{where}: {given!r} is not {wanted} of the answer')
        return None

    def span(self, quote: str, where: str) -> Span:
        """Return where the prompt has these words."""
        spans = self.facts.spans(quote)
        if not spans:
            self.complaints.append(f'{where}: the quote {quote!r} is not in the prompt')
        return spans[0] if spans else _START

    def number(self, name: str, number: Number | None, where: str) -> Parameter | None:
        """Return the parameter of a number, if there is one; see `StatedNumbers.parameter`."""
        return None if number is None else self.numbers.parameter(name, number, where)
