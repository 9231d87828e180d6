# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The local engine's trace hash is that of what lies in the bag."""

from __future__ import annotations

import errno
import gc
from pathlib import Path

import libsumo
import numpy as np
import pytest

from aurora_cli.installed import installed
from aurora_cli.local_engine import LocalStages
from aurora_cli.main import run_command_line
from aurora_core.agsg.build import build_agsg
from aurora_core.errors import ExecutionError
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.feasibility import CheckStage
from aurora_core.pipeline.stages import ExecutionResult, RunControl, RunRequest
from aurora_core.spec.scenario import StatedCondition
from aurora_core.trace.bag_reader import read_bag
from aurora_core.trace.definitions import message_definitions
from aurora_core.trace.hashing import trace_sha256
from aurora_core.trace.layout import UavColumn
from aurora_core.trace.trace import Integrity
from aurora_sumo_bridge.proxies import proxy_id
from aurora_sumo_bridge.sumo_client import SumoClient

PROMPT = (
    'A van tailgates the ego car closely, closing from 45 meters; a tracking drone alerts the ego '
    'when the van comes within 20 meters.'
)
FAULT = {'kind': 'keep_away', 'subject': 'van1', 'at_s': 3.0}


def grounded(request: RunRequest) -> Agsg:
    stages = LocalStages(installed())
    spec = stages.parse(request).spec
    assert spec is not None
    graph = build_agsg(spec, map_digest=installed().map(request.map_name).digest)
    agsg = stages.ground(graph, request).agsg
    assert agsg is not None
    return agsg


@pytest.mark.parametrize('faults', [(), (FAULT,)])
@pytest.mark.parametrize('stop_after_s', [8.0, 1000.0])
def test_the_hash_is_that_of_the_bag(
    faults: tuple[dict[str, object], ...], stop_after_s: float, tmp_path: Path
) -> None:
    request = RunRequest.model_validate({'prompt': PROMPT, 'faults': faults})
    simulated_s = [0.0]

    def progress(_stage: str, _share: float, now_s: float) -> None:
        simulated_s[0] = now_s

    control = RunControl(progress=progress, cancelled=lambda: simulated_s[0] >= stop_after_s)
    result = LocalStages(installed()).execute(
        grounded(request), tmp_path / 'r' / 'bag.0', request, control
    )
    content = read_bag(result.bag, message_definitions())
    assert content.trace.integrity is Integrity.INTACT
    assert result.ticks == content.trace.ticks
    assert result.trace_sha256 == trace_sha256(content.trace, content.world)
    assert (result.outcome == 'cancelled') is (stop_after_s < 1000.0)
    assert gc.isenabled()


def test_uavs_stand_in_the_ground_world_and_no_hash_depends_on_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    request = RunRequest(prompt=PROMPT)
    agsg = grounded(request)
    simulated_s, stood = [0.0], []

    def progress(_stage: str, _share: float, now_s: float) -> None:
        simulated_s[0] = now_s
        if libsumo.poi.getIDCount():
            stood.append(libsumo.poi.getPosition(proxy_id(0)))

    def executed(name: str) -> ExecutionResult:
        control = RunControl(progress=progress, cancelled=lambda: simulated_s[0] >= 20.0)
        return LocalStages(installed()).execute(agsg, tmp_path / name / 'bag.0', request, control)

    shown = executed('shown')
    flown = read_bag(shown.bag, message_definitions()).trace.uav[:, 0, : UavColumn.Y + 1]
    assert np.ptp(flown, axis=0).max() > 20.0
    assert np.abs(np.array(stood) - flown).max() < 0.01
    stood.clear()
    monkeypatch.setattr(SumoClient, 'show_uavs', lambda _self, _rows: None)
    bare = executed('bare')
    assert not stood
    assert (shown.trace_sha256, shown.motion_sha256) == (bare.trace_sha256, bare.motion_sha256)


@pytest.mark.parametrize('without', [(), (CheckStage.STATIC,), (CheckStage.PROOFS,)])
def test_a_level_of_the_check_can_be_left_out_and_nothing_else(
    without: tuple[CheckStage, ...],
) -> None:
    """The ablation B5 of the benchmark: the same engine, without static verification."""
    prompt = 'A drone hovers over City Hall at 150 m.'
    stages = LocalStages(installed(), without=frozenset(without))
    request = RunRequest(prompt=prompt)
    outcome = stages.parse(request)
    assert outcome.agsg is not None
    spec = outcome.agsg.spec
    odd = StatedCondition.model_validate(
        {
            'id': 'c9',
            'quantity': 'altitude',
            'of': ('landmark:City Hall',),
            'op': '<=',
            'value': spec.missions[0].altitude_m,
        }
    )
    faulty = spec.model_copy(update={'conditions': (*spec.conditions, odd)})
    graph = build_agsg(faulty, map_digest=outcome.agsg.map_digest)
    verdict = stages.check(graph, request)
    assert bool(verdict.findings) is (CheckStage.STATIC not in without)
    assert bool(verdict.certificates) is (CheckStage.PROOFS not in without)


def test_a_run_that_breaks_has_recorded_every_tick_until_then(tmp_path: Path) -> None:
    """Ticks are written some at a time: those that wait must not be lost."""
    request = RunRequest(prompt='A drone hovers at 20 meters for 5 seconds.')

    def progress(_stage: str, _share: float, now_s: float) -> None:
        if now_s > 2.34:
            raise ExecutionError('broke', component='executor')

    with pytest.raises(ExecutionError, match='broke'):
        LocalStages(installed()).execute(
            grounded(request), tmp_path / 'r' / 'bag.0', request, RunControl(progress=progress)
        )
    content = read_bag(tmp_path / 'r' / 'bag.0', message_definitions())
    assert content.trace.ticks == 48  # 2.35 s and the first
    assert gc.isenabled()


@pytest.mark.parametrize(
    ('err', 'is_defect'),
    [(MemoryError(), False), (OSError(errno.EMFILE, 'full'), False), (KeyError('x'), True)],
)
def test_where_a_defect_is_stands_in_the_log_and_where_memory_ended_does_not(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    caplog: pytest.LogCaptureFixture,
    err: Exception,
    is_defect: bool,
) -> None:
    def breaks(*_: object) -> ExecutionResult:
        raise err

    monkeypatch.setattr(LocalStages, 'execute', breaks)
    prompt = 'A drone hovers at 20 meters for 5 seconds.'
    assert run_command_line(['run', prompt, '--no-repair', '--out', str(tmp_path)]) == 4
    (told,) = (r for r in caplog.records if 'broke' in r.getMessage())
    assert bool(told.exc_info) is is_defect
