# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Start every node of the graph in a domain of its own."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

from aurora_nodes.modules import MODULES
from aurora_ros.matching import wait_until
from aurora_ros.testing.domains import own_domain
from aurora_ros.testing.forked import ForkedNode
from aurora_ros.testing.partner import Partner, partner
from aurora_ros.testing.processes import NodeProcess

ROS_NODES = tuple(name for name in MODULES if name != 'uav_sim')


@dataclass(frozen=True, kw_only=True)
class RunningGraph:
    """A graph that is ready.

    Attributes:
        nodes: Processes by node name.
        play: The test's own node in the same domain.
        runs: Folder of all runs.
        start: Starts a node of this graph.
    """

    nodes: dict[str, NodeProcess]
    play: Partner
    runs: Path
    start: Callable[[str], NodeProcess]

    def restart(self, name: str) -> None:
        """Kill what is left of a node and start it again; return when the partner has heard it."""
        self.nodes[name].kill()
        self.nodes[name].ready_file.unlink(missing_ok=True)
        self.nodes[name] = self.start(name)
        self.nodes[name].await_ready()
        # Before that, the dead one is the only one that serves, for all the partner knows.
        watch, pid = self.play.watch, self.nodes[name].pid
        if watch.was_heard(name):
            wait_until(lambda: watch.process(name)[0] == pid, HEARD_WITHIN_S)

    def logs(self) -> str:
        """What the nodes have printed, for a failing test."""
        return '\n'.join(f'--- {name}\n{node.log}' for name, node in self.nodes.items())


HEARD_WITHIN_S = 10.0

Arguments = Callable[[int], Mapping[str, Sequence[str]]]


@contextmanager
def running_graph(
    folder: Path,
    names: Sequence[str] = tuple(MODULES),
    more_arguments: Arguments = lambda _domain: {},
) -> Iterator[RunningGraph]:
    """Yield a graph of the named nodes; whatever is left of it at the end is killed.

    Args:
        folder: For run folders, logs and ready files.
        names: Nodes to start.
        more_arguments: Gives words of command lines by node name, for a ROS domain.
    """
    runs = folder / 'runs'
    with ExitStack() as stack:
        domain = stack.enter_context(own_domain())
        own = {'orchestrator': ['--ros-args', '-p', f'runs_directory:={runs}']}
        more = more_arguments(domain)
        arguments = {name: [*own.get(name, ()), *more.get(name, ())] for name in MODULES}
        play = stack.enter_context(partner(domain))

        def start(name: str) -> NodeProcess:
            return ForkedNode(MODULES[name], domain, folder, arguments.get(name, ()))

        started = {name: start(name) for name in names}
        stack.callback(_kill_all, started)
        for node in started.values():
            node.await_ready()
        yield RunningGraph(nodes=started, play=play, runs=runs, start=start)


def _kill_all(started: dict[str, NodeProcess]) -> None:
    for node in started.values():
        node.kill()
