# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The scene rules: what a request implies without saying it, and what stays open."""

from __future__ import annotations

from itertools import pairwise

from aurora_core.parsing.constructions.places import add_placement
from aurora_core.parsing.doubts.clauses import stands_bare
from aurora_core.parsing.own_sequence import own_sequence
from aurora_core.parsing.scene import Doubt, Entity, LinkDraft, MissionDraft, Scene
from aurora_core.parsing.values import stated
from aurora_core.spec.scenario import (
    Behavior,
    DistanceTrigger,
    MessageTrigger,
    Placement,
    SendMessage,
    UavAction,
    VisibilityTrigger,
)
from aurora_core.spec.vocabulary import (
    AgentType,
    BehaviorKind,
    ClauseStatus,
    MissionMode,
    Relation,
    Role,
)

# Behaviours that are about somebody.
_TARGETED = frozenset(
    {
        BehaviorKind.FOLLOW,
        BehaviorKind.TAILGATE,
        BehaviorKind.OVERTAKE,
        BehaviorKind.APPROACH,
    }
)


# What a speed told beside it belongs to.
_HAS_A_SPEED = frozenset(
    {
        BehaviorKind.DRIVE,
        BehaviorKind.EMERGENCY_RUN,
        BehaviorKind.APPROACH,
        BehaviorKind.CIRCULATE,
    }
)


def settle(scene: Scene) -> None:
    """Apply the scene rules; what stays open becomes a question."""
    _seen_from_above(scene)
    if not scene.entities:
        if not scene.questions:
            scene.questions.append(
                'Which vehicles, pedestrians or UAVs should take part, and what should they do?'
            )
        return
    _late_anchors(scene)
    _shared_speeds(scene)
    _climb_only(scene)
    _heights(scene)
    _onlookers(scene)
    if scene.no_uavs and scene.uavs:
        scene.questions.append('Should there be a UAV or not?')
    for until in scene.untils:
        phases = scene.missions_of(until.mission.uav)
        after = phases[phases.index(until.mission) + 1 :]
        if after:
            until.event.action = UavAction(
                do='change_mission', uav=after[0].uav.id, mission=after[0].id
            )
            if until.only_waits and phases[0] is until.mission:
                scene.drop_mission(
                    until.mission, until.event
                )  # `waits until it is done, then hovers there`
    for draft in tuple(scene.missions):
        if draft.needs_target and draft.target is None:
            _infer_target(scene, draft)
    own_sequence(scene)
    _stays_there(scene)
    for event in scene.events:  # nothing waits for itself
        if getattr(event.trigger, 'event', None) == event.id:
            event.trigger = None
            scene.doubts.append(Doubt(span=event.span, question='What should this wait for?'))
    _general_links(scene)
    _senders(scene)


def _stays_there(scene: Scene) -> None:
    """`hovers over the park at 15 m, climbs and hovers at 45 m`: still over the park."""
    for uav in scene.uavs:
        for before, after in pairwise(scene.missions_of(uav)):
            both = before.mode is MissionMode.HOVER and after.mode is MissionMode.HOVER
            place = before.target is not None and scene.by_id(before.target) is None
            if both and place and after.target is None:
                after.target, after.target_inferred = before.target, True


def _heights(scene: Scene) -> None:
    """`tracks a van at 40 m, then climbs to 70 m`: both are heights, where no word says other."""
    acts = [e.action for e in scene.events if isinstance(e.action, UavAction)]
    for draft in scene.missions:
        told, uav = draft.standoff, draft.uav
        if draft.mode is not MissionMode.TRACK or draft.altitude or told is None:
            continue
        others = [m.altitude for m in scene.missions_of(uav) if m.mode is MissionMode.TRACK]
        others += [a.altitude_m for a in acts if a.uav == uav.id]
        if told.span is not None and any(others) and stands_bare(scene.prompt, told.span):
            height = stated('altitude', told.value, told.span.start, told.span.end)
            draft.altitude = height.model_copy(
                update={'bound': told.bound, 'approximate': told.approximate}
            )
            draft.standoff = None


