# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a cause has before its effect as well as behind it: a delay, the clause in front again."""

from __future__ import annotations

from aurora_core.parsing import values
from aurora_core.parsing.atoms import NounKind
from aurora_core.parsing.constructions.triggers import ELAPSED, Cause, cause
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.story import Story
from aurora_core.parsing.told_pieces import is_ellipsis, without_link
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import AgentAction, EventDoneTrigger


def again(story: Story, frame: Frame) -> Cause | None:
    """`…, and when it does, …`: the cause is what the clause in front tells."""
    if not is_ellipsis(frame.piece):
        return None
    named = any(n.kind is not NounKind.PRONOUN for n in frame.subject_nouns)
    who = frame.subjects() if named else ()
    for event in reversed(story.scene.events):  # `after the truck does`
        if who and isinstance(event.action, AgentAction) and event.action.agent == who[0].id:
            return EventDoneTrigger(on='event_done', event=event.id)
    if story.before is None:
        return None
    told = Frame(without_link(story.before, frame.piece.link), story.scene, story.resolver)
    if not told.subject_nouns:
        told.subject_nouns = frame.subject_nouns
    return cause(told)


def delay_of(frame: Frame) -> Parameter | None:
    """Take `5 s` of `5 s after the bus stops`."""
    adjunct = frame.time('')
    if adjunct is None or adjunct.measure is None or adjunct.start != frame.piece.atoms[0].start:
        return None
    if frame.verb is None or not values.accepts('delay', adjunct.measure):
        return None
    if frame.key in ELAPSED and not frame.subject_nouns:
        return None  # `when 10 s have passed`
    adjunct.used = True
    return values.explicit('delay', adjunct.measure)
