# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The bare start: as many processes as the graph has, each with rclpy, a node and nothing else.

The yardstick for the start of the graph on the same machine at the same time. `main` is such a
node.
"""

from __future__ import annotations

import os
import signal
import time
from contextlib import ExitStack
from pathlib import Path


def measure_bare_start(count: int, folder: Path) -> float:
    """Start the processes at once; return the wall time until every node is there, seconds.

    Args:
        count: How many.
        folder: For logs and ready files.

    Raises:
        AssertionError: A process ended or was not ready in time; with its log.
    """
    # Here: each of the processes imports this file, too.
    from aurora_ros.testing.domains import own_domain
    from aurora_ros.testing.processes import NodeProcess

    with ExitStack() as stack:
        domain = stack.enter_context(own_domain())
        begin = time.perf_counter()
        processes = []
        for number in range(count):
            place = folder / str(number)
            place.mkdir(parents=True)
            processes.append(NodeProcess('aurora_bench.lockstep.bare_start', domain, place))
            stack.callback(processes[-1].kill)
        for process in processes:
            process.await_ready()
        return time.perf_counter() - begin


def main() -> int:
    """Be a node until a signal comes."""
    import rclpy
    from rclpy.node import Node

    rclpy.init()
    node = Node('bare', namespace='/bare')
    ready = Path(os.environ['AURORA_READY_FILE'])
    # Whole at once: a reader never sees it empty.
    temporary = ready.with_suffix('.part')
    temporary.write_text(f'{os.getpid()}\n', encoding='ascii')
    temporary.replace(ready)
    signal.pause()
    node.destroy_node()
    return 0
