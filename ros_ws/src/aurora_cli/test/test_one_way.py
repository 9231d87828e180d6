# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One prompt passes every stage once, and JSON text is read at the borders only: counted."""

from __future__ import annotations

import json
import re
import sys
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from pkgutil import resolve_name
from types import CodeType, FrameType
from typing import Any

import pytest

import aurora
from aurora_core.feasibility.check import check_request
from aurora_core.outcomes.feasibility import FeasibilityVerdict
from aurora_core.outcomes.schedule import Schedule
from aurora_core.temporal.schedule import plan_time

PROMPT = 'A drone hovers at 20 meters over the ego car for 5 seconds.'
PAGE = Path(__file__).resolve().parents[4] / 'docs' / 'architecture.md'
WAY = re.findall(
    r'^\| (\w+) \| `([\w.]+)` \|',
    PAGE.read_text(encoding='utf-8').partition('## The way of one prompt')[2],
    re.MULTILINE,
)
# Who may read JSON text in a run, and how many documents: all of them are messages in the bag.
BORDERS = {
    'aurora_core.agsg.message': 4,  # request, grounding, schedule, conditions
    'aurora_core.trace.messages_world': 1,  # limits
    'aurora_core.pipeline.verification': 1,  # conditions of the world
}
# Reads texts for the modules above, so it is not who asks.
CODEC = 'aurora_core.judging.codec'
PYDANTIC_READS = ('validate_json', 'from_json')


def code_of(path: str) -> CodeType:
    """Return the code of a function of the page, `aurora_core.` left out."""
    full = path if path.startswith('aurora_') else f'aurora_core.{path}'
    code: CodeType = resolve_name(full).__code__
    return code


class Counted:
    """What a run entered and read."""

    def __init__(self) -> None:
        self.stage = ''
        self.entered: Counter[tuple[str, str]] = Counter()
        self.read: Counter[str] = Counter()
        self._names = {code_of(path): path for _, path in WAY}

    def progress(self, stage: str, _share: float, _now_s: float) -> None:
        self.stage = stage

    def profile(self, frame: FrameType, event: str, what: Any) -> None:
        code = frame.f_code
        if event == 'call' and code in self._names:
            self.entered[self.stage, self._names[code]] += 1
        elif (event == 'call' and code is json.JSONDecoder.decode.__code__) or (
            event == 'c_call' and what.__name__ in PYDANTIC_READS
        ):
            self.read[asker(frame)] += 1


def asker(frame: FrameType | None) -> str:
    """Return the module of core nearest up the stack."""
    while frame is not None:
        name = str(frame.f_globals.get('__name__'))
        if name.startswith('aurora_core.') and name != CODEC:
            return name
        frame = frame.f_back
    return ''


@contextmanager
def counting() -> Iterator[Counted]:
    counted, before = Counted(), sys.getprofile()
    sys.setprofile(counted.profile)
    try:
        yield counted
    finally:
        sys.setprofile(before)


def run(folder: Path) -> Counted:
    with aurora.Session(out=folder) as session, counting() as counted:
        done = session.run(PROMPT, control=aurora.RunControl(progress=counted.progress))
    assert done.status == 'verified'
    return counted


def test_every_stage_is_entered_once_and_text_is_read_at_the_borders(tmp_path: Path) -> None:
    counted = run(tmp_path)
    assert len(WAY) == 23
    assert counted.entered == Counter(WAY)
    assert counted.read == BORDERS


def test_a_second_entry_and_a_text_inside_are_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def twice(*arguments: Any) -> FeasibilityVerdict:
        check_request(*arguments)
        return check_request(*arguments)

    def through_text(*arguments: Any) -> Schedule:
        return Schedule.model_validate_json(plan_time(*arguments).canonical_json())

    monkeypatch.setattr('aurora_core.pipeline.functions.check_request', twice)
    monkeypatch.setattr('aurora_core.pipeline.functions.plan_time', through_text)
    counted = run(tmp_path)
    assert counted.entered - Counter(WAY) == {('check', 'feasibility.check.check_request'): 1}
    assert counted.read - Counter(BORDERS) == {'aurora_core.pipeline.functions': 1}
