# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The campaign: all graphs up, rounds of prompts in all of them at once, all down."""

from __future__ import annotations

import contextlib
import json
import time
from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any

from rclpy.type_support import check_for_type_support

from aurora_bench.graphs.one_graph import OneGraph
from aurora_bench.progress import Progress
from aurora_cli.clock import MonotonicClock
from aurora_cli.doctor.processes import NODES
from aurora_cli.installed import installed
from aurora_cli.local_engine import LocalStages
from aurora_core.errors import AuroraError, ExecutionError
from aurora_core.pipeline.run import run
from aurora_core.pipeline.stages import RunControl, RunRequest
from aurora_core.report.run_folder import RunFolder
from aurora_msgs.action import RunScenario
from aurora_ros import interfaces as on
from aurora_ros.matching import wait_until
from aurora_ros.testing.partner import Partner, partner

# Short scenarios that end differently; each graph begins with another one.
PROMPTS = (
    'A drone hovers at 20 meters over the ego car for 5 seconds.',
    'A drone hovers at 35 meters over a bus for 5 seconds.',
    'A drone ascends to 30 meters and then follows a motorcycle for 5 seconds.',
    'A drone hovers at 25 meters over the ego car for 8 seconds.',
    'A drone ascends to 40 meters and hovers for 6 seconds.',
)
_RUN_LIMIT_S = 600.0
_SEEN_LIMIT_S = 30.0


@dataclass(frozen=True, kw_only=True)
class RunRow:
    """One run.

    Attributes:
        round: From 0.
        domain: Of the graph that ran it.
        prompt: As sent.
        seed: Of the run; differs between graphs.
        run_id: '' when there was none.
        status: Of the report; 'error' with `problem` when none came.
        expected_status: Of the local engine.
        sha256: Trace hash.
        expected_sha256: Of the local engine.
        wall_s: Steady seconds from the goal to the result.
        problem: What else went wrong.
    """

    round: int
    domain: int
    prompt: str
    seed: int
    run_id: str = ''
    status: str = 'error'
    expected_status: str = ''
    sha256: str = ''
    expected_sha256: str = ''
    wall_s: float = 0.0
    problem: str = ''

    @property
    def is_equal(self) -> bool:
        """Whether graph and local engine agree."""
        same = (self.status, self.sha256) == (self.expected_status, self.expected_sha256)
        return same and not self.problem and bool(self.sha256)


@dataclass(kw_only=True)
class Outcome:
    """Everything that was found.

    Attributes:
        rows: All runs.
        problems: What must not be, in words.
        sockets: Number of sockets that take something in, by domain and node.
        ports: All UDP ports of each domain.
        up_s: Seconds until all graphs were up.
    """

    rows: list[RunRow] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)
    sockets: dict[str, dict[str, int]] = field(default_factory=dict)
    ports: dict[str, list[int]] = field(default_factory=dict)
    up_s: float = 0.0

    def as_results(self) -> dict[str, Any]:
        """Return plain values."""
        return {
            'runs': [{**asdict(row), 'equal': row.is_equal} for row in self.rows],
            'problems': self.problems,
            'sockets': self.sockets,
            'ports': self.ports,
            'up_s': self.up_s,
        }


def task(graph: int, round_number: int) -> tuple[str, int]:
    """Return prompt and seed of a graph in a round: no two graphs run the same at a time."""
    return PROMPTS[(graph + round_number) % len(PROMPTS)], 1 + graph


def expected(
    graphs: int, rounds: int, folder: Path, progress: Progress
) -> dict[tuple[str, int], tuple[str, str]]:
    """Run every task in the local engine; return status and trace hash of each."""
    tasks = sorted({task(g, r) for g in range(graphs) for r in range(rounds)})
    answers = {}
    for i, (prompt, seed) in enumerate(tasks):
        report = run(
            RunRequest(prompt=prompt, seed=seed),
            LocalStages(installed()),
            installed(),
            RunFolder(folder, f'20260101T000000Z-{i:06x}'),
            RunControl(),
            MonotonicClock(),
        )
        sha256 = report.trace.sha256 if report.trace is not None else ''
        answers[prompt, seed] = (report.status.value, sha256)
        progress.step(f'local engine, seed {seed}: {report.status.value} {sha256[:12]} {prompt}')
    return answers


def campaign(
    folder: Path, first_domain: int, graphs: int, rounds: int, progress: Progress
) -> Outcome:
    """Run the campaign in a folder of its own.

    Args:
        folder: For runs and logs.
        first_domain: ROS domain of the first graph; the others take the next ones.
        graphs: How many at once.
        rounds: Prompts for each.
        progress: Told of every step.
    """
    outcome = Outcome()
    answers = expected(graphs, rounds, folder / 'local', progress)
    all_graphs = [
        OneGraph(domain=first_domain + g, folder=folder / f'graph-{g}') for g in range(graphs)
    ]
    with ExitStack() as stack:
        stack.enter_context(_stopped_at_the_end(all_graphs, outcome, progress))
        begin_s = time.monotonic()
        with ThreadPoolExecutor(graphs) as pool:
            list(pool.map(OneGraph.up, all_graphs))
        outcome.up_s = time.monotonic() - begin_s
        progress.note(f'{graphs} graphs are up')
        # Two threads that load the same interface for the first time can meet half of it.
        check_for_type_support(RunScenario)
        partners = [stack.enter_context(partner(graph.domain)) for graph in all_graphs]
        for graph, play in zip(all_graphs, partners, strict=True):
            outcome.problems += _problems_seen_by(play, graph)
        _look(all_graphs, outcome)
        pool = stack.enter_context(ThreadPoolExecutor(graphs))
        for number in range(rounds):
            futures = [
                pool.submit(_one_run, play, graph, g, number, answers)
                for g, (play, graph) in enumerate(zip(partners, all_graphs, strict=True))
            ]
            rows = [future.result() for future in futures]
            outcome.rows += rows
            equal = sum(row.is_equal for row in rows)
            progress.step(
                f'round {number + 1}: {equal} of {graphs} equal to the local engine, '
                f'{max(row.wall_s for row in rows):.1f} s'
            )
        for graph, play in zip(all_graphs, partners, strict=True):
            outcome.problems += _problems_of_lists(play, graph, outcome.rows)
        _look(all_graphs, outcome)
    return outcome


