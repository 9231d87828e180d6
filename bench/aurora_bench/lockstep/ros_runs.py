# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The graph, measured from outside: wall time by the clock's own state, CPU time by process."""

from __future__ import annotations

import dataclasses
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from aurora_bench.lockstep.figures import RunFigures
from aurora_bench.lockstep.graph import Graph
from aurora_bench.lockstep.processes import cpu_by_name
from aurora_bench.lockstep.scenarios import SEED
from aurora_bench.results import ResultsError
from aurora_cli.installed import installed
from aurora_core.errors import AuroraError
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.schedule import Schedule
from aurora_core.pipeline.functions import execution_stage
from aurora_core.pipeline.stages import RunRequest
from aurora_msgs.action import ExecuteScenario
from aurora_msgs.msg import SyncStatus
from aurora_ros import interfaces as on
from aurora_ros import qos
from aurora_ros.conversions.loads import ground_request, uav_request
from aurora_ros.conversions.messages import agsg_message
from aurora_ros.conversions.options import options_json
from aurora_ros.interfaces import Call
from aurora_ros.matching import wait_until
from aurora_ros.testing.partner import Partner, partner

_FIXED_LIMIT_S = 120.0
_LIMIT_PER_SIMULATED_S = 2.0
_CALL_LIMIT_S = 60.0
_STATUS_LIMIT_S = 5.0
_LISTENERS = 2


@dataclass(frozen=True, kw_only=True)
class _Mark:
    """When the clock changed its state, steady s, and what each process had used until then."""

    time_s: float
    cpu_s: dict[str, float]


class GraphClient:
    """Runs grounded graphs in a running graph.

    Args:
        graph: Where.
        play: A node in its domain.
    """

    def __init__(self, graph: Graph, play: Partner) -> None:
        self._graph = graph
        self._play = play
        self._marks: dict[int, _Mark] = {}
        self._last_tick = 0
        self._ended = threading.Event()
        # Each state in turn: a short run is over before the first one was looked at.
        statuses = dataclasses.replace(on.SYNC_STATUS, qos=qos.LATCHED_HISTORY)
        play.on(statuses, self._on_status)
        # The clock says at its start that it is idle, also to whoever comes later.
        if not wait_until(lambda: bool(self._marks), _STATUS_LIMIT_S):
            raise ResultsError('the clock does not say in which state it is')

    def run(self, agsg: Agsg, bag_directory: Path, *, records: bool = True) -> RunFigures:
        """Execute, and time it.

        Args:
            agsg: Grounded.
            bag_directory: To be made by the recorder.
            records: False in a graph without a recorder, where the run ends with an error once
                the ticks are done.

        Raises:
            AuroraError: The run broke.
            ResultsError: The clock did not say when it began or ended.
        """
        self._marks.clear()
        self._ended.clear()
        begin = time.monotonic()
        sha256 = ''
        try:
            result = self._execute(agsg, bag_directory)
            sha256 = result.trace_sha256
        except AuroraError:
            if records or SyncStatus.FINISHED not in self._marks:
                raise
        end = time.monotonic()
        if not self._ended.wait(_STATUS_LIMIT_S):
            raise ResultsError(f'the clock said nothing of the end of the run, only {self._marks}')
        first, last = self._marks[SyncStatus.RUNNING], self._marks[SyncStatus.FINISHED]
        parts = {name: last.cpu_s[name] - first.cpu_s[name] for name in first.cpu_s}
        return RunFigures(
            engine='ros',
            ticks=self._last_tick + 1,
            dt_s=installed().settings.run.dt_s,
            load_s=first.time_s - begin,
            loop_s=last.time_s - first.time_s,
            close_s=end - last.time_s,
            cpu_s=sum(parts.values()),
            parts_s=parts,
            sha256=sha256,
        )

    def verify_s(self, agsg: Agsg, bag: Path) -> float:
        """Let the monitor judge a bag; return the wall time."""
        message = agsg_message(agsg, bag.parent.name)
        begin = time.monotonic()
        self._play.call(on.VERIFY, _CALL_LIMIT_S, agsg=message, bag_uri=str(bag))
        return time.monotonic() - begin

    def load_services_s(self, agsg: Agsg) -> dict[str, float]:
        """Call the three load services alone; return the wall time of each."""
        execution = execution_stage(installed(), agsg, SEED, ())
        common: dict[str, Any] = {
            'run_id': 'bench',
            'run_number': time.time_ns(),
            'horizon_s': execution.horizon_s,
        }
        sync = on.SYNC_LOAD.type.Request(
            **common,
            dt_s=execution.roster.dt_s,
            participants=['executor'],
            listeners=2,
        )
        ground = ground_request(execution.ground_load, listeners=_LISTENERS, **common)
        air = uav_request(execution.air_load, listeners=_LISTENERS, **common)
        spent = {
            'sync': self._call_s(on.SYNC_LOAD, sync),
            'ground': self._call_s(on.GROUND_LOAD, ground),
            'uav': self._call_s(on.UAV_LOAD, air),
        }
        self._play.call(on.SYNC_STOP, _CALL_LIMIT_S, run_number=common['run_number'])
        return spent

    def _call_s(self, call: Call, request: Any) -> float:
        fields = {name: getattr(request, name) for name in request.get_fields_and_field_types()}
        begin = time.monotonic()
        self._play.call(call, _CALL_LIMIT_S, **fields)
        return time.monotonic() - begin

    def _execute(self, agsg: Agsg, bag_directory: Path) -> Any:
        horizon_s = Schedule.model_validate_json(agsg.texts.schedule).horizon_s
        return self._play.send_goal(
            on.EXECUTE,
            ExecuteScenario.Goal(
                agsg=agsg_message(agsg, bag_directory.parent.name),
                bag_directory=str(bag_directory),
                options_json=options_json(RunRequest(prompt='benchmark', seed=SEED)),
            ),
            _FIXED_LIMIT_S + horizon_s * _LIMIT_PER_SIMULATED_S,
        )

    def _on_status(self, message: SyncStatus) -> None:
        mark = _Mark(time_s=time.monotonic(), cpu_s=cpu_by_name(self._graph.pids))
        self._marks[message.state] = mark
        if message.state in (SyncStatus.FINISHED, SyncStatus.FAILED):
            self._last_tick = message.tick
            self._ended.set()


@contextmanager
def client_of(graph: Graph) -> Iterator[GraphClient]:
    """Yield a client in the domain of a graph."""
    with partner(graph.domain) as play:
        yield GraphClient(graph, play)
