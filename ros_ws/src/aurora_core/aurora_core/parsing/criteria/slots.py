# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Reads a clause as a condition: every word has a place in it, or it is none."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.criteria.criterion import Criterion, Limit, Op, take_places
from aurora_core.parsing.criteria.moments import Moment, with_events
from aurora_core.parsing.criteria.told import Told, told
from aurora_core.parsing.criteria.words import Words, criteria_words, whole
from aurora_core.parsing.measures import Measure
from aurora_core.parsing.reactions import REACTIONS

# `must not come within 10 m` keeps 10 m off.
_FLIPS = ('<', '>')
_FLIPPED: dict[Op, Op] = {'<': '>=', '<=': '>=', '>': '<=', '>=': '<', '==': '=='}
_CLOCK = r'(?:(?:the|a|time|t|=|second|mark|at|first|that|point|moment|s|about|of) )*'
# `should go up to 40 m` is a climb to it and no bound.
_RISES = re.compile(r'\b(?:ascend|climb|fly|go|lift|move|rise)(?:e?s)?\s+$')
_BARE = re.compile(r'\b[A-Z]\d+\b')
_OWNED = whole(r'(?:its|their|his|her)')
# At most a fifth out of sight is at least four fifths in sight.
_MIRRORED: dict[Op, Op] = {'<': '>', '<=': '>=', '>': '<', '>=': '<=', '==': '=='}
# `the test fails if …` asks for the contrary.
_CONTRARY: dict[Op, Op] = {'<': '>=', '<=': '>', '>': '<=', '>=': '<', '==': '=='}
# Words about something else make it another clause: `is followed, 35 m away`.
_TOPICS_OF = {
    'L': frozenset({'drift', 'horizontal', 'altitude', 'distance', 'pairs'}),
    'V': frozenset({'speed', 'altitude'}),
    'T': frozenset({'seen', 'delivered', 'latency'}),
    'P': frozenset({'battery', 'seen', 'tracked', 'delivered'}),
    'C': frozenset({'waypoints', 'seen', 'tracked', 'delivered'}),
    '': frozenset({'landed', 'completed', 'delivered'}),
}
# `should it slow below 3 m/s, …` is a cause.
_INVERTED = re.compile(r' should (?:the |its |a |an )?\w* ?(?:N\d|speed|distance|gap|altitude)')
# `must stay below 10 m/s until the bus stops` holds for a part of the run only.
_PART = re.compile(
    r'\b(?:before|until|till|once|after|unless|as soon as) (?:(?:the|a|an|it|they|its) )*N\d+ '
    r'(?:is|are|was|has|have|had|reach|arriv|pass|start|stop|land|get|come|enter|leave)'
)
_AFTER = re.compile(r'\b(?:to|from|of) (?:either|any|both|them|all|each)?(?: of)? ?N\d')
_HAPPENS = re.compile(
    r' (?:(?:and|but|the|its|their|so|please|make|sure|that|check|ensure|verify|N\d+|\'s) )*E0 '
    r'(?:of (?:the )?N\d+ )?(?:\w+ ){0,3}'
    r'(?:has|have|must|should|may|shall|is|needs|ought|can|shd|not|at|by|between|no|nolater) '
)
# `the ego shall have started braking before t = 15 s`
_HAPPENED = re.compile(
    r' (?:(?:and|but|that|the|please|make|sure|check|ensure|verify) )*N0 '
    r'(?:must|should|shall|has to|have to|needs to|need to|ought to|shd|is to|has got to) '
    r'(?:(?:already|at last|finally) )?(?P<done>have )?(?:(?:already|at last|finally) )?'
    r'(?:(?:started|begun|finished|completed|done|made|start|begin)(?: to| its| the| a| with)* )?'
    r'(?:come to a )?E0 '
)
# `the alert must have been sent by t = 30 s`, not `within 30 s`: that counts from its cause.
_SENT = re.compile(
    r' (?:(?:and|but|that|the|its|this|any) )*E0 (?:(?:from|to|of|by) N\d+ )*'
    r'(?:must|should|shall|has to|have to|needs to|need to|ought to|is to|are to) '
    r'(?:(?:have|be|been|already|also|go|gone) )*'
    r'(?:sent|issued|raised|given|emitted|transmitted|broadcast|dispatched|released|triggered|'
    r'fired|made|out|on its way)(?: (?:out|off))?(?: (?:from|to|by) N\d+)* '
)
# `must not cross 40 km/h`: a limit, no street.
_CROSSING = re.compile(r'\bcross(?:es|ed|ing)? (?=[LV]\d)')
# `must have stopped within 6 s of that`
_OF_THAT = re.compile(r'T\d+ (?:of|after|from|following|since) (?:that|this|which|it N\d+|it)\b')
_BOUNDED = re.compile(r'\b(?:atleast|atmost|nolater)\b')
_LATEST = re.compile(r'\b(?:by|before|nolater|latest)\b')
_LASTS = re.compile(r'\b(?:keep|maintain|remain|stay)(?:s|ing)?\b')
_YES_OR_NO = ('landed', 'completed', 'delivered')