@contextlib.contextmanager
def _stopped_at_the_end(
    graphs: list[OneGraph], outcome: Outcome, progress: Progress
) -> Iterator[None]:
    try:
        yield
    finally:
        for graph in graphs:
            try:
                graph.down()
            except ExecutionError as err:
                outcome.problems.append(str(err))
            outcome.problems += graph.problems_after_down()
        progress.note(f'{len(graphs)} graphs are down')


def _look(graphs: list[OneGraph], outcome: Outcome) -> None:
    """Look at every socket of every process, and whether two domains share a port."""
    for graph in graphs:
        sockets = graph.look()
        outcome.problems += graph.problems_while_up(sockets)
        name = str(graph.domain)
        outcome.sockets[name] = {node: len(taken) for node, taken in sockets.items()}
        outcome.ports[name] = sorted({s.port for taken in sockets.values() for s in taken})
    for i, one in enumerate(graphs):
        for other in graphs[i + 1 :]:
            shared = set(outcome.ports[str(one.domain)]) & set(outcome.ports[str(other.domain)])
            if shared:
                outcome.problems.append(
                    f'domains {one.domain} and {other.domain} share the ports {sorted(shared)}'
                )


def _problems_seen_by(play: Partner, graph: OneGraph) -> list[str]:
    """A domain shows its own nodes, each once, and nobody else."""
    wanted = sorted([*(name for name in NODES if name != 'uav_sim'), play.node.get_name()])
    beats = len(wanted) - 1

    def seen() -> list[str]:
        return sorted(name for name, _ in play.node.get_node_names_and_namespaces())

    def publishers() -> int:
        return int(play.node.count_publishers(on.HEARTBEAT.full_name))

    if wait_until(lambda: seen() == wanted and publishers() == beats, _SEEN_LIMIT_S, 0.1):
        return []
    return [
        f'domain {graph.domain}: expected the nodes {wanted} and {beats} heartbeats, '
        f'found {seen()} and {publishers()}'
    ]


def _one_run(
    play: Partner,
    graph: OneGraph,
    number_of_graph: int,
    number: int,
    answers: Mapping[tuple[str, int], tuple[str, str]],
) -> RunRow:
    prompt, seed = task(number_of_graph, number)
    status, sha256 = answers[prompt, seed]
    row = RunRow(
        round=number,
        domain=graph.domain,
        prompt=prompt,
        seed=seed,
        expected_status=status,
        expected_sha256=sha256,
    )
    goal = RunScenario.Goal(
        prompt=prompt, prompt_bytes=len(prompt), options_json=json.dumps({'seed': seed})
    )
    heard: set[str] = set()
    begin_s = time.monotonic()
    try:
        result = play.send_goal(
            on.RUN, goal, _RUN_LIMIT_S, on_feedback=lambda feedback: heard.add(feedback.run_id)
        )
    except AuroraError as err:
        log = graph.log_of(err.component)
        problem = f'{err.component}: {err}\n{log}'
        return replace(row, wall_s=time.monotonic() - begin_s, problem=problem)
    report = json.loads(result.report_json)
    problems = []
    if heard - {result.run_id}:
        problems.append(f'feedback of other runs: {sorted(heard - {result.run_id})}')
    if Path(result.run_dir).parent != graph.runs.resolve():
        problems.append(f'run folder {result.run_dir} is not below {graph.runs}')
    if report['prompt'] != prompt or report['seed'] != seed:
        problems.append(f'the report is about {report["prompt"]!r} with seed {report["seed"]}')
    if report['error'] is not None:
        problems.append(f'{report["error"]["component"]}: {report["error"]["message"]}')
    return replace(
        row,
        run_id=result.run_id,
        status=result.status,
        sha256=(report['trace'] or {}).get('sha256', ''),
        wall_s=time.monotonic() - begin_s,
        problem='; '.join(problems),
    )


def _problems_of_lists(play: Partner, graph: OneGraph, rows: list[RunRow]) -> list[str]:
    """An orchestrator knows its own runs, all of them, and no other."""
    own = {row.run_id for row in rows if row.domain == graph.domain and row.run_id}
    listed = set(play.call(on.LIST_RUNS, 30.0).run_id)
    problems = []
    if listed != own:
        problems.append(
            f'domain {graph.domain}: expected the runs {sorted(own)} to be listed, '
            f'found {sorted(listed)}'
        )
    foreign = {row.run_id for row in rows if row.domain != graph.domain and row.run_id}
    if own & foreign:
        problems.append(f'domain {graph.domain}: run ids of other domains: {own & foreign}')
    known = [i for i in sorted(foreign) if play.call(on.GET_RUN, 30.0, run_id=i).found]
    if known:
        problems.append(f'domain {graph.domain} knows runs of others: {known}')
    return problems
