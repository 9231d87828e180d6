# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who tells whom, and over what link: `alerts the ego`, `with 20 % packet loss`, `no retries`."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing import values
from aurora_core.parsing.adjuncts import Adjunct, AdjunctKind
from aurora_core.parsing.atoms import ACTORS, AtomKind, Determiner, NounKind, NounPhrase
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.lexicon import shipped_lexicon
from aurora_core.parsing.measures import RATE, RATIO, TIME
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pronouns import airborne
from aurora_core.parsing.scene import Entity, LinkDraft, Scene
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.scenario import MessageTrigger, SendMessage

TELLING = frozenset({'alert', 'send', 'report'})
_LINK_FIELDS = {
    'loss': 'link_loss',
    'latency': 'link_latency',
    'radio_range': 'link_range',
    'retransmissions': 'link_retransmissions',
}
_OFF = re.compile(
    r'\b(?:disabled?|disables|switched off|turned off|deactivated|disallowed|forbidden|excluded|'
    r'disregarded|ruled out|suppressed|prohibited)\b'
)


def message(frame: Frame) -> SendMessage | None:
    """Read `alerts the ego`, `sends a warning to the ego car`."""
    if frame.key == 'receive':
        return _received(frame)
    if frame.negated or frame.key not in TELLING:
        return None
    senders = frame.subjects()
    if not senders and not frame.subject_nouns and len(frame.scene.uavs) == 1:
        senders = (frame.scene.uavs[0],)
        frame.scene.clause.subjects = senders
    if not senders:
        return None
    senders = _teller(frame, senders)
    receivers = _receivers(frame, senders)
    receivers = receivers or _awaits(frame, senders)
    often = frame.time('every') is not None or frame.measure(RATE) is not None
    if not receivers and (often or frame.has_mark(AtomKind.MESSAGE.value)):
        # `the link between the drone and the car …; it reports twice per second`
        ends = {k.receiver for k in frame.scene.links if k.sender == senders[0].id and k.receiver}
        receivers = tuple(e for e in frame.scene.entities if ends == {e.id})
    if not receivers:
        ego = frame.scene.ego
        if ego is None or ego in senders:
            return None
        receivers = (ego,)
    _contents(frame, senders[0], receivers)
    if len(senders) > 1 or len(receivers) > 1:
        frame.scene.clause.notes.append('only one sender and one receiver were taken')
        frame.flag(frame.piece.start, frame.piece.end)
    link = link_between(frame, senders[0], receivers[0])
    _rate(frame, link)
    frame.scene.clause.objects = receivers
    frame.scene.became(link.id)
    return SendMessage(do='send_message', sender=senders[0].id, receiver=receivers[0].id)


def _rate(frame: Frame, link: LinkDraft) -> None:
    """Take `reports its position every 2 s`, `at 2 Hz`."""
    often = frame.time('every') or frame.measure(RATE, 'at', 'with', '')
    if often is None or often.measure is None or often.measure.value <= 0.0:
        return
    often.used = True
    rate = often.measure
    if rate.dimension == TIME:
        rate = replace(rate, dimension=RATE, value=1.0 / rate.value)
    link.rate = values.explicit('link_rate', rate)
    lasts = frame.time('for')
    flown = [m for m in frame.scene.missions if m.uav.id == link.sender]
    if lasts is not None and lasts.measure is not None and flown and flown[-1].duration is None:
        lasts.used = True  # one reports as long as one flies
        flown[-1].duration = values.explicit('mission_duration', lasts.measure)


def _awaits(frame: Frame, senders: tuple[Entity, ...]) -> tuple[Entity, ...]:
    """`it starts once it has the drone's report. The drone reports at 60 s`: whoever waits."""
    tellers = [e.id for e in senders]
    for event in reversed(frame.scene.events):
        awaited = event.trigger
        if isinstance(awaited, MessageTrigger) and awaited.sender in tellers:
            by = frame.scene.by_id(awaited.by)
            return () if by is None or by in senders else (by,)
    return ()


