# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The `monitor` node: service `/aurora/verify`."""

from __future__ import annotations

from pathlib import Path

from aurora_core.errors import VerificationError
from aurora_core.pipeline.functions import load_bag, verify_stage
from aurora_core.trace.hashing import trace_sha256
from aurora_msgs.srv import VerifyTrace
from aurora_ros import interfaces as on
from aurora_ros.conversions.verdict import verdict_message
from aurora_ros.main import run_node
from aurora_ros.node import AuroraNode


class MonitorNode(AuroraNode):
    """Bag in, verdict out."""

    def __init__(self) -> None:
        super().__init__('monitor')
        self._publisher = self.publisher(on.VERDICT)
        self.serve(on.VERIFY, self._verify)

    def _verify(
        self, request: VerifyTrace.Request, response: VerifyTrace.Response
    ) -> VerifyTrace.Response:
        bag = Path(request.bag_uri)
        content, graph = load_bag(bag)
        asked = request.agsg.sha256
        if asked and asked != graph.sha256:
            raise VerificationError(
                f'expected the bag of graph {asked[:12]}, found graph {graph.sha256[:12]}',
                hint='name the bag of this run and iteration',
            )
        response.verdict = verdict_message(
            verify_stage(bag),
            run_id=str(content.agsg_message.run_id),
            iteration=graph.iteration,
            end_s=content.trace.time_s(max(0, content.trace.ticks - 1)),
            trace_sha256=trace_sha256(content.trace, content.world),
        )
        self._publisher.publish(response.verdict)
        return response


def main() -> int:
    """Run the node until it is told to end."""
    return run_node(MonitorNode)