def _shared_speeds(scene: Scene) -> None:
    """`an ambulance on an emergency run drives at 15 m/s`: one act and its speed."""
    for entity in scene.entities:
        acts = entity.behaviors
        plain = [b for b in acts if b.kind is BehaviorKind.DRIVE and b.speed_mps and not b.target]
        open_acts = [b for b in acts if b.kind in _HAS_A_SPEED and b.speed_mps is None]
        if len(plain) != 1 or len(open_acts) != 1 or len(acts) != len(plain) + len(open_acts):
            continue
        one = open_acts[0]
        whole = Behavior(
            kind=one.kind,
            target=one.target,
            speed_mps=plain[0].speed_mps,
            closing_from_m=one.closing_from_m,
            duration_s=one.duration_s or plain[0].duration_s,
            span=one.span,
        )
        entity.behaviors[:] = [whole]


def _senders(scene: Scene) -> None:
    """`when the ego gets the message`: of the one who sends it messages."""
    for event in scene.events:
        heard = event.trigger
        if not isinstance(heard, MessageTrigger) or heard.sender is not None:
            continue
        found = {
            e.action.sender
            for e in scene.events
            if isinstance(e.action, SendMessage) and e.action.receiver == heard.by
        }
        if len(found) == 1:
            event.trigger = MessageTrigger(on=heard.on, by=heard.by, sender=found.pop())


def _seen_from_above(scene: Scene) -> None:
    """Aerial observation was asked for and no UAV named: one is added."""
    if scene.aerial is None or scene.uavs:
        return
    clause, about = scene.aerial
    uav = Entity(id=scene.new_id('uav'), is_uav=True, span=clause.span)
    scene.entities.append(uav)
    draft = MissionDraft(
        id=scene.new_id('m'),
        uav=uav,
        mode=MissionMode.TRACK,
        clause=0,
        span=clause.span,
        target=about,
        target_inferred=about is not None,
        needs_target=about is None,
    )
    scene.missions.append(draft)
    clause.ids[draft.id] = None


def _late_anchors(scene: Scene) -> None:
    """Relations and behaviours whose other end was named later, or not at all: the ego."""
    for open_end in scene.unanchored:
        others = [e for e in scene.agents if e not in open_end.entities]
        anchor = scene.ego or (others[0] if len(others) == 1 else None)
        if anchor is None or anchor in open_end.entities:
            open_end.clause.status = ClauseStatus.NOT_ENCODED
            open_end.clause.notes.append('it is not said of whom')
            continue
        placement = Placement.model_validate(open_end.placement.model_dump() | {'of': anchor.id})
        for entity in open_end.entities:
            add_placement(entity, placement)
    if scene.ego is None:
        return
    for entity in scene.agents:
        for i, placement in enumerate(entity.placements):
            against = placement.relation is Relation.ONCOMING and placement.of is None
            if against and entity is not scene.ego:
                told = placement.model_dump() | {'of': scene.ego.id}
                entity.placements[i] = Placement.model_validate(told)
        for i, behavior in enumerate(entity.behaviors):
            if behavior.kind in _TARGETED and behavior.target is None and entity is not scene.ego:
                entity.behaviors[i] = Behavior.model_validate(
                    behavior.model_dump() | {'target': scene.ego.id}
                )


def _climb_only(scene: Scene) -> None:
    """A UAV that is only sent to an altitude hovers there."""
    for uav_id, altitude in scene.pending_altitude.items():
        uav = scene.by_id(uav_id)
        if uav is None:
            continue
        known = scene.missions_of(uav)
        if known and known[-1].altitude is None and len(known) == 1:
            known[0].altitude = altitude
            continue
        draft = MissionDraft(
            id=scene.new_id('m'),
            uav=uav,
            mode=MissionMode.HOVER,
            clause=0,
            span=uav.span,
            altitude=altitude,
            target=scene.pending_place.get(uav_id) or (known[-1].target if known else None),
        )
        scene.missions.append(draft)
        for clause in scene.clauses:
            if uav_id in clause.ids:
                clause.ids[draft.id] = None


def _onlookers(scene: Scene) -> None:
    """A UAV that only reports or sees tracks what that is about; one without a task hovers."""
    for uav in scene.uavs:
        if scene.missions_of(uav):
            continue
        seen = _seen_by(scene, uav)
        sent = [
            e
            for e in scene.events
            if isinstance(e.action, SendMessage) and e.action.sender == uav.id
        ]
        reports = bool(sent)
        relays = all(isinstance(e.trigger, MessageTrigger) for e in sent)
        # With nobody to track, a UAV that only passes messages on waits in the air.
        track = seen is not None or (
            reports and any(e.type is not AgentType.RSU for e in scene.agents)
        )
        scene.missions.append(
            MissionDraft(
                id=scene.new_id('m'),
                uav=uav,
                clause=0,
                span=uav.span,
                mode=MissionMode.TRACK if track else MissionMode.HOVER,
                target=seen,
                target_inferred=seen is not None,
                needs_target=track,
                told=not relays,
            )
        )