def _teller(frame: Frame, senders: tuple[Entity, ...]) -> tuple[Entity, ...]:
    """`when an ambulance arrives, it alerts the bus`: whoever watches tells, not who is seen."""
    flying = frame.scene.uavs
    it = len(frame.subject_nouns) == 1 and _is_it(list(frame.subject_nouns))
    if not it or not frame.watched or len(flying) != 1 or flying[0] in senders:
        return senders
    named = [n for a in frame.adjuncts for n in a.nouns]
    if any(n.kind is NounKind.UAV for n in named) or not frame.scene.missions_of(flying[0]):
        return senders
    frame.scene.clause.subjects = (flying[0],)
    return (flying[0],)


def is_command(frame: Frame) -> bool:
    """`notify the police`: whoever reads the scenario out tells a UAV, not who acted before."""
    if frame.verb is None or frame.subject_nouns:
        return False
    return frame.key in TELLING and frame.verb.form is VerbForm.BASE


def _received(frame: Frame) -> SendMessage | None:
    """`the ego gets an alert from the drone`: the same message, told by its receiver."""
    source = frame.free(AdjunctKind.PHRASE, 'from', 'of', 'by')
    if frame.negated or not source:
        return None
    receivers = frame.subjects()
    nouns = [n for n in source[0].nouns if n.kind in ACTORS]
    flying = tuple(e for e in frame.scene.uavs if e not in receivers)
    # `when the drone sees the bicycle, the bus gets a warning from it`
    senders = flying if _is_it(nouns) and len(flying) == 1 else frame.objects(nouns)
    if len(receivers) != 1 or len(senders) != 1 or senders == receivers:
        return None
    source[0].used = True
    for mark in frame.free(AdjunctKind.MARK, AtomKind.MESSAGE.value, AtomKind.LINK.value):
        mark.used = True
    link = link_between(frame, senders[0], receivers[0])
    frame.scene.clause.subjects, frame.scene.clause.objects = senders, receivers
    frame.scene.became(link.id)
    return SendMessage(do='send_message', sender=senders[0].id, receiver=receivers[0].id)


def _receivers(frame: Frame, senders: tuple[Entity, ...]) -> tuple[Entity, ...]:
    kinds: tuple[tuple[AdjunctKind, tuple[str, ...]], ...] = (
        (AdjunctKind.PHRASE, ('to',)),
        (AdjunctKind.OBJECT, ()),
    )
    if frame.key == 'alert':
        kinds = kinds[::-1]
    for kind, keys in kinds:
        for adjunct in frame.free(kind, *keys):
            actors = [n for n in adjunct.nouns if n.kind in ACTORS]
            ego = frame.scene.ego
            if ego is not None and ego not in senders and _is_it(actors):
                found: tuple[Entity, ...] = (ego,)  # whom else would one warn
            else:
                found = frame.objects(actors) if actors else ()
            found = tuple(e for e in found if e not in senders)
            if found:
                adjunct.used = True
                return found
    return ()


def _is_it(nouns: list[NounPhrase]) -> bool:
    return len(nouns) == 1 and nouns[0].kind is NounKind.PRONOUN and nouns[0].key == 'it'


def _contents(frame: Frame, sender: Entity, receivers: tuple[Entity, ...]) -> None:
    """What the message says is not part of a scenario: `about the van`, `a warning message`."""
    frame.scene.clause.objects = ()  # `reports it to the ego`: the ego is not `it`
    for mark in frame.free(AdjunctKind.MARK, AtomKind.MESSAGE.value, AtomKind.LINK.value, 'thing'):
        mark.used = True
        frame.objects([n for n in mark.nouns if n.kind in ACTORS])
    keys = ('around', 'of', 'using', 'over', 'with')
    for adjunct in frame.free(AdjunctKind.PHRASE, *keys) + frame.free(AdjunctKind.OBJECT):
        actors = [n for n in adjunct.nouns if n.kind in ACTORS]
        if actors:
            known = frame.scene.clause.objects
            for one in frame.objects(actors):
                if one is not sender and one not in receivers:
                    frame.scene.reported.setdefault(sender.id, one.id)
            frame.scene.clause.objects = known or frame.scene.clause.objects
            adjunct.used = True


