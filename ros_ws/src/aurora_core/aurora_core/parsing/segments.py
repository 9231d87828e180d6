# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Clauses: one predicate each, with the word that links it to its neighbours."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atoms import Atom, AtomKind, Determiner, NounKind
from aurora_core.parsing.brackets import take_out
from aurora_core.parsing.criteria.spans import stretches
from aurora_core.parsing.gaps import fill_gaps, opens_gap
from aurora_core.parsing.measures import RATIO, TIME
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pieces import MARKERS, TRANSPARENT, Link, Piece, first_solid, has_verb
from aurora_core.parsing.predicates import cut_at_verbs

_MAYBE_PREPOSITION = ('after', 'before', 'until')
# What only flights have.
_FLOWN = ('altitude', 'altitude_suffix', 'standoff', 'radius')


def segment(atoms: Sequence[Atom]) -> tuple[Piece, ...]:
    """Cut a prompt's atoms into clauses, in the order of the text."""
    pieces: list[Piece] = []
    sentence: list[Atom] = []
    number = 0
    for atom in (*atoms, None):
        if atom is None or atom.kind is AtomKind.STOP:
            if sentence:
                pieces += _sentence(sentence, number)
                number += 1
            sentence = []
        else:
            sentence.append(atom)
    return tuple(pieces)


def _sentence(atoms: list[Atom], number: int) -> list[Piece]:
    """Cut out the conditions that a sentence states, then read what stands around them."""
    pieces: list[Piece] = []
    for stretch in stretches(atoms):
        if stretch.criterion is None:
            pieces += clauses(stretch.atoms, number)
        else:
            told = Piece(atoms=stretch.atoms, sentence=number, criterion=stretch.criterion)
            pieces.append(told)
    return pieces


def clauses(atoms: Sequence[Atom], number: int) -> list[Piece]:
    """Cut a sentence, or a stretch of one, into clauses."""
    plain, asides = take_out(list(atoms))
    raw = _cut_at_markers(_end_causes(_plain_prepositions(plain)))
    parts = [part for whole in raw for part in _cut_behind_comparison(whole)]
    pieces = [piece for part in parts for piece in cut_at_verbs(part)]
    pieces = _causes_first(_attach_adjuncts(_delays(fill_gaps(pieces))))
    told = [Piece(atoms=a.atoms, link=Link.RELATIVE, head=a.head) for a in asides]
    first = [p for p in told if _names_others(p) or _of_a_cause(p, pieces)]
    pieces = first + pieces + [p for p in told if p not in first]
    return [replace(p, sentence=number) for p in _descriptions_first(pieces) if p.atoms]


def _descriptions_first(pieces: list[Piece]) -> list[Piece]:
    """`alerts it when a van | that drives at 10 m/s | comes near`: effect and cause meet."""
    moved = list(pieces)
    for k in range(1, len(moved) - 1):
        told, cause = moved[k], moved[k + 1]
        described = told.link is Link.RELATIVE and cause.head is not None
        if described and cause.link in (Link.WHEN, Link.AFTER, Link.UNTIL) and not cause.opens:
            moved[k - 1], moved[k] = moved[k], moved[k - 1]
    return moved


def _plain_prepositions(atoms: list[Atom]) -> list[Atom]:
    """`after 10 s`, `before the junction`, `as a test`: no clause follows."""
    changed = list(atoms)
    for i, atom in enumerate(atoms):
        if atom.kind is AtomKind.AUXILIARY and atom.key == 'should' and _inverted(atoms, i):
            changed[i] = atom = replace(atom, kind=AtomKind.SUBORDINATOR, key='when')
        if atom.kind is AtomKind.PREPOSITION and atom.key == 'with' and i and _absolute(atoms, i):
            changed[i] = replace(atom, kind=AtomKind.CONJUNCTION)
        if atom.kind is not AtomKind.SUBORDINATOR:
            continue
        ahead = _until_marker(atoms, i + 1)
        first = first_solid(ahead)
        timed = first is not None and first.key == TIME and atom.key in _MAYBE_PREPOSITION
        if has_verb(ahead) and not timed:
            continue
        if atom.key == 'when' and _is_count(ahead) and not opens_sentence(atoms, i):
            changed[i] = replace(atom, kind=AtomKind.FILL)
            continue
        if atom.key in _MAYBE_PREPOSITION:
            changed[i] = replace(atom, kind=AtomKind.PREPOSITION)
        elif atom.key == 'while' and not any(a.is_actor for a in ahead):
            changed[i] = replace(atom, kind=AtomKind.FILL)
    return changed


