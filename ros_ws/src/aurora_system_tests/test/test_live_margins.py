# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Margins while a run is heard, from the bytes of a real run in the order of the wire."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import UTC, datetime

import pytest

from aurora_cli.installed import installed

pytest.importorskip('rclpy')

from aurora_cli.local_engine import LocalStages
from aurora_core.pipeline.run import run
from aurora_core.pipeline.stages import RunControl, RunRequest
from aurora_core.report.run_folder import RunFolder, new_run_id
from aurora_core.report.run_report import RunReport
from aurora_core.trace import messages
from aurora_core.trace.bag_content import StoredMessage
from aurora_core.trace.bag_reader import read_stored
from aurora_core.trace.definitions import message_definitions
from aurora_nodes.live_margins import LiveMargins, Preview
from aurora_nodes.live_run import WATCHED, LiveRun
from aurora_ros import cdr as wire

PROMPT = (
    'A van tailgates the ego car closely, closing from 45 meters; a tracking drone alerts the ego '
    'when the van comes within 20 meters.'
)
# A look every half second of the run; the claims of a tick come up to this much later.
LOOK_TICKS, LAG_TICKS = 10, 20


class _FrozenClock:
    def seconds(self) -> float:
        return 0.0


@pytest.fixture(scope='module')
def recorded(tmp_path_factory: pytest.TempPathFactory) -> tuple[RunReport, list[StoredMessage]]:
    folder = RunFolder(tmp_path_factory.mktemp('run'), new_run_id(datetime.now(UTC), b'abc'))
    request = RunRequest.model_validate({'prompt': PROMPT})
    report = run(
        request, LocalStages(installed()), installed(), folder, RunControl(), _FrozenClock()
    )
    assert report.trace is not None
    stored = read_stored(folder.path / report.trace.bag, message_definitions())
    return report, list(stored.messages)


class _Listener:
    """Hears a recorded run, looking every LOOK_TICKS ticks."""

    def __init__(self, stored: list[StoredMessage], *, wanted: bool = True) -> None:
        self.previews: list[Preview] = []
        self.complaints: list[str] = []
        state = next(m for m in stored if m.topic == messages.GROUND_STATE)
        self.run = LiveRun(wire.run_and_tick(state.cdr)[0])
        self._margins = LiveMargins(
            message_definitions(),
            0.0,
            LAG_TICKS,
            lambda: wanted,
            self.previews.append,
            self.complaints.append,
            lambda: 0.0,
        )
        self._margins.begin(self.run)

    def hear(self, stored: list[StoredMessage]) -> None:
        for topic, cdr, tick in _in_order(stored):
            self.run.keep(topic, [cdr])
            if topic == messages.GROUND_STATE and tick % LOOK_TICKS == 0:
                self._margins.look()


def _in_order(stored: list[StoredMessage]) -> Iterator[tuple[str, bytes, int]]:
    """Documents first, then tick by tick, claims a second late."""
    rows = []
    for k, m in enumerate(stored):
        if m.topic not in WATCHED:
            continue
        documents = m.topic in (messages.AGSG, messages.ROSTER, messages.WORLD)
        tick = -1 if documents else wire.run_and_tick(m.cdr)[1]
        claim = m.topic in (messages.COMM, messages.SENSING, messages.EVENTS)
        rows.append((tick + (LAG_TICKS - 1 if claim else 0), k, m.topic, m.cdr, tick))
    for _, _, topic, cdr, tick in sorted(rows):
        yield topic, cdr, tick


def test_intervals_hold_the_margins_that_come_of_the_run(
    recorded: tuple[RunReport, list[StoredMessage]],
) -> None:
    report, stored = recorded
    listener = _Listener(stored)
    listener.hear(stored)
    assert listener.complaints == []
    margins = {row.id: row.margin for row in report.conditions}
    assert len(listener.previews) > 50
    for preview in listener.previews:
        assert {o.condition_id for o in preview.outlooks} == margins.keys()
        for outlook in preview.outlooks:
            margin = margins[outlook.condition_id]
            assert margin is not None
            assert outlook.low <= margin <= outlook.high, (preview.tick, outlook)
    ticks = [preview.tick for preview in listener.previews]
    assert ticks == sorted(set(ticks))


def test_a_message_that_does_not_fit_ends_the_preview_with_a_word(
    recorded: tuple[RunReport, list[StoredMessage]],
) -> None:
    _, stored = recorded
    definitions = message_definitions()
    wrong = []
    for m in stored:
        if m.topic == messages.GROUND_STATE and int(m.value.tick) == 400:
            value = definitions.decode(messages.TOPICS[m.topic], m.cdr)
            value.data = value.data[:-1]
            cdr = definitions.encode(messages.TOPICS[m.topic], value)
            wrong.append(StoredMessage(topic=m.topic, cdr=cdr, value=value))
        else:
            wrong.append(m)
    listener = _Listener(stored)
    listener.hear(wrong)
    assert len(listener.complaints) == 1
    assert 'at tick 400' in listener.complaints[0]
    assert 0 < listener.previews[-1].tick < 400


def test_nothing_is_worked_out_while_nobody_listens(
    recorded: tuple[RunReport, list[StoredMessage]],
) -> None:
    _, stored = recorded
    listener = _Listener(stored, wanted=False)
    listener.hear(stored)
    assert (listener.previews, listener.complaints) == ([], [])


def test_nothing_is_said_of_another_run(
    recorded: tuple[RunReport, list[StoredMessage]],
) -> None:
    _, stored = recorded
    listener = _Listener(stored)
    listener.run.run_number += 1
    listener.hear(stored)
    assert (listener.previews, listener.complaints) == ([], [])