def link_between(frame: Frame, sender: Entity, receiver: Entity) -> LinkDraft:
    """Return the link between two actors, new or known."""
    scene = frame.scene
    for link in scene.links:
        if link.sender == sender.id and link.receiver == receiver.id:
            return link
    made = LinkDraft(
        id=scene.new_id('link'), sender=sender.id, receiver=receiver.id, span=frame.span
    )
    scene.links.append(made)
    return made


# --- link values --------------------------------------------------------------------------------


def link_values(frame: Frame) -> bool:
    """Take loss, latency, range and retries wherever they stand."""
    found: dict[str, Parameter] = {}
    for name, parameter_name in _LINK_FIELDS.items():
        adjunct = frame.attribute(name)
        if adjunct is None or adjunct.measure is None:
            continue
        measure = adjunct.measure
        if not values.accepts(parameter_name, measure):
            continue
        if name == 'loss' and measure.dimension != RATIO and measure.value > 1:
            continue
        adjunct.used = True
        parameter = values.explicit(parameter_name, measure)
        if adjunct.prep in ('below', 'within'):
            parameter = values.rebound(parameter, Bound.AT_MOST)
        found[name] = parameter
    _reaching(frame, found)
    _losing(frame, found)
    _no_retries(frame, found)
    outage = _outage(frame)
    if not found and outage is None:
        return False
    draft = _link_of_clause(frame)
    draft.outage = outage or draft.outage
    others = {a.key: a for a in _told_between(frame)[1:]}
    for name, parameter in found.items():
        if name in others:  # `the loss between A and B is 10 %, the latency between B and C 1 s`
            ends = _in_order(frame.objects(others[name].nouns))
            other = link_between(frame, *ends) if ends is not None else draft
            setattr(other, {'radio_range': 'range'}.get(name, name), parameter)
            frame.scene.became(other.id)
            continue
        field = {'radio_range': 'range'}.get(name, name)
        setattr(draft, field, parameter)
    for mark in frame.free(AdjunctKind.MARK, AtomKind.LINK.value, AtomKind.MESSAGE.value):
        mark.used = True
    frame.scene.became(draft.id)
    return True


def _reaching(frame: Frame, found: dict[str, Parameter]) -> None:
    """`the drone's radio reaches 50 m`, `the link only works up to 120 m`."""
    if frame.key != 'reach' or 'radio_range' in found or not frame.has_mark(AtomKind.LINK.value):
        return
    adjunct = frame.length('', 'to', 'within', 'at') or frame.attribute('away', 'standoff')
    if adjunct is not None and adjunct.measure is not None:
        adjunct.used = True
        found['radio_range'] = values.explicit('link_range', adjunct.measure)


def _outage(frame: Frame) -> tuple[Parameter, Parameter] | None:
    """Take `the link is lost from 10 s to 20 s`, `is down between 10 s and 20 s`."""
    told = frame.scene.prompt[frame.piece.start : frame.piece.end].lower().split()
    down = not shipped_lexicon().turns['out_of_order'].isdisjoint(told)
    if frame.negated or not down or not frame.has_mark(AtomKind.LINK.value):
        return None
    for adjunct in frame.free(AdjunctKind.MEASURE, TIME):
        if adjunct.measure is not None and adjunct.measure.upper is not None:
            adjunct.used = True
            return values.range_ends('link_outage', adjunct.measure)
    begins, ends = frame.time('from'), frame.time('to')
    if begins is None or begins.measure is None or ends is None or ends.measure is None:
        return None
    begins.used = ends.used = True
    return (
        values.explicit('link_outage', begins.measure),
        values.explicit('link_outage', ends.measure),
    )