def _is_count(ahead: Sequence[Atom]) -> bool:
    """`circles it once with a radius of 40 m`: how often, not when."""
    first = first_solid(ahead)
    preposition = first is not None and first.kind is AtomKind.PREPOSITION
    return preposition and not any(a.is_actor for a in ahead)


def opens_sentence(atoms: Sequence[Atom], i: int) -> bool:
    """Return whether only small words or a pause stand in front."""
    return i == 0 or atoms[i - 1].kind in (AtomKind.COMMA, AtomKind.CONJUNCTION, AtomKind.THEN)


def _inverted(atoms: Sequence[Atom], i: int) -> bool:
    """`should it slow below 3 m/s, …`: the auxiliary opens the clause."""
    opens = i == 0 or atoms[i - 1].kind in (AtomKind.COMMA, AtomKind.CONJUNCTION)
    ahead = next((a for a in atoms[i + 1 :] if a.kind is not AtomKind.FILL), None)
    named = ahead is not None and (ahead.is_actor or ahead.kind is AtomKind.THING)
    return opens and named


def _absolute(atoms: Sequence[Atom], i: int) -> bool:
    """`with two cars driving around`: a clause of its own."""
    solid = [a for a in atoms[i + 1 : i + 6] if a.kind not in TRANSPARENT]
    if len(solid) < 2 or not solid[0].is_actor:
        return False
    if solid[1].kind is AtomKind.VERB:
        return solid[1].form is VerbForm.ING
    beside = next((a for a in solid[1:3] if a.kind is AtomKind.RELATION), None)
    if beside is None:
        return False
    behind = solid[solid.index(beside) + 1 :]  # `with a truck beside it`
    return not behind or (behind[0].noun is not None and behind[0].noun.kind is NounKind.PRONOUN)


def _cut_behind_comparison(piece: Piece) -> list[Piece]:
    """`if ego > 15 m/s drone warns it`: a cause without a verb ends with its number."""
    atoms = piece.atoms
    if piece.link is not Link.WHEN:
        return [piece]
    for i in range(1, len(atoms) - 2):
        solid = [a for a in atoms[i + 1 :] if a.kind not in TRANSPARENT]
        acts = len(solid) > 1 and solid[0].is_actor and solid[1].kind is AtomKind.VERB
        if atoms[i].kind is AtomKind.MEASURE and acts and not has_verb(atoms[:i]):
            return [replace(piece, atoms=atoms[: i + 1]), Piece(atoms=atoms[i + 1 :])]
    return [piece]


# Predicates that need nothing behind them.
_ALONE = frozenset(
    {'brake', 'stop', 'start', 'slow', 'accelerate', 'change_lane', 'yield', 'appear', 'vanish'}
)


def _end_causes(atoms: list[Atom]) -> list[Atom]:
    """`when it exceeds 15 m/s a truck ahead of it brakes`: a comma where the effect begins."""
    ended = list(atoms)
    i = 0
    while i < len(ended):
        if ended[i].kind is AtomKind.SUBORDINATOR and ended[i].key in ('when', 'after', 'until'):
            run = []
            for atom in ended[i + 1 :]:
                if atom.kind in MARKERS and atom.kind is not AtomKind.RELATIVE:
                    break
                run.append(atom)
            cut = _missing_comma(run)
            if cut is not None:
                at = run[cut].start
                ended.insert(i + 1 + cut, Atom(kind=AtomKind.COMMA, key=',', start=at, end=at))
        i += 1
    return ended


