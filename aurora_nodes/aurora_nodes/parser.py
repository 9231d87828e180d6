# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The `parser` node: service `/aurora/parse`."""

from __future__ import annotations

from aurora_core.agsg.build import build_agsg
from aurora_core.pipeline.functions import knowledge, parse_stage
from aurora_msgs.srv import ParsePrompt
from aurora_nodes.prompts import received_prompt
from aurora_nodes.settings import PreloadSettings
from aurora_ros import interfaces as on
from aurora_ros.conversions.messages import agsg_message
from aurora_ros.conversions.options import run_request
from aurora_ros.main import run_node
from aurora_ros.node import AuroraNode
from aurora_ros.parameters import declare


class ParserNode(AuroraNode):
    """Prompt in, specification and graph out."""

    def __init__(self) -> None:
        super().__init__('parser')
        settings = declare(self, 'parser', PreloadSettings)
        knowledge().map(settings.preload_map)
        self._publisher = self.publisher(on.AGSG)
        self.serve(on.PARSE, self._parse)

    def _parse(
        self, request: ParsePrompt.Request, response: ParsePrompt.Response
    ) -> ParsePrompt.Response:
        prompt = received_prompt(request.prompt, request.prompt_bytes)
        options = run_request(prompt, request.options_json)
        outcome = parse_stage(prompt, options.map_name, options.seed)
        response.outcome_json = outcome.model_dump_json()
        response.understood = outcome.spec is not None
        if outcome.spec is not None:
            digest = knowledge().map(options.map_name).digest
            graph = build_agsg(outcome.spec, map_digest=digest)
            response.agsg = agsg_message(graph, '')
            self._publisher.publish(response.agsg)
        return response


def main() -> int:
    """Run the node until it is told to end."""
    return run_node(ParserNode)
