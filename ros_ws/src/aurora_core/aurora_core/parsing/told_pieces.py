# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a clause tells before it is read: an arrival, a phase that is over, the last one again."""

from __future__ import annotations

from dataclasses import replace

from aurora_core.parsing.atoms import AtomKind, NounKind
from aurora_core.parsing.phases import PHASES
from aurora_core.parsing.pieces import Link, Piece, first_solid

_GROUND = (NounKind.AGENT, NounKind.VEHICLE, NounKind.EGO)


def is_arrival(piece: Piece) -> bool:
    """Return whether a clause only tells that a ground agent gets somewhere."""
    verb = next((a for a in piece.atoms if a.kind is AtomKind.VERB), None)
    first = first_solid(piece.atoms)
    told = piece.link is Link.MAIN and verb is not None and verb.key in ('reach', 'step_onto')
    grounded = first is not None and first.noun is not None and first.noun.kind in _GROUND
    return told and grounded and any(a.is_place for a in piece.atoms)


def got_message(piece: Piece) -> bool:
    """`B gets the message and tracks the bus`: told as a fact, meant as a cause."""
    verb = next((a for a in piece.atoms if a.kind is AtomKind.VERB), None)
    got = verb is not None and verb.key in ('receive', 'come', 'contain')
    message = any(a.kind is AtomKind.MESSAGE for a in piece.atoms) or (
        verb is not None and (verb.key == 'receive' or piece.atoms[-1].words == 'it')
    )
    named = any(a.is_actor for a in piece.atoms)
    source = any(a.kind is AtomKind.PREPOSITION for a in piece.atoms)
    denied = any(a.kind is AtomKind.NEGATION for a in piece.atoms)
    return piece.link is Link.MAIN and got and message and named and not source and not denied


# What happens at once and may be a cause.
_AT_ONCE = ('vanish', 'exceed', 'lose', 'fall_below', 'receive', 'appear')


def leads_to(piece: Piece) -> bool:
    """`van gets occluded -> drone warns the ego`: only what happens at once is a cause."""
    verb = next((a for a in piece.atoms if a.kind is AtomKind.VERB), None)
    return piece.link is Link.MAIN and verb is not None and verb.key in _AT_ONCE


def is_phase(piece: Piece) -> bool:
    """Return whether a clause tells a phase with its duration as done: `has hovered for 20 s`."""
    verb = next((a for a in piece.atoms if a.kind is AtomKind.VERB), None)
    done = any(a.kind is AtomKind.AUXILIARY and a.key in ('have', 'spend') for a in piece.atoms)
    lasted = any(a.measure is not None and a.key == 'time' for a in piece.atoms)
    if verb is None or not done or not lasted:
        return False
    there = any(a.noun is not None and a.noun.key == 'there' for a in piece.atoms)
    return verb.key in PHASES or (verb.key == 'be' and there)


def was_doing(piece: Piece) -> bool:
    """`the drone is hovering there when a bus stops`: what it does when something happens."""
    verb = next((i for i, a in enumerate(piece.atoms) if a.kind is AtomKind.VERB), None)
    if verb is None or piece.link is not Link.MAIN or piece.atoms[verb].form.value != 'ing':
        return False
    helped = any(a.kind is AtomKind.AUXILIARY and a.key == 'be' for a in piece.atoms[:verb])
    return helped and piece.atoms[verb].key in PHASES | {'drive', 'navigate'}


def is_earlier(piece: Piece) -> bool:
    """`… follows it after ascending to 40 m`: told second, done first."""
    if piece.link is not Link.AFTER:
        return False
    first = first_solid(piece.atoms)
    if any(a.kind is AtomKind.MESSAGE for a in piece.atoms):
        return False  # `lands after getting the message`
    gerund = first is not None and first.form.value == 'ing' and first.key not in HAPPENS
    return gerund or is_phase(piece)


# `after seeing a bus`: what one waits for, not what one does first.
HAPPENS = ('see', 'lose', 'receive', 'alert', 'send', 'report')


def is_ellipsis(piece: Piece) -> bool:
    """`when it does`, `once it has`: the clause before, again."""
    solid = [a for a in piece.atoms if a.kind is not AtomKind.FILL]
    verbs = [a for a in solid if a.kind in (AtomKind.VERB, AtomKind.AUXILIARY)]
    words = verbs and verbs[-1].key in ('trace', 'contain', 'be', 'have', 'do')
    return bool(words) and solid[-1] is verbs[-1] and len(solid) == 2 and solid[0].is_actor


def without_link(piece: Piece, link: Link) -> Piece:
    """Return a clause that was told before, as the cause that a later one refers to."""
    return replace(piece, link=link, then=False, head=None)