def _missing_comma(atoms: Sequence[Atom]) -> int | None:
    """Return where the effect begins behind a cause that no comma ends."""
    verbs = [i for i, a in enumerate(atoms) if a.kind is AtomKind.VERB]
    if len(verbs) < 2:
        return None
    for i in range(verbs[0] + 1, len(atoms)):
        before = atoms[i - 1]
        if not atoms[i].is_actor:
            continue
        full = (
            before.kind is AtomKind.MEASURE or before.is_place or before.kind is AtomKind.IN_VIEW
        )
        full = full or (before.is_actor and before.noun is not atoms[i].noun)
        full = full or (i - 1 == verbs[0] and before.key in _ALONE)
        behind = [k for k in verbs if k > i]
        if not full or not behind or any(a.kind is AtomKind.VERB for a in atoms[verbs[0] + 1 : i]):
            continue
        helped = any(a.kind is AtomKind.AUXILIARY for a in atoms[i:])
        finite = any(atoms[k].form in (VerbForm.THIRD, VerbForm.BASE) for k in behind)
        describes = any(a.kind is AtomKind.RELATIVE for a in atoms[:i])
        if (finite or helped) and not describes:
            return i
    return None


def _until_marker(atoms: Sequence[Atom], start: int) -> list[Atom]:
    ahead: list[Atom] = []
    for atom in atoms[start:]:
        if atom.kind in MARKERS and not (
            atom.kind is AtomKind.CONJUNCTION and not has_verb(ahead)
        ):
            break
        ahead.append(atom)
    return ahead


def _cut_at_markers(atoms: list[Atom]) -> list[Piece]:
    pieces: list[Piece] = []
    current: list[Atom] = []
    state = Piece(atoms=(), opens=True)
    i = 0
    while i < len(atoms):
        if atoms[i].kind not in MARKERS:
            current.append(atoms[i])
            i += 1
            continue
        run = i
        while run < len(atoms) and (
            atoms[run].kind in MARKERS
            or (
                atoms[run].kind in (AtomKind.FILL, AtomKind.FRAME)
                and run + 1 < len(atoms)
                and atoms[run + 1].kind in MARKERS
            )
        ):
            run += 1
        markers = [a for a in atoms[i:run] if a.kind in MARKERS]
        following = _next_run(atoms, run)
        upcoming = _decide(current, markers, following)
        if upcoming is None:
            current += atoms[i:run]
        else:
            if current:
                pieces.append(replace(state, atoms=tuple(current)))
            opens = (
                not pieces or upcoming.then or any(m.kind is AtomKind.CONJUNCTION for m in markers)
            )
            state = replace(upcoming, opens=opens)
            current = []
        i = run
    if current:
        pieces.append(replace(state, atoms=tuple(current)))
    return pieces


def _next_run(atoms: Sequence[Atom], start: int) -> list[Atom]:
    ahead = []
    for atom in atoms[start:]:
        if atom.kind in MARKERS and atom.kind is not AtomKind.RELATIVE:
            break
        ahead.append(atom)
    return ahead


