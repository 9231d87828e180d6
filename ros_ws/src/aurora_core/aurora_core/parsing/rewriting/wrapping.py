# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What stands around a request: who wishes it, how politely, and why.

`We work on X, which is why we would be glad if you could set up …`, `what counts is that …`,
`a simple picture would be very welcome`. The wish is a frame; what asks nothing is background.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import lru_cache

from aurora_core.parsing.atom_runs import runs, skip, text_of
from aurora_core.parsing.atoms import Atom, AtomKind, Determiner, NounKind, NounPhrase
from aurora_core.parsing.data_files import read_data
from aurora_core.parsing.lexicon import expanded
from aurora_core.parsing.measures import COUNT
from aurora_core.parsing.morphology import VerbForm
from aurora_core.spec.parameter import Span

# What asks for something wherever it stands.
_TELLING = frozenset(
    {
        AtomKind.WORLD,
        AtomKind.NO_TRAFFIC,
        AtomKind.IN_VIEW,
        AtomKind.NEGATION,
        AtomKind.STREETS_FLAG,
        AtomKind.SIREN,
        AtomKind.IN_FLIGHT,
    }
)
_NAMED = (NounKind.AGENT, NounKind.VEHICLE, NounKind.UAV, NounKind.UNSUPPORTED, NounKind.AMBIGUOUS)
_NEW = (Determiner.INDEFINITE, Determiner.ONE, Determiner.ANOTHER)
# What may be said of anything: a unicorn that crosses the road is asked for.
_IDLE = frozenset({'be', 'come', 'contain', 'exist', 'keep', 'last', 'trace', 'put', 'see'})
_WHERE = (NounKind.LANDMARK, NounKind.MISSING_LANDMARK)


def unwrap(atoms: Sequence[Atom], prompt: str) -> tuple[list[Atom], list[Span]]:
    """Return the atoms with wishes as frames and without background, and what was left out."""
    kept: list[Atom] = []
    spans: list[Span] = []
    for sentence, stop in runs(atoms, AtomKind.STOP):
        told, left_out = _sentence(tuple(sentence), prompt)
        kept += told
        spans += left_out
        if stop is not None:
            kept.append(stop)
    return kept, spans


# A second look reads the other sentences of a prompt again and again.
@lru_cache(maxsize=64)
def _sentence(atoms: tuple[Atom, ...], prompt: str) -> tuple[tuple[Atom, ...], tuple[Span, ...]]:
    asked, reasons = _without_reasons(atoms, prompt)
    told, left_out = _without_background(asked, prompt)
    return tuple(told), (*reasons, *left_out)


def _without_background(atoms: list[Atom], prompt: str) -> tuple[list[Atom], list[Span]]:
    if not atoms:
        return [], []
    begin, end = atoms[0].start, atoms[-1].end
    text = prompt[begin:end].lower().replace('’', "'")
    found = list(_find(text, begin))
    wishes = [span for span, _ in found]
    demanded = [span for span, is_demand in found if is_demand]
    kept: list[Atom] = []
    spans: list[Span] = []
    chunk: list[Atom] = []
    framed = False
    for atom in (*atoms, None):
        wish = next((w for w in wishes if atom is not None and _within(atom, w)), None)
        if atom is not None and wish is None:
            chunk.append(atom)
            continue
        if chunk and _is_background(chunk, prompt, before_wish=atom is not None, framed=framed):
            spans.append(Span(start=chunk[0].start, end=chunk[-1].end))
        else:
            kept += chunk
        chunk = []
        if atom is not None:
            key = 'demand' if wish in demanded else 'wish'
            kept.append(replace(atom, kind=AtomKind.FRAME, key=key, noun=None, measure=None))
            framed = True
    return kept, spans


_REASONS = frozenset(
    {'because', 'since', 'given that', 'seeing that', 'seeing as', 'considering that'}
)


