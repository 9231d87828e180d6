# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which quantity a condition is about, and of whom: from `Criterion` to stated conditions."""

from __future__ import annotations

import re
from collections.abc import Sequence

from aurora_core.parsing import values
from aurora_core.parsing.atoms import NounKind
from aurora_core.parsing.criteria.criterion import Criterion, Limit, Op
from aurora_core.parsing.criteria.moments import Moment
from aurora_core.parsing.criteria.parties import Parties, left_out_before
from aurora_core.parsing.criteria.sequels import Sequels
from aurora_core.parsing.criteria.words import criteria_words
from aurora_core.parsing.measures import Measure
from aurora_core.parsing.pronouns import airborne, ground
from aurora_core.parsing.resolver import Resolver
from aurora_core.parsing.scene import Entity, Scene
from aurora_core.spec.parameter import Parameter, Span
from aurora_core.spec.scenario import StatedCondition

_OF_HEIGHT = re.compile(r'\b(altitude|height|elevation|agl|above (?:the )?ground|flight level)\b')
_BETWEEN = re.compile(
    r'\b(?:(?:from|of|to) (?:(?:(?:it|they|any|each|every|other|no) )*N\d|each other|one another)|'
    r'between|apart|closer|nearer|away|distance|gap|spacing|clearance|separation|headway|near|'
    r'together|leave)'
)
_MUTUAL = re.compile(r'\b(?:each other|one another)\b')
_VERTICAL = re.compile(
    r'\b(?:above|below|under|over|beneath|underneath|higher|lower|exceed\w*|rise|climb|descend)\b'
)
_NEITHER = re.compile(r' (?:(?:and|but) )?(?:neither|none)\b')
_LISTED = re.compile(r'N0(?: ?,)*(?: (?:and|,)+ N\d+)+')
_ONE = ('it', 'person')
# `no car shall exceed 50 km/h`
_EVERYONE = re.compile(
    r'\b(?:no|none of|neither|each|every|any|all|both)(?: of)?(?: the)?(?: two)? N0\b'
)
_FRACTIONS = ('visible_fraction', 'tracked_fraction', 'delivery_ratio')
_VALUE = {
    'L': 'condition_distance',
    'P': 'condition_ratio',
    'V': 'condition_speed',
    'T': 'condition_time',
}