def _decide(
    current: Sequence[Atom], markers: Sequence[Atom], ahead: Sequence[Atom]
) -> Piece | None:
    """Return the shape of the clause that begins behind the markers, None when none begins."""
    then = any(m.kind is AtomKind.THEN for m in markers)
    for marker in markers:
        if marker.kind is AtomKind.SUBORDINATOR:
            first = first_solid(ahead)
            gerund = first is not None and first.form is VerbForm.ING
            if marker.key == 'before' and current and (gerund or _goes_on(ahead)):
                return Piece(atoms=(), then=True, lead=marker.start)
            return Piece(atoms=(), link=Link(marker.key), then=then, lead=marker.start)
    solid = first_solid(ahead)
    if solid is None:
        return None
    relative = any(m.kind is AtomKind.RELATIVE for m in markers)
    if relative:
        head = next((a for a in reversed(current) if a.is_actor), None)
        alone = sum(a.kind is AtomKind.VERB for a in ahead) == 1 and _is_placed(current)
        listed = any(m.kind is AtomKind.CONJUNCTION for m in markers) and has_verb(current)
        if listed and has_verb(ahead) and solid.noun is not None and markers[-1].key == 'that':
            return Piece(atoms=())  # `make sure that … and that no bus comes`
        if solid.kind is not AtomKind.VERB or head is None:
            return None
        if not has_verb(current) and not (alone and head is current[-1]):
            return None
        return Piece(atoms=(), link=Link.RELATIVE, head=head)
    verb = has_verb(ahead)
    if then:
        return Piece(atoms=(), then=True) if verb or not current else None
    if not current:
        return None
    if verb:
        return _decide_predicate(current, markers, ahead, solid)
    if opens_gap(current, ahead) or _is_share(ahead) or _is_inverted(ahead):
        return Piece(atoms=())
    if _is_ratio_of_sight(ahead) and any(a.key == RATIO for a in current):
        return Piece(atoms=())
    actor_list = not has_verb(current) and _only_actors(current)
    comma = any(m.kind is AtomKind.COMMA for m in markers)
    refers = any(a.noun is not None and a.noun.kind is NounKind.PRONOUN for a in ahead)
    anchored = refers or _hangs(ahead)
    if _shares_place(current, ahead) and not comma and not anchored:
        return None
    if solid.is_actor and _is_placed(ahead) and (not actor_list or (comma and anchored)):
        return Piece(atoms=())
    aerial = solid.noun is not None and solid.noun.kind is NounKind.UAV
    if aerial and comma and has_verb(current) and not _only_actors(ahead):
        return Piece(atoms=())  # `…, drone overhead at 30 m`
    if solid.is_actor and comma and not actor_list and _only_actors(ahead):
        last = next((a for a in reversed(current) if a.kind not in TRANSPARENT), None)
        if _is_placed(current) or (last is not None and not last.is_actor):
            return Piece(atoms=())  # `…, two background cars`
    return None


# What a UAV does next: `orbits it before it hovers over the park`.
_PHASES = frozenset({'hover', 'track', 'orbit', 'navigate', 'land'})


def _goes_on(ahead: Sequence[Atom]) -> bool:
    solid = [a for a in ahead if a.kind not in TRANSPARENT]
    flies = len(solid) > 1 and solid[0].is_actor and _flies(solid[0])
    return flies and solid[1].kind is AtomKind.VERB and solid[1].key in _PHASES


def _decide_predicate(
    current: Sequence[Atom], markers: Sequence[Atom], ahead: Sequence[Atom], solid: Atom
) -> Piece | None:
    conjunction = any(m.kind is AtomKind.CONJUNCTION for m in markers)
    if solid.kind is AtomKind.VERB:
        if solid.form is VerbForm.ING and not conjunction:
            return Piece(atoms=(), link=Link.PARTICIPLE)
        by = any(a.kind is AtomKind.PREPOSITION and a.key == 'by' for a in ahead)
        if solid.form is VerbForm.PAST and by and not conjunction:
            head = next((a for a in reversed(current) if a.is_actor), None)
            return Piece(atoms=(), link=Link.RELATIVE, head=head)
        return Piece(atoms=())
    beside = any(m.key == 'with' for m in markers)  # `a bus with a van following it`
    if not has_verb(current) and conjunction and solid.is_actor and not beside:
        last = next((a for a in reversed(current) if a.kind not in TRANSPARENT), None)
        placed = _is_placed(current) and not any(a.kind is AtomKind.THING for a in current)
        noun = solid.noun
        everyone = noun is not None and noun.kind is NounKind.PRONOUN and noun.key == 'both'
        if everyone and any(m.kind is AtomKind.COMMA for m in markers):
            return Piece(atoms=())  # `three cars and a bus, and all of them drive around`
        if last is not None and last.is_actor and not placed:
            return None  # coordinated subjects
    return Piece(atoms=())


