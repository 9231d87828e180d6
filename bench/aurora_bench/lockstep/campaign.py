# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What is measured in which order: first the local engine alone, then the graph."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from aurora_bench.lockstep.figures import Engine, Measured, RunFigures
from aurora_bench.lockstep.scenarios import Configuration, grounded
from aurora_bench.machine import busy_share
from aurora_bench.progress import Progress
from aurora_cli.installed import installed
from aurora_core.outcomes.agsg import Agsg
from aurora_core.pipeline.verification import verify_stage

if TYPE_CHECKING:
    from aurora_bench.lockstep.ros_runs import GraphClient

# Longer runs average by themselves, and the campaign has to end within 25 minutes on two cores.
_LONG_S = 100
_LONG_REPETITIONS = 2
_BARRIER_REPETITIONS = 3
_LOAD_REPETITIONS = 5
# Of all cores: above that, wall times say more about the others than about us.
_QUIET_SHARE = 0.15


@dataclass(frozen=True, kw_only=True)
class Plan:
    """What is asked for.

    Attributes:
        repetitions: Of each configuration; runs of more than 100 s: at most 2.
        barrier_ticks: Of one repetition of the bare barrier.
        cold_starts: How often the graph is started.
    """

    engines: tuple[Engine, ...]
    configurations: tuple[Configuration, ...]
    repetitions: int
    barrier_ticks: int = 3000
    cold_starts: int = 3

    @property
    def base(self) -> Configuration:
        """The smallest one: for the recorder, the resets and the ratio to the bare barrier."""
        return min(self.configurations, key=lambda c: (c.uavs, c.seconds, c.agents))

    def rounds(self, configuration: Configuration) -> int:
        """Return how often a configuration is run."""
        long = configuration.seconds > _LONG_S
        return min(self.repetitions, _LONG_REPETITIONS) if long else self.repetitions

    def steps(self) -> int:
        """Return how many lines of progress there will be."""
        runs = sum(1 + len(self.engines) for _ in self.configurations)
        local = 1 if 'local' in self.engines else 0
        ros = 2 + 2 * self.cold_starts + _BARRIER_REPETITIONS if 'ros' in self.engines else 0
        return runs + local + ros


