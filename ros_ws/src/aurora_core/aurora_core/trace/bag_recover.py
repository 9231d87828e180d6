# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Make a readable bag out of one that was cut short or damaged; the original is never touched.

Kept is every message of every chunk that passes its checksum, in the order of the file; of a chunk
that does not, nothing is. The new bag says inside and in its metadata what it was recovered from,
so that it never counts as intact, and the same damage gives the same bytes again.
"""

from __future__ import annotations

import shutil
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path

from mcap.records import Channel, Message, Schema

from aurora_core.errors import BagError
from aurora_core.trace.air_clock import AIR_CLOCKS, clocks_note
from aurora_core.trace.bag_content import content_of, note_of, worst
from aurora_core.trace.bag_metadata import file_sha256, read_metadata
from aurora_core.trace.bag_reader import FileReading, bag_files
from aurora_core.trace.bag_writer import BagWriter
from aurora_core.trace.checkpoints import RECOVERY
from aurora_core.trace.definitions import MessageDefinitions
from aurora_core.trace.mcap_scan import scan
from aurora_core.trace.trace import Integrity, Trace


class Outcome(StrEnum):
    """What came of a recovery."""

    RECOVERED = 'recovered'
    ALREADY = 'already_recovered'  # an earlier recovery of the same bytes is there
    READABLE = 'readable'  # its structure is sound: nothing to recover


@dataclass(frozen=True, slots=True, kw_only=True)
class Recovery:
    """What was kept and what was lost.

    Attributes:
        outcome: See `Outcome`.
        source: The damaged file.
        bag: Folder that can be read now.
        integrity: Of that folder.
        kept: Messages by topic.
        lost: Number of messages that were lost, None when nobody can tell.
        last_complete_tick: Up to there no state and no command is missing; -1: none.
        complete_s: Simulated time of that tick.
        ticks: Ticks in the trace, those behind a gap too.
        gaps: Number of ticks that are missing or incomplete.
        damage: What was found, for people.
    """

    outcome: Outcome
    source: str
    bag: str
    integrity: Integrity
    kept: dict[str, int] = field(default_factory=dict)
    lost: int | None = 0
    last_complete_tick: int
    complete_s: float
    ticks: int
    gaps: int
    damage: tuple[str, ...] = ()


def recover_bag(path: Path, out: Path | None, definitions: MessageDefinitions) -> Recovery:
    """Recover a bag into a folder of its own.

    Args:
        path: Folder of the bag, or its MCAP file.
        out: Folder to make; `<folder of the bag>.recovered` when None.
        definitions: Layouts of the messages.

    Raises:
        BagError: There is no bag, nothing in it can be judged, or the folder is there already and
            holds something else.
    """
    files = bag_files(path)
    if len(files) > 1:
        raise BagError(
            f'{path} holds {len(files)} MCAP files', hint='name the one that is to be recovered'
        )
    source = files[0]
    reading = FileReading(source, definitions)
    stored = list(reading.messages())
    trace = content_of(stored, reading.damage, str(source)).trace
    if not reading.defects and reading.metadata is not None:
        kept = _kept(source)
        return _recovery(Outcome.READABLE, source, source.parent, trace, kept, reading)
    folder = out if out is not None else source.parent.with_name(f'{source.parent.name}.recovered')
    digest = file_sha256(source)
    outcome = Outcome.ALREADY
    if not _is_recovery_of(folder, digest):
        _write(source, folder, digest, reading, definitions)
        outcome = Outcome.RECOVERED
    return _recovery(outcome, source, folder, trace, _kept(source), reading)


def _recovery(
    outcome: Outcome,
    source: Path,
    folder: Path,
    trace: Trace,
    kept: dict[str, int],
    reading: FileReading,
) -> Recovery:
    complete = trace.missing_ticks[0] - 1 if trace.missing_ticks else trace.ticks - 1
    return Recovery(
        outcome=outcome,
        source=str(source),
        bag=str(folder),
        integrity=trace.integrity,
        kept=kept,
        lost=_lost(reading, kept),
        last_complete_tick=complete,
        complete_s=trace.time_s(max(0, complete)),
        ticks=trace.ticks,
        gaps=len(trace.missing_ticks),
        damage=tuple(dict.fromkeys(note for _, note in reading.damage)),
    )


def _lost(reading: FileReading, kept: dict[str, int]) -> int | None:
    if reading.metadata is not None and reading.metadata.topics:
        recorded = sum(topic.count for topic in reading.metadata.topics.values())
        return max(0, recorded - sum(kept.values()))
    known = [defect.messages for defect in reading.defects]
    return None if None in known else sum(count for count in known if count is not None)


def _kept(source: Path) -> dict[str, int]:
    channels: dict[int, str] = {}
    kept: dict[str, int] = {}
    for record in scan(source):
        if isinstance(record, Channel):
            channels.setdefault(record.id, record.topic)
            kept.setdefault(record.topic, 0)
        elif isinstance(record, Message) and record.channel_id in channels:
            kept[channels[record.channel_id]] += 1
    return kept


def _is_recovery_of(folder: Path, digest: str) -> bool:
    """Tell whether a folder holds the recovery of a file already.

    Raises:
        BagError: It is there and holds something else.
    """
    if not folder.exists():
        return False
    try:
        metadata = read_metadata(folder)
        sound = file_sha256(folder / metadata.file_name) == metadata.sha256
    except (OSError, ValueError):
        sound = False
    if sound and metadata.recovered_from == digest:
        return True
    raise BagError(
        f'{folder} is there already and is not the recovery of this bag',
        hint='name another folder with --out, or move that one away',
    )


def _write(
    source: Path,
    folder: Path,
    digest: str,
    reading: FileReading,
    definitions: MessageDefinitions,
) -> None:
    # Made aside and renamed: a recovery that is cut short itself leaves no half bag.
    aside = folder.parent / f'.recovering-{folder.name}'
    shutil.rmtree(aside, ignore_errors=True)
    try:
        with BagWriter(aside / folder.name, definitions, recovered_from=digest) as writer:
            writer.note(
                RECOVERY,
                {
                    'integrity': worst(reading.damage).value,
                    'note': note_of(reading.damage),
                    'from_sha256': digest,
                },
            )
            if reading.air_clocks:
                writer.note(AIR_CLOCKS, clocks_note(reading.air_clocks))
            _copy(source, writer)
        (aside / folder.name).rename(folder)
    except OSError as err:
        raise BagError(
            f'cannot write {folder}: {err}', hint='name another folder with --out'
        ) from err
    finally:
        shutil.rmtree(aside, ignore_errors=True)


def _copy(source: Path, writer: BagWriter) -> None:
    schemas: dict[int, Schema] = {}
    channels: dict[int, tuple[str, str]] = {}
    for record in scan(source):
        if isinstance(record, Schema):
            schemas.setdefault(record.id, record)
        elif isinstance(record, Channel) and record.id not in channels:
            schema = schemas.get(record.schema_id)
            if schema is None:
                schema = Schema(id=0, name='', encoding='', data=b'')
            writer.define(record.topic, schema, record.message_encoding)
            channels[record.id] = (record.topic, schema.name)
        elif isinstance(record, Message) and record.channel_id in channels:
            topic, type_name = channels[record.channel_id]
            writer.write(topic, type_name, record.data, record.log_time)
