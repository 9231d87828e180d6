# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The `parser` node: service `/aurora/parse`.

A language model may take its time, so the node has several threads: roll calls and prompts for the
offline parser are answered meanwhile.
"""

from __future__ import annotations

import threading

from rclpy.callback_groups import ReentrantCallbackGroup

from aurora_core.errors import ExecutionError
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.pipeline.stages import RunRequest
from aurora_llm.parse import read_prompt
from aurora_msgs.srv import ParsePrompt
from aurora_nodes.prompts import received_prompt
from aurora_nodes.settings import PreloadSettings
from aurora_ros import interfaces as on
from aurora_ros.conversions.messages import agsg_message
from aurora_ros.conversions.options import run_request
from aurora_ros.main import Spinning, run_node
from aurora_ros.node import AuroraNode
from aurora_ros.parameters import declare

_THREADS = 4
_LOOK_S = 0.1


class ParserNode(AuroraNode):
    """Prompt in, specification and graph out."""

    def __init__(self) -> None:
        super().__init__('parser')
        settings = declare(self, 'parser', PreloadSettings)
        self._known = installed_knowledge()
        self._known.map(settings.preload_map)
        self._stopping = threading.Event()
        self._publisher = self.publisher(on.AGSG)
        self.serve(on.PARSE, self._parse, group=ReentrantCallbackGroup())

    def request_stop(self) -> None:
        """Wait for no model any more."""
        self._stopping.set()

    def _parse(
        self, request: ParsePrompt.Request, response: ParsePrompt.Response
    ) -> ParsePrompt.Response:
        prompt = received_prompt(request.prompt, request.prompt_bytes)
        options = run_request(prompt, request.options_json)
        outcome = self._read(options)
        response.outcome_json = outcome.model_dump_json(exclude={'model_calls'})
        response.transcript_jsonl = ''.join(
            call.model_dump_json() + '\n' for call in outcome.model_calls
        )
        response.understood = outcome.agsg is not None
        if outcome.agsg is not None:
            response.agsg = agsg_message(outcome.agsg, '')
            self._publisher.publish(response.agsg)
        return response

    def _read(self, options: RunRequest) -> ParseOutcome:
        """Read a prompt in a thread that the end of the node does not wait for."""
        outcomes: list[ParseOutcome] = []
        errors: list[Exception] = []

        def run() -> None:
            try:
                outcomes.append(read_prompt(self._known, options))
            except Exception as err:  # noqa: BLE001 - raised again in the waiting thread
                errors.append(err)

        thread = threading.Thread(target=run, name='parse', daemon=True)
        thread.start()
        while thread.is_alive() and not self._stopping.is_set():
            thread.join(_LOOK_S)
        if errors:
            raise errors[0]
        if not outcomes:
            raise ExecutionError('the parser was told to end', component='parser')
        return outcomes[0]


def main() -> int:
    """Run the node until it is told to end."""
    return run_node(ParserNode, spinning=Spinning.MANY_THREADS, threads=_THREADS)