def _without_reasons(atoms: Sequence[Atom], prompt: str) -> tuple[list[Atom], list[Span]]:
    """`because the camera smears otherwise, …`, `so that the crew may rest`: no part of a wish."""
    kept: list[Atom] = []
    spans: list[Span] = []
    i = 0
    while i < len(atoms):
        stop = i + 1
        reason = atoms[i].kind is AtomKind.CONJUNCTION and atoms[i].key in _REASONS
        purpose = atoms[i].kind is AtomKind.FRAME and _purpose().match(text_of(atoms[i], prompt))
        if reason or purpose:
            while stop < len(atoms) and not _goes_on(atoms, stop):
                stop += 1
        told = atoms[i + 1 : stop]
        strange = any(_is_strange(a) for a in told)
        shown = purpose and any(a.noun is not None and a.noun.kind in _NAMED for a in told)
        idle = strange and not shown and not _asks(told, prompt, before_wish=reason)
        if idle or (reason and _is_foreign(told)):
            spans.append(Span(start=atoms[i].start, end=told[-1].end))
        else:
            kept += atoms[i:stop]
        i = stop
    return kept, spans


def _goes_on(atoms: Sequence[Atom], i: int) -> bool:
    """`because the crew wants that | and then lands`: what follows is asked for again."""
    if atoms[i].kind in (AtomKind.COMMA, AtomKind.THEN):
        return True
    k = skip(atoms, i + 1)
    joined = atoms[i].kind is AtomKind.CONJUNCTION and k < len(atoms)
    return joined and (atoms[k].kind in (AtomKind.VERB, AtomKind.THEN))


def _within(atom: Atom, span: Span) -> bool:
    return span.start <= atom.start and atom.end <= span.end


def _find(text: str, offset: int) -> Iterator[tuple[Span, bool]]:
    """Yield every wish, and whether it names a condition of success."""
    if not _may_wish(text):
        return
    for match in _wishes().finditer(text):
        asks = match['demand'] is not None
        yield Span(start=offset + match.start(), end=offset + match.end()), asks
        for again in _AND_IF.finditer(text, match.end()) if asks else ():
            yield Span(start=offset + again.start(), end=offset + again.end()), True


# `it passes if … and if …`: behind the second one no effect of its own follows.
_AND_IF = re.compile(r'\band\s+(?:also\s+|only\s+)*(?:if|when|provided that)\b(?=[^,]*$)')


def _is_background(atoms: Sequence[Atom], prompt: str, *, before_wish: bool, framed: bool) -> bool:
    """Return whether words tell of the speaker or of the world at large, and ask nothing."""
    solid = [a for a in atoms if a.kind not in (AtomKind.COMMA, AtomKind.CONJUNCTION)]
    if not solid:
        return False
    words = [prompt[a.start : a.end] for a in atoms if before_wish or a.kind is not AtomKind.FRAME]
    text = ' '.join(words).lower().replace('’', "'")
    personal = _speaker().search(text) is not None
    idle = all(a.kind is not AtomKind.VERB or a.key in _IDLE for a in solid)
    strange = (idle or _purpose().search(text)) and any(_is_strange(a) for a in solid)
    if not personal and not (strange and (before_wish or framed)):
        return False
    return not _asks(solid, prompt, before_wish=before_wish)


def _is_strange(atom: Atom) -> bool:
    unknown = atom.noun is not None and atom.noun.kind is NounKind.UNKNOWN
    return unknown or (atom.kind is AtomKind.UNKNOWN and atom.key.isalpha())


def _is_foreign(atoms: Sequence[Atom]) -> bool:
    """`since that is where their balloon flew`: of an actor that no scene can have, told of."""
    nouns = [a.noun for a in atoms if a.noun is not None]
    new = any(n.determiner in _NEW or n.determiner is Determiner.MY for n in nouns)
    told = any(n.kind is NounKind.UNSUPPORTED for n in nouns)
    return told and not new and not any(a.measure is not None for a in atoms)


