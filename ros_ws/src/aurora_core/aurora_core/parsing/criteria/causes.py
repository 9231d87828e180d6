# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What an event waits for, in whatever words: `the drone's view of the van is blocked`.

As a condition, a cause is read word by word: the words of one kind of cause, those whom it is
about, and words that say nothing else; with any other word in it, it is not one of these.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import Literal

from aurora_core.parsing import values
from aurora_core.parsing.atom_runs import LOOSE
from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.criteria.parties import Parties
from aurora_core.parsing.criteria.slots import criterion
from aurora_core.parsing.criteria.told import Told, told
from aurora_core.parsing.criteria.words import cause_words
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pieces import MOST_CAUSE_ATOMS
from aurora_core.parsing.scene import Entity, Scene
from aurora_core.spec.scenario import (
    ArrivalTrigger,
    MessageTrigger,
    MissionDoneTrigger,
    SendMessage,
    TimeTrigger,
    Trigger,
    VisibilityTrigger,
)
from aurora_core.spec.vocabulary import MissionMode

_PLACES = (NounKind.PLACE, NounKind.LANDMARK)
_PAUSES = (AtomKind.COMMA, AtomKind.CONJUNCTION, AtomKind.THEN)
_COMMANDS = ('alert', 'send', 'report')
_LETTER = re.compile(r'\b[A-Z]\d+\b')


def told_cause(frame: Frame) -> Trigger | None:
    """Return what the clause waits for when every word of it is one of one kind of cause."""
    line = told(frame.piece.atoms)
    for name, meaning in _MEANINGS.items():
        named = name == 'over' and is_flight(frame.piece.atoms, frame.piece.link)
        if not named and not _is_all(line, name):
            continue
        found = meaning(frame, line)
        if found is not None:
            frame.taken()
            return found
    return None


def is_flight(atoms: Sequence[Atom], link: str) -> bool:
    """`after the patrol of drone A`: a flight alone, behind `after`, is one that is over."""
    first = next((a for a in atoms if a.kind is not AtomKind.FILL), None)
    gerund = first is not None and first.form is VerbForm.ING and first is atoms[0]
    if link != 'after' or gerund:
        return False  # `after hovering`: told second, flown first
    line = told(atoms)
    grounded = any(n.kind in (NounKind.AGENT, NounKind.EGO) for n in line.nouns.values())
    left, flown = cause_words()['over_also'].subn(' ', line.text)
    return bool(flown) and not grounded and not line.measures and _says_no_more(left)


def cause_end(atoms: Sequence[Atom]) -> int:
    """Return how many of the atoms behind `when` are one cause, up to a pause; 0 if none are."""
    ends = [i for i, a in enumerate(atoms) if i and a.kind in _PAUSES and not _goes_on(atoms, i)]
    short = [end for end in (*ends, len(atoms)) if end <= MOST_CAUSE_ATOMS]
    for end in sorted(short, reverse=True):
        line = told(atoms[:end])
        if any(_is_all(line, name) for name in _MEANINGS):
            return end
        if _compares(atoms[:end]) and not _holds_effect(atoms[:end]):
            return end
    return 0


def _compares(atoms: Sequence[Atom]) -> bool:
    """One number is compared, and no command stands behind it without a comma."""
    if any(a.key in _COMMANDS for a in atoms):
        return False
    compared = criterion(atoms, asked=True)
    return (
        compared is not None
        and len(compared.limits) == 1
        and compared.limits[0].dimension in ('L', 'V')
    )


def _holds_effect(atoms: Sequence[Atom]) -> bool:
    """`the van is hidden, the drone climbs to 70 m`: the number is what happens then."""
    for i, atom in enumerate(atoms):
        if atom.kind is not AtomKind.COMMA or _goes_on(atoms, i):
            continue
        who = next((k for k in range(i + 1, len(atoms)) if atoms[k].kind not in LOOSE), len(atoms))
        acts = who + 1 < len(atoms) and atoms[who].is_actor
        told = any(a.kind is AtomKind.VERB for a in atoms[:i])
        if acts and told and atoms[who + 1].kind is AtomKind.VERB:
            return True
    return False


def _goes_on(atoms: Sequence[Atom], pause: int) -> bool:
    """`…, which starts 50 m ahead`: the noun in front of the pause belongs behind it, too."""
    return any(a.kind is AtomKind.RELATIVE for a in atoms[pause : pause + 2])


def _is_all(line: Told, name: str) -> bool:
    """Return whether a line has words of this kind of cause, and none that say something else.

    Weak words (`is there`, `no longer`) tell a kind only beside another word of it.
    """
    if line.measures and name != 'elapsed':
        return False
    words = cause_words()
    left, strong = words[f'{name}_needs'].subn(' ', line.text)
    left, weak = words[f'{name}_weak'].subn(' ', left)
    left, also = words[f'{name}_also'].subn(' ', left)
    left = words[f'{name}_beside'].sub(' ', left)
    tells = strong or (weak and also)
    return bool(tells) and _says_no_more(left)


