# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether what follows waits for the beginning of a deed, not for its end."""

from __future__ import annotations

import re

from aurora_core.parsing.frames import Frame
from aurora_core.parsing.lexicon import shipped_lexicon
from aurora_core.parsing.morphology import VerbForm


def sets_in(frame: Frame) -> bool:
    """`when he steps onto the road`, `once it begins to brake`, `when a pedestrian crosses`.

    Who has crossed is across, and who crosses "once" or "after" something is waited for as well.
    """
    if frame.verb is None or frame.key == 'start':
        return False
    if frame.key == 'step_onto':
        return True
    turns = shipped_lexicon().turns
    prompt, verb = frame.scene.prompt, frame.verb
    told = prompt[frame.piece.start : verb.end].lower()
    words = prompt[frame.piece.start : verb.start].lower().split()
    said = prompt[verb.start : verb.end].lower().split()
    before = (words[:-1] if words[-1:] == ['to'] else words)[-1:]
    if turns['begins'] & {*before, *said[:-1]}:
        return True
    meanwhile = any(told.startswith(f'{word} ') for word in turns['meanwhile'])
    under_way = re.search(rf'\b(?:{"|".join(sorted(turns["is"]))}) \w+ing\b', told)
    simple = verb.form in (VerbForm.BASE, VerbForm.THIRD)
    return frame.key == 'cross' and meanwhile and (simple or under_way is not None)