class Meaning:
    """Adds the conditions of one clause to the scene."""

    def __init__(self, told: Criterion, scene: Scene, resolver: Resolver, span: Span) -> None:
        self._told = told
        self._scene = scene
        self._span = span
        self._who = Parties(scene, resolver, told.nouns)

    def state(self) -> bool:
        """Return whether the conditions could be stated."""
        if re.search(r'\bwhile (?!this|that|all)', self._told.words) and not self._scene.missions:
            return False  # what is done the while is not told elsewhere
        dimension = self._told.limits[0].dimension if self._told.limits else ''
        if self._told.event is not None and dimension in ('', 'T'):
            return self._moment(self._told.event)
        if dimension == 'V':
            if any(n.kind in (NounKind.PLACE, NounKind.LANDMARK) for n in self._told.nouns):
                return False  # of a place, a speed says nothing
            return self._each('speed', self._movers())
        if dimension == 'L':
            return self._lengths()
        if dimension == 'T' or (not dimension and self._told.hold is not None):
            return self._times()
        if dimension == 'P' or (not dimension and self._told.share is not None):
            return self._shares()
        if dimension == 'C':
            return self._counts()
        return self._done()

    def _moment(self, told: Moment) -> bool:
        """When an event happens; the deadline of one is its latest moment."""
        if told.key == 'land' and self._told.by is not None:
            return self._done()
        event = Sequels(self._scene, self._span, self._who.actors()).event(told, new=True)
        if event is None:
            return False
        for limit in self._told.limits:
            value = values.explicit('condition_time', limit.measure)
            self._add('event_time', (event.id,), limit.op, value, deadline=False)
        by = self._told.by
        if by is not None:
            value = values.explicit('condition_time', by)
            self._add('event_time', (event.id,), '<=', value, deadline=False)
        return bool(self._told.limits or by)

    # --- values at every moment ---------------------------------------------------------------

    def _movers(self) -> list[Entity]:
        everyone = self._everyone()
        if everyone:
            return everyone
        named = self._who.actors()
        if named:
            listed = _LISTED.search(self._told.words)
            return named[: listed[0].count('N')] if listed else named[:1]
        group = self._who.several()
        if group:
            return group
        if _NEITHER.match(self._told.words):
            return self._who.pair()
        one = self._who.it()
        return [one] if one is not None else []

    def _everyone(self) -> list[Entity]:
        """`no car shall exceed 50 km/h`, `neither drone may drift`: all of that kind."""
        told = self._told
        if told.nouns and _EVERYONE.search(told.words):
            kin = self._who.kin()
        elif _NEITHER.match(told.words):
            kin = self._who.pair()
        else:
            return []
        return kin if len(kin) > 1 else []

    def _each(self, quantity: str, who: Sequence[Entity]) -> bool:
        for entity in who:
            self._series(quantity, (entity.id,))
        self._spoken(who)
        return bool(who)

    def _lengths(self) -> bool:
        told = self._told
        if len(told.nouns) == 1 and 'pairs' in told.topics:
            return self._apart(self._who.kin())
        if all(n.kind in (NounKind.UAV, NounKind.PRONOUN) for n in told.nouns):
            flown = self._of_flyers()
            if flown is not None:
                return flown
        named = self._who.named()
        group = self._who.several()
        if group is None and _NEITHER.match(told.words):
            group = self._who.pair()
            if any(n.key == 'other' for n in told.nouns):
                return self._apart(group)
        flat = 'horizontal' in told.topics
        if not named and not group and self._is_cut_off():
            return False
        placeless = not (named or group or flat or _BETWEEN.search(told.words))
        if _OF_HEIGHT.search(told.words) or placeless:
            return self._each('altitude', self._who.flyers())
        if group and not named and any(n.key in _ONE for n in told.nouns):
            other = self._who.it(avoid=group)  # `none of them gets closer than 10 m to it`
            return other is not None and self._between([other, *group])
        if told.others and group is not None and 'pairs' not in told.topics:
            first = self._who.it()
            named = [first] if first is not None else []
        elif group is not None and not named:
            return self._apart(group)
        if len(named) == 1 and not _BETWEEN.search(told.words):
            one = named[0]
            if isinstance(one, Entity) and one.is_uav:
                return self._each('altitude', [one])
            if isinstance(one, str) and re.search(r'\b(?:above|over|below)\b', told.words):
                return self._each('altitude', self._who.flyers())
        if group is not None:  # `never nearer than 20 m to either`
            named += [e for e in self._who.several(avoid=named) or () if e not in named]
        if not named:
            if 'distance' not in told.topics and not flat:
                return self._each('altitude', self._who.flyers())
            return self._apart(self._who.pair())
        return self._between(named)

    def _of_flyers(self) -> bool | None:
        """Lengths of UAVs that nothing else is named with: drifts, heights, gaps of a group."""
        told = self._told
        if 'drift' in told.topics:
            drifting = self._everyone() or self._who.several() or self._who.flyers()[:1]
            return self._each('hover_drift', [e for e in drifting if e.is_uav])
        everyone = self._everyone()
        if everyone and [n.key for n in told.nouns[1:]] == ['other']:
            return self._apart(everyone)
        if (len(told.nouns) == 1 or everyone) and self._is_vertical():
            everyone = everyone or self._who.several() or []
            if len(everyone) > 1 and all(e.is_uav for e in everyone):
                return self._each('altitude', everyone)
        return None

    def _is_vertical(self) -> bool:
        """`all UAVs must stay above 20 m` is about heights, `… more than 20 m apart` is not."""
        told = self._told
        up = 'altitude' in told.topics or _VERTICAL.search(told.words) is not None
        apart = _BETWEEN.search(told.words) or _MUTUAL.search(told.words)
        return up and 'pairs' not in told.topics and not apart

    def _is_cut_off(self) -> bool:
        """`its yaw must not exceed 2 m`: of what, no known word says."""
        told = self._told
        if told.topics or (told.nouns and not told.owned):
            return False
        asked = criteria_words()['musts'].match(told.words.lstrip()) is not None
        return told.owned or (asked and left_out_before(self._scene.prompt, self._span.start))

    def _between(self, named: list[Entity | str]) -> bool:
        """From the first to every other one."""
        pronoun = any(n.kind.value == 'pronoun' for n in self._told.nouns)
        if len(named) == 1 or isinstance(named[0], str) or (pronoun and self._told.owned):
            other = self._who.it(avoid=named)
            if other is None or (len(named) > 1 and isinstance(named[0], Entity)):
                return False
            named = [other, *named]
        quantity = 'distance'
        if all(isinstance(e, Entity) and e.is_uav for e in named):
            return self._apart([e for e in named if isinstance(e, Entity)])
        if 'horizontal' in self._told.topics:
            quantity = 'horizontal_distance'
        first = named[0]
        assert isinstance(first, Entity)
        for end in named[1:]:
            self._series(quantity, (first.id, end if isinstance(end, str) else end.id))
        self._spoken([first])
        return True

    def _apart(self, group: Sequence[Entity]) -> bool:
        if len(group) < 2:
            return False
        ids = tuple(e.id for e in group)
        quantity = 'separation'
        if len(ids) == 2 and not all(e.is_uav for e in group):
            flat = 'horizontal' in self._told.topics
            quantity = 'horizontal_distance' if flat else 'distance'
        self._series(quantity, ids)
        self._spoken(group)
        return True

    def _series(self, quantity: str, of: tuple[str, ...]) -> None:
        told = self._told
        for limit in told.limits:
            self._add(
                quantity,
                of,
                limit.op,
                values.explicit(_VALUE[limit.dimension], limit.measure),
                hold=told.hold.measure if told.hold is not None else None,
                share=told.share.measure if told.share is not None else None,
            )

    # --- times and shares ---------------------------------------------------------------------

    def _times(self) -> bool:
        told = self._told
        limit = told.limits[0] if told.limits else told.hold
        assert limit is not None
        if 'seen' in told.topics:
            value = values.explicit('condition_time', limit.measure)
            hold = limit.measure if told.unbroken else None
            return self._watched('visible_time', limit.op, value, hold)
        if told.topics & {'delivered', 'latency'}:
            value = values.explicit('condition_time', limit.measure)
            return self._of_links('delivery_latency', limit.op, value)
        return False

    def _shares(self) -> bool:
        limit = self._told.limits[0] if self._told.limits else self._told.share
        assert limit is not None
        return self._fraction(limit)

    def _fraction(self, limit: Limit) -> bool:
        topics = self._told.topics
        value = values.explicit('condition_ratio', limit.measure)
        if 'seen' in topics:
            return self._watched('visible_fraction', limit.op, value)
        if 'tracked' in topics:
            return self._watched('tracked_fraction', limit.op, value)
        if 'delivered' in topics:
            return self._of_links('delivery_ratio', limit.op, value)
        if 'battery' in topics and self._told.limits:
            one = self._told.owned or self._told.nouns
            return self._each('battery', self._who.flyers() if one else self._scene.uavs)
        before = [c.quantity for c in self._scene.conditions[-1:] if c.quantity in _FRACTIONS]
        if before and before[0] != 'delivery_ratio':  # `…, for the bicycle 75 % will do`
            return self._watched(before[0], limit.op, value)
        return False

    def _counts(self) -> bool:
        limit = self._told.limits[0]
        if limit.measure.value <= 1 and self._told.topics & {'seen', 'tracked', 'delivered'}:
            return self._fraction(limit)
        if 'waypoints' not in self._told.topics:
            return False
        flyers = self._who.flyers()[:1]
        for flyer in flyers:
            value = values.explicit('waypoint_count', limit.measure)
            self._add('waypoints_visited', (flyer.id,), limit.op, value)
        return bool(flyers)

    def _watched(
        self, quantity: str, op: Op, value: Parameter, hold: Measure | None = None
    ) -> bool:
        """Of UAVs and what they watch, each of which may be left out."""
        named = self._who.named()
        targets = [
            e if isinstance(e, str) else e.id for e in named if isinstance(e, str) or ground(e)
        ]
        if not self._told.nouns and re.search(r'\b(?:be|is|stay|remain)s?\b', self._told.words):
            targets = []
        observers = self._observers([e for e in named if isinstance(e, Entity)], targets)
        found = False
        for observer in observers:
            for target in targets or self._target_of(observer):
                of = (observer.id, target)
                self._add(quantity, of, op, value, hold=hold)
                found = True
        self._spoken(observers)
        return found

    def _observers(self, named: list[Entity], targets: list[str]) -> list[Entity]:
        flying = [e for e in named if e.is_uav]
        if flying:
            return flying
        group = self._who.several()
        if group is not None and all(e.is_uav for e in group):
            return group
        flown = {m.target: m.uav for m in self._scene.missions}
        about = [flown[t] for t in targets if t in flown]
        if about:
            return list(dict.fromkeys(about))
        one = self._who.it(airborne)
        return [one] if one is not None else []

    def _target_of(self, observer: Entity) -> list[str]:
        flown = [m.target for m in self._scene.missions_of(observer) if m.target is not None]
        told = [c.subjects for c in self._scene.clauses[:-1] if c.subjects]
        about = [e.id for e in told[-1] if ground(e)] if told else []
        place = bool(flown) and self._scene.by_id(flown[-1]) is None
        if flown and not (place and len(about) == 1):  # `hovers there. A bus drives by; it …`
            return flown[-1:]
        other = self._who.it(ground)
        return about[:1] if place else [other.id] if other is not None else []

    # --- messages and ends --------------------------------------------------------------------

    def _of_links(
        self, quantity: str, op: Op, value: Parameter, by: Measure | None = None
    ) -> bool:
        owned = [link for link in self._scene.links if link.sender and link.receiver]
        named = {e.id for e in self._who.actors()}
        fitting = [k for k in owned if named <= {k.sender, k.receiver}]
        everyone = re.search(r'\b(?:both|all|each|every|messages)\b', self._told.words)
        for link in fitting if everyone else fitting[-1:]:
            assert link.sender is not None
            assert link.receiver is not None
            self._add(quantity, (link.sender, link.receiver), op, value)
        return bool(fitting)

    def _done(self) -> bool:
        """`must have landed by 60 s`, `the alert must arrive`."""
        told = self._told
        yes = values.inferred('condition_ratio', 1.0)
        lands = told.event is not None and told.event.key == 'land'
        if lands or 'landed' in told.topics or 'completed' in told.topics:
            ended = not re.search(r'\b(?:land|ground|down|back|home|return)', told.words)
            quantity = 'mission_completed' if ended and not lands else 'landed'
            flyers = self._who.flyers()
            for flyer in flyers:
                self._add(quantity, (flyer.id,), '==', yes)
            self._spoken(flyers)
            return bool(flyers)
        if 'delivered' in told.topics:
            return self._of_links('delivered', '==', yes)
        return False

    # --- the scene ----------------------------------------------------------------------------

    def _spoken(self, who: Sequence[Entity]) -> None:
        self._scene.clause.subjects = tuple(who)

    def _add(
        self,
        quantity: str,
        of: tuple[str, ...],
        op: Op,
        value: Parameter,
        *,
        hold: Measure | None = None,
        share: Measure | None = None,
        deadline: bool = True,
    ) -> None:
        by = self._told.by if deadline else None
        made = StatedCondition(
            id=self._scene.new_id('c'),
            quantity=quantity,
            of=of,
            op=op,
            value=value,
            hold_s=values.explicit('condition_time', hold) if hold is not None else None,
            by_s=values.explicit('condition_time', by) if by is not None else None,
            fraction=values.explicit('condition_ratio', share) if share is not None else None,
            span=self._span,
        )
        self._scene.conditions.append(made)
        self._scene.became(made.id)