def _says_no_more(left: str) -> bool:
    """Return whether what is left of a line are small words and names."""
    rest = cause_words()['fill'].sub(' ', _LETTER.sub(' ', left))
    return not rest.strip(' ,.;:\'"()-=')


def _elapsed(frame: Frame, line: Told) -> Trigger | None:
    times = [m for letter, m in line.measures.items() if letter.startswith('T')]
    if len(times) != 1 or len(line.measures) != 1 or line.nouns:
        return None
    if not values.accepts('trigger_time', times[0]):
        return None
    return TimeTrigger(on='time', at_s=values.explicit('trigger_time', times[0]))


def _sight(
    frame: Frame, line: Told, on: Literal['visible', 'occluded']
) -> VisibilityTrigger | None:
    named = _parties(frame, line).named()
    observers = [e for e in named if isinstance(e, Entity) and e.is_uav]
    others = [e for e in named if e not in observers]
    if not observers and len(frame.scene.uavs) == 1:
        observers = frame.scene.uavs
    if not others:
        others = [
            e for e in (_parties(frame, line).it(lambda e: not e.is_uav),) if e and _refers(line)
        ]
    if len(observers) != 1 or len(others) != 1:
        return None
    target = others[0]
    return VisibilityTrigger(
        on=on,
        observer=observers[0].id,
        target=target if isinstance(target, str) else target.id,
    )


def _seen(frame: Frame, line: Told) -> Trigger | None:
    return _sight(frame, line, 'visible')


def _lost(frame: Frame, line: Told) -> Trigger | None:
    return _sight(frame, line, 'occluded')


def _arrives(frame: Frame, line: Told) -> Trigger | None:
    named = _parties(frame, line).named()
    places = [p for p in named if isinstance(p, str)]
    who = [e for e in named if isinstance(e, Entity)]
    if not who and _refers(line):
        who = [e for e in (_parties(frame, line).it(),) if e is not None]
    if len(places) != 1 or len(who) != 1:
        return None
    who = list(who_moves(frame, tuple(who)))
    frame.scene.clause.places += (places[0],)
    return ArrivalTrigger(on='arrives', who=who[0].id, place=places[0])


def _received(frame: Frame, line: Told) -> Trigger | None:
    """Of the messages that were told, the last one that fits whom the clause names."""
    sent = [e.action for e in frame.scene.events if isinstance(e.action, SendMessage)]
    named = [e.id for e in _parties(frame, line).actors()]
    for message in reversed(sent):
        fits = all(one in (message.sender, message.receiver) for one in named)
        if fits and None in (None, message.sender):
            return MessageTrigger(
                on='message_received', by=message.receiver, sender=message.sender
            )
    return None


def _over(frame: Frame, line: Told) -> Trigger | None:
    flying = [e for e in _parties(frame, line).actors() if e.is_uav]
    if not flying and len(frame.scene.uavs) == 1:
        flying = frame.scene.uavs
    if not flying and frame.scene.missions:
        flying = [frame.scene.missions[-1].uav]  # `once the patrol is over`: the last one told
    named = [n for n in line.nouns.values() if n.kind in _PLACES]
    if len(flying) != 1 or named:
        return None
    return MissionDoneTrigger(on='mission_done', uav=who_flew(frame.scene, flying[0]).id)


def who_flew(scene: Scene, meant: Entity) -> Entity:
    """`after the patrol drone B lands`: whoever has flown nothing yet is not meant."""
    flown = scene.missions[-1].uav if scene.missions else meant
    return meant if scene.missions_of(meant) else flown


def who_moves(frame: Frame, who: tuple[Entity, ...]) -> tuple[Entity, ...]:
    """`a drone tracks a van. Once it reaches the park, …`: whom it tracks gets there."""
    it = [n.kind is NounKind.PRONOUN and n.key == 'it' for n in frame.subject_nouns]
    if len(who) != 1 or not who[0].is_uav or not it or not all(it):
        return who
    flown = frame.scene.missions_of(who[0])[-1:]
    tracks = flown and flown[0].mode is MissionMode.TRACK and flown[0].target is not None
    told = frame.scene.reported.get(who[0].id)  # `reports the truck when it goes faster than …`
    target = frame.scene.by_id(told or str(flown[0].target)) if told or tracks else None
    if target is None or target.is_uav:
        return who
    frame.scene.clause.subjects = (target,)
    return (target,)


def _parties(frame: Frame, line: Told) -> Parties:
    return Parties(frame.scene, frame.resolver, tuple(line.nouns.values()))


def _refers(line: Told) -> bool:
    return any(n.kind is NounKind.PRONOUN for n in line.nouns.values())


_MEANINGS: dict[str, Callable[[Frame, Told], Trigger | None]] = {
    'elapsed': _elapsed,
    'lost': _lost,
    'seen': _seen,
    'received': _received,
    'over': _over,
    'arrives': _arrives,
}
