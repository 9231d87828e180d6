# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.fidelity.leave_out`: what each part of the offline reader pays for.

Every function of `aurora_core.parsing` that rewrites atoms, reads a frame or looks again is left
out in turn (atoms stay as they are, a construction finds nothing). Only the prompts in which it
had an effect are read again and scored. A part pays for a prompt when more is missed without it.
"""

from __future__ import annotations

import argparse
import importlib
import inspect
import pkgutil
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any

from aurora_bench.fidelity.answer import Answer, offline_answer
from aurora_bench.fidelity.summary import judge
from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_bench.prompts.shipped import tune_files
from aurora_bench.resumable.files import read_files
from aurora_cli.installed import installed
from aurora_core import parsing
from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.parser import parse_offline

_ATOMS = ('Sequence[Atom]', 'list[Atom]', 'tuple[Atom, ...]')
_SCOPES = ('.rewriting.', '.constructions.', '.second_look', '.criteria.', '.main_clause')


class Part:
    """One function and how it is left out."""

    def __init__(self, function: FunctionType, lines: int) -> None:
        self.function = function
        self.lines = lines
        self.name = (
            f'{function.__module__.removeprefix("aurora_core.parsing.")}.{function.__name__}'
        )
        self.effects: set[str] = set()

    def left_out(self, *arguments: Any, **named: Any) -> Any:
        """Answer as if the part were not there."""
        given = self.function.__annotations__.get('return', '')
        first = arguments[0] if arguments else next(iter(named.values()))
        return list(first) if given in _ATOMS else False if given == 'bool' else None

    def had_effect(self, arguments: Sequence[Any], answer: Any) -> bool:
        """Whether leaving the part out would change an answer."""
        if self.function.__annotations__.get('return') in _ATOMS:
            return list(answer) != list(arguments[0])
        return bool(answer)


def parts() -> list[Part]:
    """Return what can be left out: public functions, and the private passes of `rewrite`."""
    found = []
    for module in _modules():
        if not any(scope in f'{module.__name__}.' for scope in _SCOPES):
            continue
        for function in vars(module).values():
            if not isinstance(function, FunctionType) or function.__module__ != module.__name__:
                continue
            told = function.__annotations__
            first = next((v for k, v in told.items() if k != 'return'), '')
            given = told.get('return', '')
            rewrites = first in _ATOMS and given in _ATOMS
            reads = first == 'Frame' and (given == 'bool' or given.endswith('| None'))
            if rewrites or reads:
                found.append(Part(function, len(inspect.getsource(function).splitlines())))
    return found


def _modules() -> Iterator[ModuleType]:
    for info in pkgutil.walk_packages(parsing.__path__, 'aurora_core.parsing.'):
        yield importlib.import_module(info.name)


@contextmanager
def instead(replacing: dict[FunctionType, Callable[..., Any]]) -> Iterator[None]:
    """Put functions in the place of others, also where they stand in tables of functions."""
    undo: list[tuple[ModuleType, str, Any]] = []
    for module in _modules():
        for name, value in list(vars(module).items()):
            if isinstance(value, FunctionType) and value in replacing:
                new: Any = replacing[value]
            elif isinstance(value, tuple) and any(
                isinstance(v, FunctionType) and v in replacing for v in value
            ):
                new = tuple(
                    replacing.get(v, v) if isinstance(v, FunctionType) else v for v in value
                )
            else:
                continue
            undo.append((module, name, value))
            setattr(module, name, new)
    try:
        yield
    finally:
        for module, name, value in undo:
            setattr(module, name, value)


def note_effects(found: Sequence[Part], prompts: Sequence[AnnotatedPrompt]) -> None:
    """Note for each part the prompts in which it had an effect."""
    now = ['']
    landmarks = installed().map('downtown').landmarks
    context = ParseContext(landmark_names=tuple(mark.name for mark in landmarks))

    def watched(part: Part) -> Callable[..., Any]:
        def call(*arguments: Any, **named: Any) -> Any:
            answer = part.function(*arguments, **named)
            if part.had_effect(arguments, answer):
                part.effects.add(now[0])
            return answer

        return call

    with instead({part.function: watched(part) for part in found}):
        for prompt in prompts:
            now[0] = prompt.id
            parse_offline(prompt.prompt, context)


def _missed(prompt: AnnotatedPrompt, answer: Answer) -> int:
    return len(judge(prompt, answer).misses)


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the parts by what they pay for; return 0."""
    parser = argparse.ArgumentParser(prog='aurora_bench.fidelity.leave_out', description=__doc__)
    parser.add_argument('files', nargs='*', type=Path, metavar='FILE')
    parser.add_argument(
        '--at-most', type=int, default=12, help='look at parts with effects in at most so many'
    )
    options = parser.parse_args(arguments)
    files = read_files(options.files or tune_files())
    prompts = {p.id: p for f in files for p in f.prompts}
    found = parts()
    note_effects(found, list(prompts.values()))
    answers: dict[str, Answer] = {}
    for part in sorted(found, key=lambda p: (len(p.effects), p.name)):
        if len(part.effects) > options.at_most:
            continue
        worse = better = 0
        for name in part.effects - answers.keys():
            answers[name] = offline_answer(prompts[name].prompt)
        with instead({part.function: part.left_out}):
            for name in sorted(part.effects):
                answer = offline_answer(prompts[name].prompt)
                if answer == answers[name]:
                    continue
                change = _missed(prompts[name], answer) - _missed(prompts[name], answers[name])
                worse += change > 0
                better += change < 0
        sys.stdout.write(
            f'{worse - better:4d} {worse:4d} {better:4d} of {len(part.effects):4d}'
            f' {part.lines:4d} lines  {part.name}\n'
        )
        sys.stdout.flush()
    return 0


if __name__ == '__main__':
    sys.exit(main())
