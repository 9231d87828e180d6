# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What stands above a request: `Title: van tracking test.`, `Values: altitude 28 m; radius 35 m.`

A heading names what is told below and asks for nothing of its own; values above a flight are those
of the flight, as if they stood behind it.
"""

from __future__ import annotations

from collections.abc import Sequence

from aurora_core.parsing.atom_runs import runs, stop_at
from aurora_core.parsing.atoms import Atom, AtomKind, Determiner, NounKind
from aurora_core.parsing.lexicon import shipped_lexicon
from aurora_core.parsing.morphology import VerbForm
from aurora_core.spec.parameter import Span

_Run = tuple[list[Atom], Atom | None]
_FLOWN = ('altitude', 'radius', 'standoff', 'speed', 'duration')
_BESIDE = (
    AtomKind.COMMA,
    AtomKind.CONJUNCTION,
    AtomKind.FILL,
    AtomKind.FRAME,
    AtomKind.PREPOSITION,
)
_MOST_WORDS = 10


def headings(atoms: Sequence[Atom], prompt: str) -> tuple[list[Atom], list[Span]]:
    """Return the atoms without headings and with values behind their flight; the headings."""
    told = list(runs(atoms, AtomKind.STOP))
    kept: list[_Run] = []
    spans: list[Span] = []
    for k, (sentence, stop) in enumerate(told):
        label = told[k - 1] if k else ([], None)
        below = {a.key for run, _ in told[k + 1 :] for a in run if a.is_actor or a.is_place}
        again = bool(below) and all(
            a.key in below for a in sentence if a.is_actor or a.is_place
        )  # a title names what is told below
        if again and _is_label(label, prompt) and _is_title(sentence, prompt):
            spans.append(Span(start=sentence[0].start, end=sentence[-1].end))
            kept.append(([], stop))
        else:
            kept.append((sentence, stop))
    kept = _values_behind(kept)
    written: list[Atom] = []
    for sentence, stop in kept:
        written += [*sentence, *([stop] if stop is not None else [])]
    return written, spans


def _is_label(run: _Run, prompt: str) -> bool:
    sentence, stop = run
    if not sentence or stop is None or stop.key != ':':
        return False
    text = prompt[sentence[0].start : sentence[-1].end].lower()
    return text in shipped_lexicon().turns['headings']


def _is_title(sentence: Sequence[Atom], prompt: str) -> bool:
    """No predicate, no number, nobody with an article: `truck braking`."""
    if not sentence:
        return False
    text = prompt[sentence[0].start : sentence[-1].end]
    finite = any(
        a.kind is AtomKind.AUXILIARY or (a.kind is AtomKind.VERB and a.form is not VerbForm.ING)
        for a in sentence
    )
    nouns = [a.noun for a in sentence if a.noun is not None]
    new = any(n.determiner is not Determiner.BARE or n.plural or n.count for n in nouns[:1])
    said = finite or any(a.measure is not None or a.kind is AtomKind.WORLD for a in sentence)
    return not said and not new and len(text.split()) <= _MOST_WORDS


def _values_behind(told: list[_Run]) -> list[_Run]:
    """`altitude 28 m; radius 35 m. One drone circles the market`: the drone flies first."""
    flying = next((k for k, (run, _) in enumerate(told) if any(map(_is_flyer, run))), 0)
    values = [k for k in range(flying) if _is_values(told[k][0])]
    others = [k for k in range(flying) if k not in values and not _is_empty(told[k][0])]
    named = [a.noun for run, _ in told for a in run if a.noun is not None and _is_flyer(a)]
    acts = any(a.kind is AtomKind.VERB for a in told[flying][0])
    if not values or others or not acts or any(n.count > 1 or n.plural for n in named):
        return told
    sentence, stop = told[flying]
    last = told[values[-1]][0][-1]
    moved: list[_Run] = [(told[k][0], stop_at(told[k][0][-1])) for k in values]
    kept = [run for k, run in enumerate(told[:flying]) if k not in values]
    return [*kept, (sentence, stop or stop_at(last)), *moved, *told[flying + 1 :]]


def _is_flyer(atom: Atom) -> bool:
    return atom.noun is not None and atom.noun.kind is NounKind.UAV


def _is_empty(sentence: Sequence[Atom]) -> bool:
    """`Values:`, `Task:`: one word that says nothing."""
    return len(sentence) <= 1 and not any(a.measure or a.is_actor or a.is_place for a in sentence)


def _is_values(sentence: Sequence[Atom]) -> bool:
    names = [a for a in sentence if a.kind is AtomKind.THING and a.key in _FLOWN]
    numbers = [a for a in sentence if a.measure is not None]
    others = [a for a in sentence if a not in names and a not in numbers and a.kind not in _BESIDE]
    return bool(names) and len(names) == len(numbers) and not others
