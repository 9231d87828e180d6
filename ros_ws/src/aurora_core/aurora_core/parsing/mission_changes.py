# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A flight that something ends or lets begin, told in a clause of its own.

`My car stops at 20 s. From then on the drone tracks the bus`, `drone B must not begin its task
before drone A is done`.
"""

from __future__ import annotations

import re

from aurora_core.parsing.events import complete_event
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.lexicon import shipped_lexicon
from aurora_core.parsing.scene import EventDraft, MissionDraft, Scene
from aurora_core.parsing.sequence import goes_on
from aurora_core.parsing.story import Story
from aurora_core.spec.scenario import EventDoneTrigger, UavAction
from aurora_core.spec.vocabulary import ClauseStatus, MissionMode


def changes_mission(frame: Frame, flown: int, happened: int) -> None:
    """Let what was told last begin the mission of this clause, when nothing else ends the former.

    Args:
        frame: The clause.
        flown: Number of missions that were told before the clause.
        happened: Number of events that were told before the clause.
    """
    scene = frame.scene
    made = scene.missions[flown:]
    if len(made) != 1 or len(scene.events) != happened:
        return
    former = [m for m in scene.missions[:flown] if m.uav is made[0].uav]
    last = _last_event(scene)
    if not former or last is None or not _ends(frame, former[-1]):
        return
    if isinstance(last.action, UavAction) and last.action.uav == made[0].uav.id:
        return
    change = UavAction(do='change_mission', uav=made[0].uav.id, mission=made[0].id)
    done = EventDoneTrigger(on='event_done', event=last.id)
    complete_event(scene, done, change, frame.span, ())


def starts_late(story: Story, flown: int) -> None:
    """Let the first phase of a UAV wait for what was told before it.

    Args:
        story: What was told.
        flown: Number of missions that were told before the clause.
    """
    scene = story.scene
    for draft in scene.missions[flown:]:
        late = story.late.get(draft.uav.id)
        if late is None or scene.missions_of(draft.uav)[0] is not draft:
            continue
        del story.late[draft.uav.id]
        change = UavAction(do='change_mission', uav=draft.uav.id, mission=draft.id)
        complete_event(scene, late.cause, change, draft.span, late.clauses)


def _ends(frame: Frame, former: MissionDraft) -> bool:
    """Return whether the clause takes the place of a flight that nothing else ends."""
    if former.duration is not None:
        return False
    if _instead(frame):
        return True
    return former.mode is not MissionMode.NAVIGATE and frame.piece.then and goes_on(frame)


def _instead(frame: Frame) -> bool:
    told = ' '.join(a.words for a in frame.piece.atoms)
    opening = frame.scene.prompt[max(0, frame.piece.start - _BESIDE) : frame.piece.start].lower()
    words = shipped_lexicon().turns['from_now_on']
    opens = re.split(r'[.;!?]', opening)[-1]
    return any(re.search(rf'\b{word}\b', f'{opens} {told}') for word in words)


_BESIDE = 32  # characters in front of a clause, where its word of sequence stands


def _last_event(scene: Scene) -> EventDraft | None:
    """Return the event that the clause in front told, None when it told something else."""
    read = [c for c in scene.clauses[:-1] if c.status is ClauseStatus.ENCODED and c.ids]
    events = {e.id: e for e in scene.events}
    if not read or read[-1].sentence < scene.clause.sentence - 1:
        return None
    told = [events[one] for one in read[-1].ids if one in events]
    flown = {m.id for m in scene.missions} & set(read[-1].ids)
    return told[-1] if told and not flown else None