def criterion(atoms: Sequence[Atom], *, asked: bool = False) -> Criterion | None:
    """Return the condition that a clause states, None when it says anything else.

    Args:
        atoms: Of the clause.
        asked: It needs no word that asks for something: it stands behind `when`.
    """
    return _criterion(tuple(atoms), asked)


# Cuts of one sentence, and readings of it without a word, ask for the same stretches again.
@lru_cache(maxsize=1024)
def _criterion(atoms: tuple[Atom, ...], asked: bool) -> Criterion | None:
    if atoms and atoms[-1].kind is AtomKind.PREPOSITION and atoms[-1].key == 'of':
        return None  # `within 6 s of`: of what, stands outside
    rest, placed = take_places(atoms)
    if any(one.at_place for one in placed):  # `a van on the main road must not exceed 40 km/h`
        found = _Reading(told(rest), criteria_words()).run(asked=asked)
        kind = found.limits[0].dimension if found is not None and found.limits else ''
        if found is not None and (kind == 'V' or (kind == 'L' and len(found.nouns) > 1)):
            return replace(found, placed=placed)
    sided = any(a.kind is AtomKind.RELATION and a.key in ('left', 'right') for a in rest)
    if sided:  # `always staying on its left, 25 m away`: a flight
        return None
    found = _Reading(told(atoms), criteria_words()).run(asked=asked)
    if found is not None or not placed:
        return found
    found = _Reading(told(rest), criteria_words()).run(asked=asked)
    return replace(found, placed=placed) if found is not None else None