def _losing(frame: Frame, found: dict[str, Parameter]) -> None:
    """`the link drops 20 % of the packets`, `10 % of the messages are lost`."""
    if frame.key not in ('lose', 'fall_below') or 'loss' in found:
        return
    about_link = frame.has_mark(AtomKind.LINK.value) or frame.has_mark(AtomKind.MESSAGE.value)
    adjunct = frame.measure(RATIO)
    if about_link and adjunct is not None and adjunct.measure is not None:
        adjunct.used = True
        found['loss'] = values.explicit('link_loss', adjunct.measure)


def _no_retries(frame: Frame, found: dict[str, Parameter]) -> None:
    text = frame.scene.prompt[frame.piece.start : frame.piece.end].lower()
    if 'retransmissions' in found or not (frame.negated or _OFF.search(text)):
        return
    mark = frame.mark('thing', 'retransmissions')
    if mark is not None:
        for word in frame.free(AdjunctKind.MARK, AtomKind.UNKNOWN.value):
            told = frame.scene.prompt[word.start : frame.piece.end].lower()
            word.used = _OFF.match(told) is not None
        found['retransmissions'] = values.stated('link_retransmissions', 0, mark.start, mark.end)


def _link_of_clause(frame: Frame) -> LinkDraft:
    """Return the link that values belong to: the clause's, the last one, else every link."""
    scene: Scene = frame.scene
    named = _named_ends(frame)
    if named is not None:
        return link_between(frame, *named)
    in_sentence = [i for i in scene.clause.ids if i.startswith('link')]
    if in_sentence:
        return next(link for link in scene.links if link.id == in_sentence[-1])
    owned = [link for link in scene.links if link.sender is not None]
    if owned:
        return owned[-1]
    for link in scene.links:
        if link.sender is None:
            return link
    made = LinkDraft(id=scene.new_id('link'), sender=None, receiver=None, span=frame.span)
    scene.links.append(made)
    return made


def _named_ends(frame: Frame) -> tuple[Entity, Entity] | None:
    """`the link between the drone and the ego`, `the link from the drone to the ego`."""
    between = frame.free(AdjunctKind.PHRASE, 'between') or _told_between(frame)
    if between and len(between[0].nouns) == 2:
        ends = _in_order(frame.objects(_known(frame, between[0].nouns)))
        if ends is not None:
            between[0].used = True
            return ends
    from_whom = frame.free(AdjunctKind.PHRASE, 'from') or [
        a for a in frame.adjuncts if a.kind is AdjunctKind.ATTRIBUTE and a.nouns and a.used
    ]
    to_whom = frame.free(AdjunctKind.PHRASE, 'to')
    if to_whom and (from_whom or frame.subject_nouns):
        senders = frame.objects(from_whom[0].nouns) if from_whom else frame.subjects()
        receivers = frame.objects(_known(frame, [n for n in to_whom[0].nouns if n.kind in ACTORS]))
        if len(senders) == len(receivers) == 1 and senders != receivers:
            for taken in (*from_whom[:1], to_whom[0]):
                taken.used = True
            return senders[0], receivers[0]
    return None


def _known(frame: Frame, nouns: Sequence[NounPhrase]) -> list[NounPhrase]:
    """`the radio from drone to car`: ends without an article are those who talk already."""
    ends = (one for k in frame.scene.links for one in (k.sender, k.receiver))
    talking = [frame.scene.by_id(one) for one in ends if one is not None]
    types = {e.type.value for e in talking if e is not None and e.type is not None}
    bare = Determiner.BARE
    return [
        replace(n, determiner=Determiner.DEFINITE)
        if n.determiner is bare and n.key in types and not n.plural
        else n
        for n in nouns
    ]


def _told_between(frame: Frame) -> list[Adjunct]:
    """Return the values of `the latency between the drone and the ego`."""
    told = [a for a in frame.adjuncts if a.kind is AdjunctKind.ATTRIBUTE and len(a.nouns) == 2]
    return [a for a in told if a.key in _LINK_FIELDS]


def _in_order(ends: tuple[Entity, ...]) -> tuple[Entity, Entity] | None:
    """Return sender and receiver: a UAV tells those on the ground."""
    if len(ends) != 2:
        return None
    first, second = ends
    return (second, first) if airborne(second) and not airborne(first) else (first, second)