def _asks(atoms: Sequence[Atom], prompt: str, *, before_wish: bool) -> bool:
    acting = any(a.kind is AtomKind.VERB for a in atoms)
    headed = _is_strange(atoms[0])
    for i, atom in enumerate(atoms):
        if atom.kind in _TELLING:
            return True
        measure = atom.measure
        digits = any(c.isdigit() for c in prompt[atom.start : atom.end])
        if digits or (measure is not None and measure.dimension != COUNT):
            return True
        noun = atom.noun
        if noun is None:
            continue
        counted = noun.count > 1 and noun.kind in _NAMED
        if noun.plural and noun.determiner is Determiner.BARE and not counted:
            continue
        if counted or (noun.kind in _WHERE and not before_wish):
            return True
        if noun.kind is NounKind.LANDMARK or _meets_ego(atoms, i):
            return True
        if noun.kind is NounKind.PRONOUN and _acts(atoms, i) and not before_wish:
            return True
        told = _matters(noun) or not before_wish or _acts(atoms, i)
        if noun.kind in _NAMED and told and not (headed and not acting):
            return True
    return False


def _meets_ego(atoms: Sequence[Atom], i: int) -> bool:
    """`follows us`, `behind me`, `my car`; `has asked us` is no part of the scene."""
    noun = atoms[i].noun
    if noun is None or noun.kind is not NounKind.EGO:
        return False
    before = atoms[i - 1] if i else None
    if noun.determiner is not Determiner.BARE or noun.key not in ('us', 'me', 'i'):
        return True
    acted = before is not None and before.kind is AtomKind.VERB
    return before is not None and (
        before.kind is AtomKind.RELATION or (acted and before.key not in (*_IDLE, 'alert'))
    )


def _matters(noun: NounPhrase) -> bool:
    """`drivers who come up behind cyclists` are nobody of the scene; `a drone` is."""
    return noun.determiner in (*_NEW, Determiner.MY) or noun.index > 0


def _acts(atoms: Sequence[Atom], i: int) -> bool:
    behind = atoms[i + 1] if i + 1 < len(atoms) else None
    finite = (AtomKind.VERB, AtomKind.AUXILIARY)
    return behind is not None and behind.kind in finite and behind.form is not VerbForm.PAST


def _any_of(words: Sequence[str]) -> str:
    longest = sorted(words, key=len, reverse=True)
    return '(?:' + '|'.join(re.escape(w).replace(r'\ ', r'\s+') for w in longest) + ')'


@lru_cache(maxsize=1)
def _speaker() -> re.Pattern[str]:
    words = read_data('lexicon.yaml')['wishes']
    return re.compile(rf'\b{_any_of(words["speaker_words"])}\b')


@lru_cache(maxsize=1)
def _purpose() -> re.Pattern[str]:
    words = read_data('lexicon.yaml')['wishes']
    return re.compile(rf'^\W*{_any_of(words["purposes"])}\b')


# What a wish cannot do without: each alternative of `_wishes` needs one phrase of each list in one
# of these rows, or a word of the last one.
_NEEDED = (
    *(('wish',), ('please',), ('sure',), ('point',), ('success',), ('verdicts',), ('asides',)),
    *(('stipulates',), ('good',), ('modals', 'speakers', 'make')),
)
_NEEDED_WORDS = ('as follows', 'like this', 'the following')


def _may_wish(text: str) -> bool:
    """Return whether one of `_wishes` can stand in a text; that pattern takes long to compile."""
    if any(words in text for words in _NEEDED_WORDS):
        return True
    spoken = frozenset(_SPOKEN.findall(text))
    return any(all(_is_said(name, text, spoken) for name in row) for row in _NEEDED)


def _is_said(name: str, text: str, spoken: frozenset[str]) -> bool:
    heads = _said_in_wishes()[name]
    return any(
        all(words in text for words in rest)
        for head in spoken & heads.keys()
        for rest in heads[head]
    )


# `it's` is looked up by `it`.
_SPOKEN = re.compile(r'\w+')


