# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The `grounding` node: services `/aurora/ground_scenario` and `/aurora/check`."""

from __future__ import annotations

from pydantic import ValidationError

from aurora_core.errors import SpecError
from aurora_core.outcomes.repair import RepairPlan
from aurora_core.pipeline.functions import check_stage, ground_stage
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_msgs.srv import Check, GroundScenario
from aurora_nodes.settings import PreloadSettings
from aurora_ros import interfaces as on
from aurora_ros.conversions.messages import agsg, agsg_message
from aurora_ros.conversions.options import run_request
from aurora_ros.main import run_node
from aurora_ros.node import AuroraNode
from aurora_ros.parameters import declare


class GroundingNode(AuroraNode):
    """Graph in; graph with places, schedule and conditions, or a verdict on feasibility, out."""

    def __init__(self) -> None:
        super().__init__('grounding')
        settings = declare(self, 'grounding', PreloadSettings)
        self._known = installed_knowledge()
        self._known.grounder(settings.preload_map)
        self._publisher = self.publisher(on.AGSG)
        self.serve(on.GROUND_SCENARIO, self._ground)
        self.serve(on.CHECK, self._check)

    def _ground(
        self, request: GroundScenario.Request, response: GroundScenario.Response
    ) -> GroundScenario.Response:
        options = run_request('', request.options_json)
        outcome = ground_stage(
            self._known, agsg(request.agsg), options.seed, _plan(request.plan_json)
        )
        response.outcome_json = outcome.model_dump_json()
        response.grounded = outcome.agsg is not None
        if outcome.agsg is not None:
            response.agsg = agsg_message(outcome.agsg, request.agsg.run_id)
            self._publisher.publish(response.agsg)
        return response

    def _check(self, request: Check.Request, response: Check.Response) -> Check.Response:
        verdict = check_stage(self._known, agsg(request.agsg))
        response.result = verdict.result.value
        response.feasibility_json = verdict.model_dump_json()
        return response


def _plan(text: str) -> RepairPlan | None:
    try:
        return RepairPlan.model_validate_json(text) if text else None
    except ValidationError as err:
        raise SpecError(f'plan_json is not valid: {err}') from err


def main() -> int:
    """Run the node until it is told to end."""
    return run_node(GroundingNode)
