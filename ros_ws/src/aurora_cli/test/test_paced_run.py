# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A run with an autopilot that keeps its own time: judged as any other, and it says what it is."""

from __future__ import annotations

from collections.abc import Callable
from io import StringIO
from pathlib import Path

import pytest
from rich.console import Console

from aurora_cli.answers import Run, run_stages
from aurora_cli.installed import installed
from aurora_cli.local_engine import LocalStages
from aurora_cli.main import run_command_line
from aurora_core.pipeline.stages import RunControl, RunRequest
from aurora_core.pipeline.verification import load_bag, verify_content
from aurora_core.ports.simulators import AirSimulator
from aurora_core.report.status import Status
from aurora_core.report.terminal import print_report
from aurora_core.trace.air_clock import AirClock
from aurora_core.trace.bag_recover import recover_bag
from aurora_core.trace.definitions import message_definitions
from aurora_uav_bridge.paced_client import PacedClient
from aurora_uav_bridge.testing.virtual_time import VirtualTimeTransport
from aurora_uav_sim.mavlink_server import SimServer

PROMPT = 'A drone hovers over City Hall at 50 m for 10 seconds.'
DRIFT_PPM = 200.0


class PacedStages(LocalStages):
    """The simulator behind a late link, with a clock of its own, in counted time."""

    def air(
        self, request: RunRequest, system_ids: tuple[int, ...]
    ) -> tuple[AirSimulator, Callable[[], tuple[AirClock, ...]] | None]:
        del request
        transport = VirtualTimeTransport(
            SimServer(system_ids), drift_ppm=DRIFT_PPM, jitter_s=0.03, seed=2
        )
        client = PacedClient(transport)
        return client, client.clocks


@pytest.fixture(scope='module')
def run(tmp_path_factory: pytest.TempPathFactory) -> Run:
    request = RunRequest(prompt=PROMPT, repair=0, autopilot='udp://127.0.0.1:14540')
    root = tmp_path_factory.mktemp('runs')
    return run_stages(request, PacedStages(installed()), root, RunControl())


def test_it_is_verified_and_tells_its_clock(run: Run) -> None:
    assert run.status is Status.VERIFIED, run.report.summary
    assert run.trace is not None
    (clock,) = run.trace.clocks
    assert abs(clock.drift_ppm - DRIFT_PPM) < 3.0 * clock.drift_sigma_ppm
    assert 0.0 < clock.uncertainty_s < 0.015
    said = StringIO()
    print_report(run.report, Console(file=said, width=200))
    assert 'no two such runs are bit-identical' in said.getvalue()
    assert f'drift {clock.drift_ppm:+.0f} ± ' in said.getvalue()
    run.write_page()
    page = (run.folder / 'report.html').read_text('utf-8')
    assert 'no two such runs are bit-identical' in page


def test_times_say_how_well_they_are_known(run: Run) -> None:
    times = [c for c in run.conditions if c.unit == 's' and c.margin is not None]
    assert times
    assert all('times of UAVs are known to ±0.0' in c.explanation for c in times)
    others = [c for c in run.conditions if c.unit != 's']
    assert not any('times of UAVs' in c.explanation for c in others)


def test_the_bag_alone_says_the_same(run: Run, tmp_path: Path) -> None:
    assert run.trace is not None
    content, agsg = load_bag(run.folder / run.trace.bag)
    assert content.air_clocks == run.trace.clocks
    verdict = verify_content(installed(), content, agsg)
    assert verdict.status is run.trace.verdict
    assert verdict.clocks == run.trace.clocks
    # A recovered recording must not pass for one of a lockstep.
    whole = run.folder / run.trace.bag
    cut = tmp_path / 'cut'
    cut.mkdir()
    (file,) = whole.glob('*.mcap')
    data = file.read_bytes()
    (cut / file.name).write_bytes(data[: len(data) - 200])
    recovery = recover_bag(cut, tmp_path / 'again', message_definitions())
    assert load_bag(Path(recovery.bag))[0].air_clocks == run.trace.clocks


def test_the_graph_is_not_asked_for_it(capsys: pytest.CaptureFixture[str]) -> None:
    options = ['run', '--engine', 'ros', '--autopilot', 'udp://127.0.0.1:14540', PROMPT]
    assert run_command_line(options) == 64
    assert 'local engine' in capsys.readouterr().err


def test_nobody_at_the_address_is_an_error_with_a_hint(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    options = ['run', '--out', str(tmp_path), '--autopilot', '127.0.0.1:14540', PROMPT]
    assert run_command_line(options) == 4
    assert 'udp://127.0.0.1:14540' in capsys.readouterr().out