class Campaign:
    """Runs a plan and keeps what was found.

    Args:
        plan: What is asked for.
        progress: Told of each step.
    """

    def __init__(self, plan: Plan, progress: Progress) -> None:
        self._plan = plan
        self._progress = progress
        self._graphs: dict[Configuration, Agsg] = {}
        self.busy: list[float] = []
        self.measured: list[Measured] = []
        self.recorder_pairs: dict[Engine, list[tuple[RunFigures, RunFigures]]] = {}
        self.barrier_us: list[float] = []
        self.cold_start_s: list[float] = []
        self.bare_start_s: list[float] = []
        self.sumo_reload_s: list[float] = []
        self.load_services_s: list[Mapping[str, float]] = []

    def run(self) -> None:
        """Measure everything.

        Raises:
            AuroraError: A run broke.
        """
        for configuration in self._plan.configurations:
            self._progress.step(f'grounding {configuration}')
            self._graphs[configuration] = grounded(configuration)
        with tempfile.TemporaryDirectory(prefix='aurora-bench-') as folder:
            self._look_around()
            if 'local' in self._plan.engines:
                self._local(Path(folder) / 'local')
                self._look_around()
            if 'ros' in self._plan.engines:
                self._ros(Path(folder))
                self._look_around()

    @property
    def is_quiet(self) -> bool:
        """Whether nobody else used the machine at any of the looks."""
        return max(self.busy, default=0.0) <= _QUIET_SHARE

    def _look_around(self) -> None:
        self.busy.append(busy_share())
        self._progress.note(f'others use {self.busy[-1]:.0%} of the cores')

    def _local(self, folder: Path) -> None:
        from aurora_bench.lockstep import local_runs

        base = self._graphs[self._plan.base]
        local_runs.measure_local(base, folder / 'warm' / 'bag')
        for configuration in self._plan.configurations:
            self._repeat(
                'local',
                configuration,
                folder,
                local_runs.measure_local,
                _verify_locally,
            )
        self._pair(
            'local',
            folder / 'pairs',
            lambda bag: local_runs.measure_local(base, bag),
            lambda _bag: local_runs.measure_local_without_recorder(base),
        )
        self.sumo_reload_s = local_runs.sumo_reload_s(base, _LOAD_REPETITIONS)

    def _ros(self, folder: Path) -> None:
        from aurora_bench.lockstep.bare_start import measure_bare_start
        from aurora_bench.lockstep.graph import PROCESSES, running_graph
        from aurora_bench.lockstep.ros_runs import client_of

        self._barrier(_BARRIER_REPETITIONS - 1)
        for number in range(self._plan.cold_starts):
            bare_s = measure_bare_start(len(PROCESSES), folder / f'bare{number}')
            self.bare_start_s.append(bare_s)
            self._progress.step(f'bare start of as many processes: {bare_s:.2f} s')
            with running_graph(folder / f'graph{number}') as graph:
                self.cold_start_s.append(graph.cold_start_s)
                self._progress.step(f'cold start of the graph: {graph.cold_start_s:.2f} s')
                if number < self._plan.cold_starts - 1:
                    continue
                with client_of(graph) as client:
                    self._in_graph(client, folder)
        self._barrier(1)

    def _in_graph(self, client: GraphClient, folder: Path) -> None:
        from aurora_bench.lockstep.graph import graph_without_recorder
        from aurora_bench.lockstep.ros_runs import client_of

        base = self._graphs[self._plan.base]
        client.run(base, folder / 'warm' / 'bag')
        for configuration in self._plan.configurations:
            self._repeat('ros', configuration, folder, client.run, client.verify_s)
        self.load_services_s = [client.load_services_s(base) for _ in range(_LOAD_REPETITIONS)]
        self._progress.step('load services alone')
        with graph_without_recorder(folder / 'null') as graph, client_of(graph) as bare:
            bare.run(base, folder / 'null' / 'warm' / 'bag', records=False)
            self._pair(
                'ros',
                folder / 'pairs',
                lambda bag: client.run(base, bag),
                lambda bag: bare.run(base, bag, records=False),
            )

    def _pair(
        self,
        engine: Engine,
        folder: Path,
        record: Callable[[Path], RunFigures],
        skip: Callable[[Path], RunFigures],
    ) -> None:
        """Run with and without recorder by turns: a busy spell of the machine meets both."""
        pairs = []
        for number in range(self._plan.repetitions):
            place = folder / f'{engine}{number}'
            pairs.append((record(place / 'with' / 'bag'), skip(place / 'without' / 'bag')))
        self.recorder_pairs[engine] = pairs
        self._progress.step(
            f'{engine}, by turns without recorder: {_factors([p[1] for p in pairs])}'
        )

    def _repeat(
        self,
        engine: Engine,
        configuration: Configuration,
        folder: Path,
        measure: Callable[[Agsg, Path], RunFigures],
        verify: Callable[[Agsg, Path], float],
    ) -> None:
        graph = self._graphs[configuration]
        runs = []
        with tempfile.TemporaryDirectory(dir=_made(folder), prefix=f'{engine}-') as place:
            for number in range(self._plan.rounds(configuration)):
                bag = Path(place) / f'run{number}' / 'bag'
                runs.append(measure(graph, bag))
            verify_s = verify(graph, bag)
        self.measured.append(
            Measured(
                engine=engine,
                agents=configuration.agents,
                uavs=configuration.uavs,
                seconds=configuration.seconds,
                runs=tuple(runs),
                verify_s=verify_s,
            )
        )
        self._progress.step(f'{engine}, {configuration}: {_factors(runs)}')

    def _barrier(self, count: int) -> None:
        from aurora_bench.lockstep.barrier import measure_barrier
        from aurora_ros.testing.domains import own_domain

        for _ in range(count):
            with own_domain() as domain:
                self.barrier_us.append(measure_barrier(self._plan.barrier_ticks, domain))
            self._progress.step(f'bare barrier: {self.barrier_us[-1]:.0f} us per tick')


def _verify_locally(_graph: Agsg, bag: Path) -> float:
    begin = time.monotonic()
    verify_stage(installed(), bag)
    return time.monotonic() - begin


def _made(folder: Path) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def _factors(runs: Sequence[RunFigures]) -> str:
    factors = sorted(run.real_time_factor for run in runs)
    return f'{len(runs)} runs, real-time factor {factors[0]:.1f} to {factors[-1]:.1f}'