class _Reading:
    """The line, from which what is understood is taken out."""

    def __init__(self, line: Told, words: Words) -> None:
        self._line = line
        self._words = words
        self._text = line.text
        self._begin = line.text
        self._crosses = False
        self._fails = False  # what is told must not be
        self._unseen = False  # the share of the time out of sight

    def run(self, *, asked: bool = False) -> Criterion | None:
        words = self._words
        self._crosses = asked
        if _INVERTED.match(self._text) or _PART.search(self._text):
            return None
        if _OF_THAT.search(self._text):
            return None  # an order: from what was told before
        self._text = _CROSSING.sub('exceed ', self._text)
        self._fails = self._cut(words['fails'])
        asked = asked or self._fails or bool(words['demands'].search(self._text))
        named = self._line.plain and words['names_measured'].search(self._text) is not None
        if not asked and not named and not self._is_bounded():
            return None
        self._unseen = words['unseen'].search(self._text) is not None
        event = self._event()
        topics = frozenset(k for k, p in words.topics.items() if p.search(self._text))
        if self._unseen:
            self._cut(words['unseen'])
            if words.topics['seen'].search(self._text):
                return None  # `ought to see it, and should it be hidden, …`
            topics |= {'seen'}
        waits = event is not None and re.search(r'\b(?:not|never) (?:\w+ )?before\b', self._text)
        by = None if waits else self._deadline(topics)
        between = self._between()
        self._cut(words['frames'], words['always'], words['sometime'])
        if 'horizontal' in topics:
            self._cut(words.topics['horizontal'])
        share = self._share()
        hold, unbroken = self._hold(topics)
        self._cut(words['altogether'])
        negated = self._negations()
        if (self._fails or self._unseen) and (between or hold or (share and by)):
            return None
        if share is not None and negated and share.op in _FLIPS:
            share, negated = replace(share, op=_FLIPPED[share.op]), False
        limits = between or self._limits(negated)
        if share is not None and limits is not None:
            if (negated and not limits) or (limits and (self._fails or self._unseen)):
                return None
            limits, share = self._meant(limits, share)
        if limits is None or len({limit.dimension for limit in limits}) > 1:
            return None
        throughout = negated or _LASTS.search(self._begin)
        if throughout and by is not None and limits and limits[0].dimension in 'LV':
            return None  # `must not exceed 10 m/s within 20 s`: at every moment of these
        if not limits and share is None and hold is None:
            plain = by is not None or words['musts'].search(self._begin)
            if (
                negated is not self._fails
                or not plain
                or not (topics & set(_YES_OR_NO) or (event and by))
            ):
                return None
        if limits and (share or hold) and limits[0].name[0] not in 'LV':
            return None
        if hold is not None and (share is not None or (negated and limits)):
            return None
        used = _TOPICS_OF[(limits[0].name[0] if limits else 'P' if share else 'T' if hold else '')]
        if hold is not None and not limits and not topics & {'seen', 'delivered', 'latency'}:
            return None
        topics &= used
        for name in used:
            self._cut(words.topics[name])
        self._cut(words['objects'], words['demands'], words['from_start'], words['always'])
        left = re.sub(r'\bN\d+\b', ' ', self._text)
        left = words['fill'].sub(' ', left)
        if left.strip(' ,.;:\'"()-='):
            return None
        return Criterion(
            limits=limits,
            hold=hold,
            unbroken=unbroken,
            by=by,
            share=share,
            topics=topics,
            nouns=tuple(self._line.nouns.values()),
            event=event,
            owned=bool(_OWNED.search(self._begin)),
            others=self._is_of_others(limits),
            words=self._begin,
        )

    def _is_bounded(self) -> bool:
        bounded = _BOUNDED.search(self._text) or self._words['or_more'].search(self._text)
        return bounded is not None

    def _event(self) -> Moment | None:
        """`the crossing must not begin before 20 s`: what only happens, as a noun in front."""
        text, moments = with_events(self._text)
        heads = _HAPPENS.match(text)
        happened = _HAPPENED.match(text)
        done = happened is not None and (happened['done'] or _LATEST.search(text))
        if done and moments[0].key in REACTIONS:  # `must have landed` is a state
            heads = happened
        sent = _SENT.match(text)
        if sent is not None and len(moments) == 1 and moments[0].key == 'send':
            self._text = f' {text[sent.end() :]}'
            return moments[0] if self._from_start() else None
        if heads is None or len(moments) != 1 or moments[0].key in ('mission', 'send', 'receive'):
            return None
        self._text = self._text.replace(moments[0].words, ' ', 1)
        return moments[0]

    def _from_start(self) -> bool:
        told = re.search(
            r'\b(?:before|until|nolater|latest|by (?:t |the |= |time )*T\d)', self._text
        )
        return told is not None or self._words['from_start'].search(self._text) is not None

    def _is_of_others(self, limits: tuple[Limit, ...]) -> bool:
        """`…, never nearer than 20 m to either`: who acts was told before."""
        if not limits or not limits[0].name.startswith('L'):
            return False
        before, _, after = self._begin.partition(f'{limits[0].name} ')
        return 'N' not in before and _AFTER.search(after) is not None

    def _cut(self, *patterns: re.Pattern[str]) -> bool:
        found = False
        for pattern in patterns:
            self._text, count = pattern.subn(' ', self._text)
            self._text = re.sub(r' +', ' ', self._text)
            found = found or count > 0
        return found

    def _take(self, pattern: str) -> re.Match[str] | None:
        match = re.search(rf"(?<![\w'])(?:{pattern})(?![\w'])", self._text)
        if match is not None:
            self._text = f'{self._text[: match.start()]} {self._text[match.end() :]}'
            self._text = re.sub(r' +', ' ', self._text)
        return match

    # --- time ---------------------------------------------------------------------------------

    def _deadline(self, topics: frozenset[str]) -> Measure | None:
        """`by t = 45 s`, `no later than 40 s into the run`, `within 20 s of the start`."""
        by = self._words['by'].pattern
        start = self._words['from_start'].pattern
        word = rf'(?:{by}) {_CLOCK}(?:{by} )?{_CLOCK}(?:atmost |nolater )?(T\d+)'
        told = (
            self._take(rf'{word} (?:{start})(?: {start})?')
            or self._take(rf'(?:atmost|nolater) (T\d+) (?:{start})(?: {start})?')
            or self._take(rf'(?:at )?{_CLOCK}(T\d+)(?: {start})? (?:at the latest|at latest)')
        )
        # Behind a message a time without a start is how long it takes.
        if told is None and not topics & {'delivered', 'latency'}:
            told = self._take(word) or self._take(r'nolater (T\d+)')
        if told is None:
            told = self._take(rf'(?:by|before|until) {_CLOCK}(T\d+)')
        if told is None and not topics & {'delivered', 'latency', 'seen', 'tracked'}:
            told = self._take(r'(?:after|in) atmost (T\d+)')
        return self._line.measures[told.group(1)] if told is not None else None

    def _hold(self, topics: frozenset[str]) -> tuple[Limit | None, bool]:
        """`for at least 8 s in a row`: how long."""
        more, less = self._words['more'].pattern, self._words['less'].pattern
        unbroken = bool(self._words['unbroken'].search(self._text))
        told = self._take(
            rf'(?:for|during|over|lasting|a (?:total|period|stretch|minimum) of) '
            rf'(?:(?:an?|the|one|single|{self._words["unbroken"].pattern}|period|stretch|of|total|minimum|time|'
            rf'interval|no|not) )*'
            rf'(?P<cmp>(?:{more}|{less}|at ?least|at ?most) (?:than )?)?(?P<t>T\d+)'
            rf'(?P<or>(?: or (?:more|longer))| at least| min(?:imum)?)?'
        )
        if told is None and topics & {'seen', 'tracked'}:
            told = self._take(
                rf'(?P<cmp>(?:{more}|{less}|at ?least|at ?most) (?:than )?)?(?P<t>T\d+)'
                rf'(?P<or>(?: or (?:more|longer))| at least| min(?:imum)?)?'
            )
        self._cut(self._words['unbroken'])
        if told is None:
            return None, unbroken
        compared = (told.group('cmp') or '').strip()
        negated = bool(re.search(r'\b(?:no|not)\b', told.group(0)))
        op: Op = '>=' if not compared or compared in ('atleast', 'at least') else '>'
        if re.match(self._words['less'].pattern, compared):
            op = '>=' if negated else '<'
        elif compared in ('atmost', 'at most') or negated:
            op = '<='
        name = told.group('t')
        return Limit(op=op, measure=self._line.measures[name], name=name), unbroken

    def _share(self) -> Limit | None:
        """`for 80 % of the time`."""
        phases = self._words['phases'].pattern
        word = r'(?:for|during|in|over|on|throughout)?'
        more, less = self._words['more'].pattern, self._words['less'].pattern
        told = self._take(
            rf'{word} ?(?:(?:a|the|all|of) )*'
            rf'(?P<not>(?:no|not|never) (?:any )?)?(?P<cmp>(?:{more}|{less}) (?:than )?)?(?:of )?'
            rf'(?:at ?least |at ?most )?(?P<p>P\d+)(?: at least| or (?:more|better|higher)| min)?'
            rf' ?(?:{phases})(?: at least| or (?:more|better|higher)| min(?:imum)?)?'
            rf'(?: at a minimum)?'
        )
        if told is None:
            return None
        name = told.group('p')
        op: Op = '<=' if 'atmost' in told.group(0) else '>='
        if told.group('cmp'):
            op = '<' if re.match(self._words['less'].pattern, told.group('cmp')) else '>'
            op = _FLIPPED[op] if told.group('not') else op
        return Limit(op=op, measure=self._line.measures[name], name=name)

    def _meant(self, limits: tuple[Limit, ...], share: Limit) -> tuple[tuple[Limit, ...], Limit]:
        """`hidden for 20 % at most`, `over 15 m for 5 % at most`: the contrary for the rest."""
        if self._fails:
            share = replace(share, op=_CONTRARY[share.op])
        rare = bool(limits) and share.op in ('<', '<=')
        if rare:
            limits = tuple(replace(one, op=_CONTRARY[one.op]) for one in limits)
        if rare or self._unseen:
            rest = replace(share.measure, value=round(1.0 - share.measure.value, 6))
            share = replace(share, op=_MIRRORED[share.op], measure=rest)
        return limits, share

    # --- numbers ------------------------------------------------------------------------------

    def _between(self) -> tuple[Limit, ...]:
        """`between t = 15 s and t = 50 s`, `not below 20 m nor above 40 m` are two limits."""
        found = self._take(
            rf'(?:between|from|in the (?:window|interval|range) (?:from|of|between)) {_CLOCK}'
            rf'([LTVPC]\d+) (?:and|to|until|till|-) {_CLOCK}([LTVPC]\d+)'
        )
        names = found.groups() if found is not None else ()
        if found is None:
            for name, measure in self._line.measures.items():
                if measure.upper is not None and self._take(rf'(?:between |from )?{name}'):
                    return (
                        Limit(op='>=', measure=measure, name=name),
                        Limit(op='<=', measure=_upper(measure), name=name),
                    )
            return ()
        low, high = names
        if low[0] != high[0]:
            return ()
        return (
            Limit(op='>=', measure=self._line.measures[low], name=low),
            Limit(op='<=', measure=self._line.measures[high], name=high),
        )

    def _negations(self) -> bool:
        # `no less than`, `no smaller than` belong to the number
        low = self._words['less'].pattern
        high = self._words['more'].pattern
        self._text = re.sub(rf'\b(?:no|not|never) (?:any )?{low} than\b', 'atleast', self._text)
        self._text = re.sub(rf'\b(?:no|not|never) (?:any )?{high} than\b', 'atmost', self._text)
        return self._cut(self._words['negations'])

    def _limits(self, negated: bool) -> tuple[Limit, ...] | None:
        """Return every number left with its comparison; None when one has none."""
        found: list[Limit] = []
        behind = 0
        names = list(re.finditer(r'\b([LTVPC]\d+)\b', self._text))
        for k, match in enumerate(names):
            end = names[k + 1].start() if k + 1 < len(names) else len(self._text)
            before = self._text[behind : match.start()]
            after = self._text[match.end() : end]
            op = self._compared(before, after, negated, last=k + 1 == len(names))
            if op is None:
                return None
            op = _CONTRARY[op] if self._fails else op
            found.append(
                Limit(op=op, measure=self._line.measures[match.group(1)], name=match.group(1))
            )
            behind = match.end()
        if found:
            words = self._words
            self._text = _BARE.sub(lambda m: m.group() if m.group()[0] == 'N' else ' ', self._text)
            if self._crosses:
                self._cut(words['down_to'], words['up_to'])
            self._cut(words['at_least'], words['at_most'], words['more'], words['less'])
            self._cut(words['or_more'], words['or_less'])
        return tuple(found)

    def _governs(self, word: str, between: str) -> bool:
        """A preposition stands right in front of its number; `closer to it than` has `than`."""
        if self._words['prepositions'].fullmatch(word):
            return not self._words['articles'].sub('', between).strip()
        if word.endswith('er') and between.split():
            return 'than' in between.split()
        return True

    def _compared(self, before: str, after: str, negated: bool, *, last: bool) -> Op | None:
        words = self._words
        told: list[tuple[int, int, Op, bool]] = []
        ops: tuple[tuple[str, Op, bool], ...] = (
            ('more', '>', True),
            ('less', '<', True),
            ('at_most', '<=', False),
            ('at_least', '>=', False),
        )
        if self._crosses:
            ops += (('down_to', '<=', False), ('up_to', '>=', False))
        for name, op, flips in ops:
            for match in words[name].finditer(before):
                if name == 'at_most' and match.group() == 'to':
                    continue
                if match.group() == 'up to' and _RISES.search(before[: match.start()]):
                    continue
                if not self._governs(match.group(), before[match.end() :]):
                    continue
                within = match.group() in ('within', 'inside')
                told.append((match.end(), len(match.group()), op, flips or within))
        if told:
            _, _, op, flips = max(told, key=lambda one: (one[0], one[1]))
            return _FLIPPED[op] if negated and flips else op
        if words['or_more'].search(after):
            return '>='
        if words['or_less'].search(after):
            return '<='
        apart = re.search(
            r'\b(?:apart|away|separation|separated|distance|clear)\b', before + after
        )
        keeps = re.search(r'\b(?:keep|keeps|stay|stays|maintain|remain|leave)\w*\b', before)
        if apart and keeps and last and not negated:
            return '>='
        return None


def _upper(measure: Measure) -> Measure:
    assert measure.upper is not None
    return replace(measure, value=measure.upper, upper=None)
