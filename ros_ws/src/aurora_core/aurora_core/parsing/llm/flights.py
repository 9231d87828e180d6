# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Missions and links of a reading as drafts of the scene."""

from __future__ import annotations

from aurora_core.parsing.constructions.pattern_values import no_width
from aurora_core.parsing.llm.parts import Parts
from aurora_core.parsing.llm.reading import LinkReading, MissionReading
from aurora_core.parsing.scene import LinkDraft, MissionDraft
from aurora_core.parsing.values import default
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.reference import is_place
from aurora_core.spec.vocabulary import LinkOcclusion, MissionMode, Pattern, Side


def add_mission(said: MissionReading, parts: Parts) -> None:
    """Add a mission phase; what it leaves unsaid is filled in by the scene rules."""
    where = said.id
    uav = parts.actor(said.uav, where, flies=True)
    if uav is None:
        return
    if said.target is not None and parts.ref(said.target) == uav.id:
        parts.complaints.append(f'{where}: a UAV is not its own target')
    tracks = said.mode is MissionMode.TRACK
    if tracks and said.target is not None:
        parts.actor(said.target, f'{where}.target')
    parts.scene.missions.append(
        MissionDraft(
            id=parts.ref(said.id),
            uav=uav,
            mode=said.mode,
            clause=0,
            target=parts.ref_or_none(said.target),
            start=_start(said, parts),
            needs_target=tracks and said.target is None,
            altitude=parts.number('altitude', said.altitude_m, f'{where}.altitude_m'),
            standoff=parts.number('standoff', said.standoff_m, f'{where}.standoff_m'),
            bearing=parts.number('bearing', said.bearing_deg, f'{where}.bearing_deg'),
            side=_side(said, parts),
            duration=parts.number('mission_duration', said.duration_s, f'{where}.duration_s'),
            pattern=said.pattern if said.mode is MissionMode.NAVIGATE else None,
            size=_size(said, parts),
            radius=parts.number('orbit_radius', said.radius_m, f'{where}.radius_m'),
            waypoint_count=parts.number(
                'waypoint_count', said.waypoint_count, f'{where}.waypoint_count'
            ),
            turns=_turns(said, parts),
            speed=parts.number('uav_speed', said.speed_mps, f'{where}.speed_mps'),
            dwell=parts.number('condition_time', said.dwell_s, f'{where}.dwell_s'),
            over_streets=said.over_streets,
            ends_in_flight=said.ends_in_flight,
            span=parts.span(said.quote, where),
        )
    )


def _start(said: MissionReading, parts: Parts) -> str | None:
    start = parts.ref_or_none(said.start)
    if start is None:
        return None
    ends = parts.ref_or_none(said.target)
    if (
        said.pattern is not Pattern.WAYPOINTS
        or ends is None
        or not (is_place(start) and is_place(ends))
    ):
        parts.complaints.append(
            f'{said.id}.start: a way by waypoints leads from a place to a target that is a place'
        )
        return None
    return start


def _side(said: MissionReading, parts: Parts) -> Side | None:
    if said.side is not None and said.mode is not MissionMode.TRACK:
        parts.complaints.append(f'{said.id}.side: only who tracks keeps to a side')
        return None
    return said.side


def _turns(said: MissionReading, parts: Parts) -> Parameter | None:
    where = f'{said.id}.turns'
    if said.turns is not None and said.pattern is not Pattern.ORBIT:
        parts.complaints.append(f'{where}: only an orbit has turns')
        return None
    return parts.number('turns', said.turns, where)


def _size(said: MissionReading, parts: Parts) -> tuple[Parameter, Parameter] | None:
    length = parts.number('pattern_length', said.length_m, f'{said.id}.length_m')
    width = parts.number('pattern_width', said.width_m, f'{said.id}.width_m')
    if length is None and width is None:
        return None
    unsaid = no_width() if said.pattern is Pattern.LINE else default('pattern_width')
    return length or default('pattern_length'), width or unsaid


def add_link(said: LinkReading, parts: Parts) -> None:
    """Add a message link that the prompt describes."""
    where = said.id
    sender = parts.actor(said.sender, f'{where}.sender')
    receiver = parts.actor(said.receiver, f'{where}.receiver')
    if sender is None or receiver is None:
        return
    if sender is receiver:
        parts.complaints.append(f'{where}: sender and receiver are the same')
    parts.scene.links.append(
        LinkDraft(
            id=parts.ref(said.id),
            sender=sender.id,
            receiver=receiver.id,
            loss=parts.number('link_loss', said.loss, f'{where}.loss'),
            latency=parts.number('link_latency', said.latency_s, f'{where}.latency_s'),
            range=parts.number('link_range', said.range_m, f'{where}.range_m'),
            retransmissions=parts.number(
                'link_retransmissions', said.retransmissions, f'{where}.retransmissions'
            ),
            interval=parts.number(
                'link_retransmission_interval', said.retry_interval_s, f'{where}.retry_interval_s'
            ),
            occlusion=said.occlusion or LinkOcclusion.SHORTENS,
            outage=_outage(said, parts),
            rate=parts.number('link_rate', said.rate_hz, f'{where}.rate_hz'),
            span=parts.span(said.quote, where),
        )
    )


def _outage(said: LinkReading, parts: Parts) -> tuple[Parameter, Parameter] | None:
    begins = parts.number('link_outage', said.outage_from_s, f'{said.id}.outage_from_s')
    ends = parts.number('link_outage', said.outage_to_s, f'{said.id}.outage_to_s')
    if begins is None and ends is None:
        return None
    if begins is None or ends is None or not 0.0 <= begins.value < ends.value:
        parts.complaints.append(f'{said.id}: an outage has a beginning and a later end')
        return None
    return begins, ends
