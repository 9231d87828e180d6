# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import jsonschema
import numpy as np
import pytest
from mcap.records import Channel, Message

from aurora_core.report.schema import schema_text
from aurora_core.trace import messages
from aurora_core.trace.bag_writer import BagWriter
from aurora_core.trace.definitions import message_definitions
from aurora_core.trace.layout import UavColumn
from aurora_core.trace.mcap_scan import scan

Call = Callable[..., SimpleNamespace]
TICK = 400


@pytest.fixture
def first(here: Path, finished: SimpleNamespace) -> Path:
    folder: Path = here / 'runs' / finished.folder.name
    shutil.copytree(finished.folder, folder)
    return folder


@pytest.fixture
def second(here: Path, first: Path) -> Path:
    """The same run, recorded anew with one UAV state raised by 2 m."""
    definitions = message_definitions()
    name = messages.TOPICS[messages.UAV_STATE]
    topics: dict[int, str] = {}
    with BagWriter(here / 'second', definitions) as writer:
        for record in scan(first / 'bag.0' / 'bag.0_0.mcap'):
            if isinstance(record, Channel):
                topics[record.id] = record.topic
            if not isinstance(record, Message):
                continue
            topic, data = topics[record.channel_id], record.data
            if topic == messages.UAV_STATE and record.log_time == TICK * 50_000_000:
                state = definitions.decode(name, data)
                rows = np.array(state.data)
                rows[UavColumn.Z] += 2.0
                fields = {k: getattr(state, k) for k in ('header', 'run_number', 'tick')}
                data = definitions.encode(name, definitions.create(name, **fields, data=rows))
            writer.write(topic, messages.TOPICS[topic], data, record.log_time)
    return here / 'second'


def test_a_run_equals_itself(first: Path, call: Call) -> None:
    done = call('diff', first.name, str(first / 'bag.0'), '--json')
    report = json.loads(done.out)
    assert done.code == 0
    assert (report['equal'], report['margins'], report['inputs']) == (True, [], [])
    jsonschema.validate(report, json.loads(schema_text('diff')))
    assert 'the same to the last bit' in call('diff', str(first), str(first)).out


def test_the_first_difference_and_its_margins_are_named(
    first: Path, second: Path, call: Call
) -> None:
    done = call('diff', str(first), str(second), '--json')
    report = json.loads(done.out)
    assert done.code == 1
    jsonschema.validate(report, json.loads(schema_text('diff')))
    place = report['first_difference']
    assert (place['tick'], place['time_s']) == (TICK, TICK * 0.05)
    assert (place['topic'], place['body'], place['quantity']) == (messages.UAV_STATE, 'uav1', 'z')
    assert place['second'] - place['first'] == pytest.approx(2.0)
    assert [(t['topic'], t['differing_ticks']) for t in report['topics']] == [
        (messages.UAV_STATE, 1)
    ]
    changed = [m for m in report['margins'] if m['difference'] is not None and m['difference'] < 0]
    assert changed, 'a jump of two metres costs a margin'
    text = call('diff', str(first), str(second)).out
    assert f'tick {TICK} (20.00 s): /aurora/uav/state, uav1, z' in text
    assert 'Margins that differ' in text


def test_a_run_that_was_cut_differs_in_length(first: Path, here: Path, call: Call) -> None:
    shutil.copytree(first / 'bag.0', here / 'cut')
    file = here / 'cut' / 'bag.0_0.mcap'
    file.write_bytes(file.read_bytes()[: file.stat().st_size // 2])
    done = call('diff', str(first), 'cut')
    assert done.code == 1
    assert 'The same in every tick that both have' in done.out
    assert 'truncated' in done.out


def test_what_cannot_be_read_is_4_and_what_is_not_there_64(
    first: Path, here: Path, call: Call
) -> None:
    (here / 'text.mcap').write_text('no bag')
    done = call('diff', str(first), 'text.mcap')
    assert done.code == 4
    assert 'no MCAP file' in done.err
    assert call('diff', str(first), 'nothing').code == 64
    assert call('diff', str(first), str(first), '--iteration', '2').code == 64