def _only_actors(atoms: Sequence[Atom]) -> bool:
    return all(
        a.is_actor or a.kind in TRANSPARENT or a.kind in MARKERS or a.kind is AtomKind.CAUSATIVE
        for a in atoms
    )


def _is_placed(atoms: Sequence[Atom]) -> bool:
    """`an ambulance behind it`, `a drone above the bus`: an actor with a place."""
    solid = [a for a in atoms if a.kind not in TRANSPARENT]
    if len(solid) < 2 or not solid[0].is_actor:
        return False
    place_words = (AtomKind.RELATION, AtomKind.PREPOSITION, AtomKind.SIREN)
    return solid[1].kind in place_words or (
        solid[1].kind is AtomKind.MEASURE and len(solid) > 2 and solid[2].kind in place_words
    )


def _shares_place(current: Sequence[Atom], ahead: Sequence[Atom]) -> bool:
    """`put five bicycles and a bus on the main road`: the place is that of both."""
    told = [a for a in current if a.kind not in TRANSPARENT]
    solid = [a for a in ahead if a.kind not in TRANSPARENT]
    if len(told) < 2 or len(solid) < 3 or not told[-1].is_actor or not solid[0].is_actor:
        return False
    places = told[-2].kind is AtomKind.VERB and told[-2].key in ('put', 'exist', 'contain', 'be')
    flying = any(_flies(a) for a in (told[-1], solid[0]))
    return places and not flying and solid[1].kind is AtomKind.PREPOSITION and solid[2].is_place


def _hangs(atoms: Sequence[Atom]) -> bool:
    """`van 30 m behind`: of whom it is said is named before."""
    solid = [a for a in atoms if a.kind not in TRANSPARENT]
    return solid[-1].kind is AtomKind.RELATION


def _delays(pieces: list[Piece]) -> list[Piece]:
    """`the drone lands 5 s after the bus stops`: the time belongs to `after`."""
    moved = list(pieces)
    for k in range(len(moved) - 1):
        behind = moved[k + 1]
        atoms = list(moved[k].atoms)
        while atoms and atoms[-1].kind is AtomKind.FILL:
            atoms.pop()
        if behind.link not in (Link.AFTER, Link.WHEN) or not atoms or atoms[-1].key != TIME:
            continue
        if len(atoms) > 1 and atoms[-2].kind is AtomKind.PREPOSITION:
            continue
        moved[k + 1] = replace(
            behind, atoms=(atoms[-1], *behind.atoms), opens=behind.opens or len(atoms) == 1
        )
        moved[k] = replace(moved[k], atoms=tuple(atoms[:-1]))
    return [p for p in moved if p.atoms]


def _causes_first(pieces: list[Piece]) -> list[Piece]:
    """`brakes when a boy who crosses the street comes near`: the cause, then who he is."""
    ordered = list(pieces)
    for k in range(1, len(ordered) - 1):
        told, cause = ordered[k], ordered[k + 1]
        same = told.link is Link.RELATIVE and cause.link is Link.WHEN and not cause.opens
        own = told.head is None and cause.head is not None and cause.head in told.atoms
        if same and own:
            head = cause.head
            assert head is not None
            rest = tuple(a for a in told.atoms if a is not head)
            ordered[k] = replace(cause, atoms=(head, *cause.atoms), head=None)
            ordered[k + 1] = replace(told, atoms=rest, head=head, lead=None)
    return ordered


def _attach_adjuncts(pieces: list[Piece]) -> list[Piece]:
    """Give `At 30 m,` and `20 m ahead of it,` to the clause that they modify."""
    joined: list[Piece] = []
    waiting: tuple[Atom, ...] = ()
    for k, piece in enumerate(pieces):
        atoms = waiting + piece.atoms
        waiting = ()
        alone = not has_verb(piece.atoms) and piece.link is Link.MAIN and _is_adjunct(piece.atoms)
        if alone and not piece.then:
            if (
                k + 1 < len(pieces)
                and pieces[k + 1].link is Link.MAIN
                and piece.opens
                and not joined
                and not _of_another(piece.atoms, pieces[k + 1].atoms)
            ):
                waiting = atoms
                continue
            if joined:
                joined[-1] = replace(joined[-1], atoms=joined[-1].atoms + atoms)
                continue
        joined.append(replace(piece, atoms=atoms))
    return joined