@lru_cache(maxsize=1)
def _said_in_wishes() -> dict[str, dict[str, list[list[str]]]]:
    """Return the words of each phrase of the lists, by the first one."""
    lists = read_data('lexicon.yaml')['wishes']
    found: dict[str, dict[str, list[list[str]]]] = {}
    for name in {name for row in _NEEDED for name in row}:
        heads = found[name] = {}
        for phrase in expanded(lists[name]):
            heads.setdefault(_SPOKEN.findall(phrase)[0], []).append(phrase.split())
    return found


@lru_cache(maxsize=1)
def _wishes() -> re.Pattern[str]:
    """Return the pattern of all frames that the lists of the lexicon make."""
    lists = read_data('lexicon.yaml')['wishes']
    words = {name: _any_of([*expanded(listed)]) for name, listed in lists.items()}
    blank = r',?\s+'
    who = words['speakers']
    hedge = rf'(?:{blank}{words["hedges"]})*'
    modal = rf'(?:{blank}{words["modals"]})*'
    link = rf'(?:{words["links"]}{blank})*'
    see = rf'(?:{blank}(?:to\s+)?{words["see"]})?'
    make = rf'(?:{blank}(?:to\s+)?{words["make"]})?'
    help_me = rf'(?:{blank}(?:if|that|whether)\s+{who}{hedge}{modal}{hedge}{make})?'
    wish = rf'{modal}{hedge}{modal}{hedge}{blank}{words["wish"]}{hedge}'
    follows = rf'(?:{blank}(?:as follows|the following|this|simply|just))?'
    copula = rf'{modal}{blank}(?:is|are|be|was|reads)\b{follows}(?:{blank}that\b)?'
    patterns = (
        rf'(?:{words["what"]}(?:\s+(?:that|which))?{blank})?{who}{wish}{see}{make}'
        rf'(?:{blank}{words["about"]})*{copula}',
        rf'{link}{who}{wish}(?:{blank}{words["about"]})?{help_me}{see}{make}(?:{blank}that\b)?',
        rf'(?:and|but)(?:{blank}(?:would|should|could|might|may)){hedge}{blank}{words["wish"]}'
        rf'(?:{blank}{words["about"]})?{help_me}{see}{make}(?:{blank}that\b)?',
        rf'(?:the|my|our)(?:\s+\w+){{1,3}}?{modal}\s+(?:is|are|be|looks?|goes|go|reads?|runs?)\s+'
        rf'(?:as follows|like this|the following)',
        rf'{link}{words["modals"]}\s+{who}{hedge}{blank}(?:{words["kind"]}{blank})?'
        rf'{words["make"]}(?:{blank}that\b)?',
        rf'{link}{words["please"]}{hedge}{make}(?:{blank}that\b)?',
        rf'{link}{words["it_is"]}{hedge}\s+{words["good"]}(?:{blank}{words["for_us"]})?'
        rf'{blank}(?:that|if){help_me}\b',
        rf'{link}{words["it_is"]}{hedge}\s+{words["good"]}(?:{blank}{words["for_us"]})?'
        rf'{blank}to\s+{words["see"]}',
        rf'{link}{words["sure"]}(?:{blank}that\b)?',
        rf'{link}{words["point"]}(?:{blank}{words["for_us"]})?{blank}(?:is|means)(?:{blank}that\b)?',
        rf'(?P<demand>(?:{link}{words["success"]}|(?:the|this|that|our|my|each)(?:\s+\w+){{1,3}}?'
        rf'\s+{words["verdicts"]}){blank}(?:only\s+)?(?:if|when|provided that|as long as|that)\b)',
        rf'(?:the|our|my|this|that)(?:\s+\w+){{1,3}}?\s+{words["stipulates"]}'
        rf'(?=\s+(?:{words["about_so_much"]}\s+)?\d)',
        rf'would\s+be{hedge}\s+{words["good"]}(?:{blank}{words["for_us"]})?(?=[\s,]*$)',
        rf'{words["asides"]}',
    )
    return re.compile('|'.join(rf'\b(?:{p})(?!\w)' for p in patterns))
