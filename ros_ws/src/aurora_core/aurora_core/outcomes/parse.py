# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What parsing takes and gives."""

from __future__ import annotations

from difflib import SequenceMatcher
from enum import StrEnum

from pydantic import Field

from aurora_core.document import Document
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.retrieval import Retrieval
from aurora_core.ports.language_model import ModelCall
from aurora_core.spec.parameter import Span
from aurora_core.spec.scenario import Clause, ScenarioSpec

# A sentence names so many of a longer list, those most like the word first.
_NAMED = 12


class RefusalKind(StrEnum):
    UNSUPPORTED = 'unsupported'
    MISSING_ELEMENT = 'missing_element'


class ParseContext(Document):
    """The map that a prompt is read against.

    Attributes:
        map_name: Name of the map.
        landmark_names: The named places that it has.
        landmark_kinds: What each of them is (`museum`), in the same order; () where nobody knows.
        grounds: So many of these, the last ones, are areas and bus stops.
        seed: Seed of the run (the offline parser draws nothing from it).
    """

    map_name: str = 'downtown'
    landmark_names: tuple[str, ...] = ()
    landmark_kinds: tuple[str, ...] = ()
    grounds: int = 0
    seed: int = 1


class Refusal(Document):
    """Something named that the map or the vocabulary lacks.

    Attributes:
        word: What the prompt calls it.
        closed_list: All that there is instead.
        list_name: What the closed list is (`agent types`, `landmarks of downtown`).
    """

    kind: RefusalKind
    word: str
    span: Span
    list_name: str
    closed_list: tuple[str, ...]

    def sentence(self) -> str:
        """Return the refusal in words."""
        names = self.closed_list
        if len(names) > _NAMED:
            names = tuple(sorted(names, key=lambda name: (-self._likeness(name), name))[:_NAMED])
        more = len(self.closed_list) - len(names)
        known = (', '.join(names) or 'none') + (f' and {more} more' if more else '')
        return f'{self.word!r} is not one of the {self.list_name}: {known}.'

    def _likeness(self, name: str) -> float:
        """Return how much a name, or one of its words, is like the word, in [0, 1]."""
        word = self.word.casefold()
        return max(
            SequenceMatcher(None, word, part).ratio()
            for part in (name.casefold(), *name.casefold().split())
        )


class ParseOutcome(Document):
    """A specification, a question or refusals; always the clauses.

    Attributes:
        spec: As it was read; None when there is a question or a refusal.
        question: What was missing (status `not_understood`).
        refusals: What does not exist (status `infeasible`).
        clauses: Every clause of the prompt and what became of it.
        retrieval: What a language model was shown beside the prompt, and why; None without one.
        agsg: Graph of the completed request (`planning.complete`), where there is a specification.
            It travels beside this document, not in it.
        model_calls: Every call to a language model, () when the offline parser read the prompt.
    """

    spec: ScenarioSpec | None = None
    question: str | None = None
    refusals: tuple[Refusal, ...] = ()
    clauses: tuple[Clause, ...] = ()
    retrieval: Retrieval | None = None
    model_calls: tuple[ModelCall, ...] = ()
    agsg: Agsg | None = Field(default=None, exclude=True)
