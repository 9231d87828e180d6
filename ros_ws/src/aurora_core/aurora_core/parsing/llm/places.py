# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Places, weather and time of a reading against those of the prompt."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.llm.clauses import WORLD
from aurora_core.parsing.llm.facts import PromptFacts, inside, overlap
from aurora_core.parsing.llm.reading import Reading
from aurora_core.spec.parameter import Span
from aurora_core.spec.vocabulary import Place


def check_places(
    reading: Reading,
    facts: PromptFacts,
    unread: Sequence[Span],
    complaints: list[str],
    admitted: list[Span],
) -> None:
    """Object to places that the prompt does not name, and to named ones that nothing uses.

    Args:
        reading: What the model says.
        facts: The prompt.
        unread: Clauses in which nothing has to be.
        complaints: Where objections go.
        admitted: Where words go that nothing can carry, and that no model can mend.
    """
    known = facts.context.landmark_names
    areas = known[len(known) - facts.context.grounds :]
    free = {f'landmark:{name}' for name in areas}
    named = {_reference(atom) for atom in facts.places}
    # `the Ridge School zone` names an area, and the landmark in it.
    named |= {f'landmark:{name}' for name in known if any(name in area for area in named & free)}
    used = {r for r in _references(reading) if is_place(r)}
    complaints += [
        f'the prompt names no {place}: use null where no place is named'
        for place in sorted(used - named)
    ]
    for atom in facts.places:
        if _reference(atom) not in used | free and not _is_free(atom, facts, unread):
            complaints.append(
                f'{facts.text(atom)!r} is {_reference(atom)}, and nothing in the answer refers to '
                'it: encode it, or make its clause not_encoded'
            )
    for atom in facts.atoms:
        lacking = atom.noun is not None and atom.noun.kind is NounKind.MISSING_LANDMARK
        told = any(overlap(atom, s) for m in reading.missing for s in facts.spans(m.quote))
        if not lacking or told or _is_unread(atom, unread) or _is_part(atom, facts):
            continue
        if any(word[:1].isupper() for word in facts.text(atom).split()):
            complaints.append(f'{facts.text(atom)!r} is not on this map: expected it in missing')
        else:  # `a bus stop`: no name, and no place that could be missing
            admitted.append(Span(start=atom.start, end=atom.end))


def _is_free(atom: Atom, facts: PromptFacts, unread: Sequence[Span]) -> bool:
    """Tell whether words need no place: unread, or `a crossing | pedestrian`."""
    behind = next((a for a in facts.atoms if a.start >= atom.end), None)
    joined = behind is not None and not facts.prompt[atom.end : behind.start].strip()
    walks = behind is not None and behind.is_actor and joined
    return _is_unread(atom, unread) or walks


def _is_part(atom: Atom, facts: PromptFacts) -> bool:
    """`the plaza of Harbor Market`: a part of a place that there is."""
    behind = [a for a in facts.atoms if a.start >= atom.end][:2]
    return len(behind) == 2 and behind[0].key == 'of' and behind[1].is_place


def check_world(
    reading: Reading, facts: PromptFacts, unread: Sequence[Span], complaints: list[str]
) -> None:
    """Object to weather, time and traffic other than those that the prompt states."""
    for kind in ('weather', 'time_of_day', 'traffic_density'):
        words = [a for a in facts.world_words(kind) if not _is_unread(a, unread)]
        denied = {getattr(f, kind) for f in reading.forbidden}
        atoms = [a for a in words if not (facts.is_denied(a) and a.key.split(':', 1)[1] in denied)]
        stated = sorted({a.key.split(':', 1)[1] for a in atoms})
        said = getattr(reading.world, kind)
        found = said.value if said is not None else 'null'
        if said is None and all(_describes(a, facts) or facts.is_corrected(a) for a in atoms):
            continue
        if not stated and _is_understood_alone(reading, facts):
            continue
        if found not in (stated or ['null']):
            told = ' or '.join(stated) or 'null (the prompt states none)'
            complaints.append(f'world.{kind}: expected {told}, found {found}')


def _is_understood_alone(reading: Reading, facts: PromptFacts) -> bool:
    """Tell whether a clause about the world holds words that only the model can have understood.

    They are named in the note of the clause.
    """
    told = [s for c in reading.clauses if WORLD in c.ids for s in facts.spans(c.quote)]
    words = (AtomKind.UNKNOWN, AtomKind.WORLD_NOUN)
    return any(a.kind in words and overlap(a, s) for a in facts.atoms for s in told)


def _describes(word: Atom, facts: PromptFacts) -> bool:
    """`storm wind`, `night shift`, `10 m clear`: of something else than the scene.

    Where nothing is said the weather is clear.
    """
    behind = next((a for a in facts.atoms if a.start >= word.end), None)
    kinds = (AtomKind.UNKNOWN, AtomKind.THING, AtomKind.WORLD_NOUN)
    attached = behind is not None and not facts.prompt[word.end : behind.start].strip()
    unknown = behind is not None and (
        behind.kind in kinds or (behind.noun is not None and behind.noun.kind is NounKind.UNKNOWN)
    )
    return word.key == 'weather:clear' or (attached and unknown)


def is_place(reference: str) -> bool:
    """Return whether a reference means a place and not an actor."""
    return reference.startswith('landmark:') or reference in {p.value for p in Place}


def _reference(atom: Atom) -> str:
    assert atom.noun is not None
    key = atom.noun.key
    return f'landmark:{key}' if atom.noun.kind is NounKind.LANDMARK else key


def _is_unread(atom: Atom, unread: Sequence[Span]) -> bool:
    return any(inside(atom, clause) for clause in unread)


def _references(reading: Reading) -> Iterator[str]:
    for agent in reading.agents:
        yield from (p.of for p in agent.placements if p.of is not None)
        yield from (b.target for b in agent.behaviors if b.target is not None)
    for mission in reading.missions:
        yield from (name for name in (mission.target, mission.start) if name is not None)
    causes = [event.trigger for event in reading.events if event.trigger is not None]
    yield from (cause.other for cause in causes if cause.other is not None)
    yield from (f.target for f in reading.forbidden if f.target is not None)
    for condition in reading.conditions:
        yield from condition.of