def _names_others(piece: Piece) -> bool:
    """`a truck (25 m behind my car) tailgates it`: named in brackets, meant outside."""
    nouns = [a.noun for a in piece.atoms if a.noun is not None and a.is_actor]
    return bool(nouns) and all(n.kind is not NounKind.PRONOUN for n in nouns)


def _of_a_cause(aside: Piece, pieces: Sequence[Piece]) -> bool:
    """`when the child, who crosses after 10 s, …`: what it does is told before what follows."""
    causes = [p for p in pieces if p.link in (Link.WHEN, Link.AFTER, Link.UNTIL)]
    placed = any(a.kind is AtomKind.RELATION for a in aside.atoms)  # beside whom is told before
    return not placed and any(aside.head in p.atoms for p in causes)


def _is_inverted(ahead: Sequence[Atom]) -> bool:
    """`…, and 15 m behind the van a car`: whoever is new is placed by whoever is known."""
    solid = [a for a in ahead if a.kind not in TRANSPARENT]
    solid = solid[1:] if solid and solid[0].measure is not None else solid
    if len(solid) != 3 or solid[0].kind is not AtomKind.RELATION:
        return False
    known, new = solid[1].noun, solid[2].noun
    if known is None or new is None or not solid[1].is_actor or not solid[2].is_actor:
        return False
    told = known.determiner is Determiner.DEFINITE or known.kind is NounKind.PRONOUN
    return told and (new.determiner is Determiner.INDEFINITE or new.count > 0)


def _is_share(ahead: Sequence[Atom]) -> bool:
    """`two drones, one at 40 m, the other at 60 m`: what each of them has."""
    first = first_solid(ahead)
    member = first is not None and first.noun is not None and first.noun.kind is NounKind.PRONOUN
    told = any(a.measure is not None for a in ahead)
    named = first is not None and first.key in ('one', 'other', 'another')
    return member and told and (named or (first is not None and first.key.startswith('nth')))


def _is_ratio_of_sight(ahead: Sequence[Atom]) -> bool:
    """`tracked for 90 % of the time, visible for 75 %`: each share is a demand of its own."""
    seen = any(a.kind is AtomKind.IN_VIEW for a in ahead)
    return seen and any(a.key == RATIO for a in ahead)


def _of_another(values: Sequence[Atom], ahead: Sequence[Atom]) -> bool:
    """`altitude 100 ft, truck doing 25 mph`: a height is not that of a truck."""
    high = any(a.kind is AtomKind.THING and a.key in _FLOWN for a in values)
    solid = first_solid(ahead)
    grounded = solid is not None and solid.is_actor and not _flies(solid)
    return high and grounded


def _flies(atom: Atom) -> bool:
    return atom.noun is not None and atom.noun.kind in (NounKind.UAV, NounKind.PRONOUN)


def _is_adjunct(atoms: Sequence[Atom]) -> bool:
    """A phrase that needs a clause: a measure or place that no actor or world word leads."""
    solid = first_solid(atoms)
    if solid is None or solid.is_actor:
        return False
    if any(a.kind in (AtomKind.WORLD, AtomKind.NO_TRAFFIC, AtomKind.SCENARIO) for a in atoms):
        return False
    if any(a.kind is AtomKind.IN_VIEW for a in atoms) and any(a.key == RATIO for a in atoms):
        return False  # `visible at least 60 %`
    return any(
        a.kind in (AtomKind.MEASURE, AtomKind.RELATION, AtomKind.THING) or a.noun is not None
        for a in atoms
    )
