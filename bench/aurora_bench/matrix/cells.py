# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A cell of the matrix: one annotated request that asks for one word of the catalogue."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from aurora_bench.prompts.documents import Doc
from aurora_bench.prompts.format import AnnotatedPrompt


@dataclass(frozen=True, kw_only=True)
class Cell:
    """One place of one table.

    Attributes:
        table: Its heading.
        row: Word of the catalogue.
        column: To whom or what it is said.
        parts: Annotated requirements; () where the cell is empty.
        why_empty: Why nobody can ask for this; '' where it is asked.
    """

    table: str
    row: str
    column: str
    parts: Sequence[Doc] = ()
    why_empty: str = ''

    @property
    def ident(self) -> str:
        """Return an id that is the same in every campaign."""
        text = f'{self.table} {self.row} {self.column}'.lower()
        return re.sub(r'[^a-z0-9]+', '-', text).strip('-')

    def document(self) -> Doc:
        """Return the cell as a line of a prompt file."""
        numbered = [{'id': f'r{k}', **part} for k, part in enumerate(self.parts, 1)]
        return {
            'id': self.ident, 'category': 'multi_agent', 'feasibility': 'feasible',
            'prompt': f'{self.table}: {self.row}, {self.column}.',
            'paraphrase_group': None, 'end_to_end': True, 'requirements': numbered,
        }  # fmt: skip

    def prompt(self) -> AnnotatedPrompt:
        """Return the same, validated."""
        return AnnotatedPrompt.model_validate(self.document())


def agent(ref: str, kind: str, role: str | None = None, count: int = 1) -> Doc:
    """Return the requirement of a ground agent."""
    more: Doc = {} if role is None else {'role': role}
    more |= {} if count == 1 else {'count': count}
    return {'kind': 'agent', 'ref': ref, 'type': kind, **more}


def does(ref: str, behavior: str, target: str | None = None, **numbers: float) -> Doc:
    """Return what an agent does."""
    aim = {} if target is None else {'target': target}
    return {'kind': 'behavior', 'agent': ref, 'behavior': behavior, **aim, **numbers}


def stands(ref: str, relation: str, of: str | None = None, **numbers: float) -> Doc:
    """Return where an agent is."""
    place = {} if of is None else {'of': of}
    return {'kind': 'placement', 'agent': ref, 'relation': relation, **place, **numbers}


def uav(ref: str = 'uav1') -> Doc:
    """Return the requirement of a UAV."""
    return {'kind': 'uav', 'ref': ref}


def flies(mode: str, target: str | None = None, by: str = 'uav1', **fields: object) -> Doc:
    """Return a mission, called m1 unless `ref` is given."""
    aim = {} if target is None else {'target': target}
    return {'kind': 'mission', 'ref': 'm1', 'uav': by, 'mode': mode, **aim, **fields}


def when(trigger: Doc, action: Doc | None = None, ref: str = 'e1') -> Doc:
    """Return an event."""
    done = {} if action is None else {'action': action}
    return {'kind': 'event', 'ref': ref, 'trigger': trigger, **done}


def empty(table: str, row: str, columns: Iterable[str], why: str) -> list[Cell]:
    """Return cells that nobody can ask for."""
    return [Cell(table=table, row=row, column=c, why_empty=why) for c in columns]