def _seen_by(scene: Scene, uav: Entity) -> str | None:
    told = [c for c in scene.conditions if len(c.of) > 1 and c.of[0] == uav.id]
    watched = [c.of[1] for c in told if not c.quantity.startswith('deliver')]
    watched += [
        e.trigger.target
        for e in scene.events
        if isinstance(e.trigger, VisibilityTrigger) and e.trigger.observer == uav.id
    ]
    agents = {e.id for e in scene.agents}
    actors = [one for one in watched if one in agents]
    return actors[0] if actors else None


def _infer_target(scene: Scene, draft: MissionDraft) -> None:
    target = _reported_actor(scene, draft.uav) or scene.ego
    agents = [e for e in scene.agents if e.role is not Role.BACKGROUND]
    if target is None and len(agents) == 1:
        target = agents[0]
    target = target or _actor_of_an_event(scene)
    if target is None and len(scene.missions_of(draft.uav)) > 1:
        _withdraw(scene, draft)
        return
    if target is None and not draft.told:
        draft.mode = MissionMode.HOVER  # nobody that it could be: it passes messages on
        return
    if target is None:
        words = scene.prompt[draft.span.start : draft.span.end]
        scene.questions.append(f'What should be tracked: "{words}"?')
        return
    draft.target, draft.target_inferred = target.id, True


def _actor_of_an_event(scene: Scene) -> Entity | None:
    """`the whole is filmed by a drone`: whoever the first event is about."""
    for event in scene.events:
        for part in (event.trigger, event.action):
            for name in ('a', 'who', 'agent'):
                entity = scene.by_id(getattr(part, name, None) or '')
                if entity is not None and not entity.is_uav:
                    return entity
    return None


def _withdraw(scene: Scene, draft: MissionDraft) -> None:
    """One phase of several without a target is admitted; the others are kept."""
    scene.missions.remove(draft)
    gone = {draft.id}
    for event in tuple(scene.events):
        if isinstance(event.action, UavAction) and event.action.mission == draft.id:
            gone.add(event.id)
            event.action = None  # others may wait for its cause
            if event.trigger is None:
                scene.events.remove(event)
    for clause in scene.clauses:
        if gone & set(clause.ids):
            for one in gone:
                clause.ids.pop(one, None)
            clause.status = ClauseStatus.NOT_ENCODED
            clause.notes.append('what should be tracked was not understood')


def _reported_actor(scene: Scene, uav: Entity) -> Entity | None:
    if uav.id in scene.reported:
        return scene.by_id(scene.reported[uav.id])
    for event in scene.events:
        if not isinstance(event.action, SendMessage) or event.action.sender != uav.id:
            continue
        trigger = event.trigger
        candidates: list[str] = []
        if isinstance(trigger, DistanceTrigger):
            candidates = [trigger.a, trigger.b]
        elif trigger is not None:
            for name in ('target', 'who', 'by'):
                candidates += [getattr(trigger, name, '') or '']
        for one in candidates:
            entity = scene.by_id(one)
            if entity is not None and not entity.is_uav and one != event.action.receiver:
                return entity
    return None


def _general_links(scene: Scene) -> None:
    """Values without a link belong to all links, or make the obvious one."""
    general = [link for link in scene.links if link.sender is None]
    owned = [link for link in scene.links if link.sender is not None]
    for values_only in general:
        if not owned and len(scene.uavs) == 1 and scene.ego is not None:
            made = LinkDraft(
                id=values_only.id,
                sender=scene.uavs[0].id,
                receiver=scene.ego.id,
                span=values_only.span,
            )
            owned.append(made)
        if not owned:
            for clause in scene.clauses:
                if values_only.id in clause.ids:
                    del clause.ids[values_only.id]
                    clause.status = ClauseStatus.NOT_ENCODED
                    clause.notes.append('no message link is named that this could be about')
        for link in owned:
            for name in ('loss', 'latency', 'range', 'retransmissions', 'outage', 'rate'):
                if getattr(link, name) is None:
                    setattr(link, name, getattr(values_only, name))
        for clause in scene.clauses:
            if values_only.id in clause.ids and owned:
                del clause.ids[values_only.id]
                clause.ids.update({link.id: None for link in owned})
    scene.links = owned
