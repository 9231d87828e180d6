# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""UAVs that stay where they are: `waits for the bus`, `stays in the air for half an hour`."""

from __future__ import annotations

from aurora_core.parsing.adjuncts import AdjunctKind
from aurora_core.parsing.atoms import ACTORS
from aurora_core.parsing.constructions.flight_types import FlightValues
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.scene import Entity
from aurora_core.spec.vocabulary import MissionMode


def waits_for(frame: Frame) -> None:
    """`it waits for the bus`: whom a UAV waits for is not where it waits."""
    for adjunct in frame.free(AdjunctKind.PHRASE, 'for') + frame.free(AdjunctKind.OBJECT):
        named = [n for n in adjunct.nouns if n.kind in ACTORS]
        if named and len(named) == len(adjunct.nouns):
            adjunct.used = bool(frame.objects(named))


def waits_aloft(frame: Frame, flying: tuple[Entity, ...], found: FlightValues) -> bool:
    """`has to stay in the air for half an hour`: nothing but how long is said."""
    told = found.duration is not None and frame.key in ('fly', 'keep', 'be', '')
    known = [m for uav in flying for m in frame.scene.missions_of(uav)[-1:]]
    if frame.key == 'keep' and frame.verb is not None and known:
        said = frame.scene.prompt[frame.verb.start : frame.verb.end].lower()
        stays = said.startswith(('hold', 'held', 'stay', 'remain'))
        return told and stays and all(m.mode is MissionMode.NAVIGATE for m in known)
    return told and not known
