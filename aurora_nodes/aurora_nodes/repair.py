# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The `repair` node: service `/aurora/repair`."""

from __future__ import annotations

from pathlib import Path

from pydantic import ValidationError

from aurora_core.errors import SpecError
from aurora_core.outcomes.repair import ProposalOutcome, past_of
from aurora_core.outcomes.verdict import Verdict
from aurora_core.pipeline.functions import repair_stage
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.trace.bag_content import BagContent
from aurora_core.trace.bag_reader import read_bag
from aurora_core.trace.definitions import message_definitions
from aurora_msgs.srv import ProposeRepair
from aurora_ros import interfaces as on
from aurora_ros.conversions.messages import agsg
from aurora_ros.main import run_node
from aurora_ros.node import AuroraNode


class RepairNode(AuroraNode):
    """Graph, verdict and recording of a violated run in; causes and a plan out."""

    def __init__(self) -> None:
        super().__init__('repair')
        self._known = installed_knowledge()
        self._definitions = message_definitions()
        self.serve(on.REPAIR, self._propose)

    def _propose(
        self, request: ProposeRepair.Request, response: ProposeRepair.Response
    ) -> ProposeRepair.Response:
        try:
            verdict = Verdict.model_validate_json(request.verdict.verdict_json)
        except ValidationError as err:
            raise SpecError(f'verdict_json is not valid: {err}') from err
        past = past_of(request.past_json or '[]')
        graph = agsg(request.agsg)
        content = self._recording(Path(request.bag_uri)) if request.bag_uri else None
        proposal = repair_stage(self._known, graph, verdict, past, content)
        response.proposed = proposal.outcome is ProposalOutcome.EDITED
        response.outcome = proposal.outcome.value
        response.proposal_json = proposal.model_dump_json()
        return response

    def _recording(self, bag: Path) -> BagContent:
        return read_bag(bag, self._definitions)


def main() -> int:
    """Run the node until it is told to end."""
    return run_node(RepairNode)
