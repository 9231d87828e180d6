# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Prompts to a live graph, with a look at every stage as it begins."""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Callable
from typing import Any

from aurora_msgs.action import RunScenario
from aurora_ros import interfaces as on
from aurora_ros.testing.partner import Partner

RUN_LIMIT_S = 300.0
_LOOK_S = 0.002


class Run:
    """One prompt on its way through the graph, in a thread of its own.

    Attributes:
        stage: As the feedback said last.
        sim_time_s: The same.
        result: Of the action, once it is there.
        reported_s: Steady time when its report was begun: the end was noticed; 0 before.
        ended_s: Steady time of the result.
        error: What broke on the client's side.
    """

    def __init__(self, partner: Partner, prompt: str, options: dict[str, Any]) -> None:
        self.stage = ''
        self.run_id = ''
        self.sim_time_s = 0.0
        self.result: Any = None
        self.reported_s = 0.0
        self.ended_s = 0.0
        self.error = ''
        self._partner = partner
        self._goal = RunScenario.Goal(
            prompt=prompt, prompt_bytes=len(prompt.encode()), options_json=json.dumps(options)
        )
        self._thread = threading.Thread(target=self._work, daemon=True)
        self._thread.start()

    def wait_until(self, is_time: Callable[[Run], bool]) -> bool:
        """Wait for a moment of the run; return False when the run ended before it came."""
        while not is_time(self):
            if not self._thread.is_alive():
                return False
            time.sleep(_LOOK_S)
        return True

    def wait(self) -> Any:
        """Wait for the end and return the result, None when the client broke."""
        self._thread.join()
        return self.result

    def _on_feedback(self, feedback: RunScenario.Feedback) -> None:
        self.run_id = feedback.run_id
        self.stage = feedback.stage
        if feedback.stage in ('report', 'done') and not self.reported_s:
            self.reported_s = time.monotonic()
        self.sim_time_s = max(self.sim_time_s, feedback.sim_time_s)

    def _work(self) -> None:
        try:
            self.result = self._partner.send_goal(
                on.RUN, self._goal, RUN_LIMIT_S, on_feedback=self._on_feedback, raise_errors=False
            )
        except Exception as err:  # noqa: BLE001 - a finding of the campaign, told in its table
            self.error = f'{type(err).__name__}: {err}'
        self.ended_s = time.monotonic()


class Client:
    """Sends prompts and hears heartbeats.

    Args:
        partner: Node of this process in the graph's domain.
    """

    def __init__(self, partner: Partner) -> None:
        self._partner = partner
        self._watch = partner.watch

    def begin(self, prompt: str, options: dict[str, Any] | None = None) -> Run:
        """Send a prompt."""
        return Run(self._partner, prompt, options or {})

    def run(self, prompt: str, options: dict[str, Any] | None = None) -> Run:
        """Send a prompt and wait for the end of the run."""
        run = self.begin(prompt, options)
        run.wait()
        return run

    def busy(self, names: tuple[str, ...]) -> list[str]:
        """Return the living nodes that say that a run is going on."""
        return [n for n in names if self._watch.is_busy(n) and not self._watch.is_dead(n)]


def trace_hash(result: Any) -> str:
    """Return the trace hash of a result, '' when there is none."""
    try:
        return str(json.loads(result.report_json)['trace']['sha256'])
    except (AttributeError, ValueError, KeyError, TypeError):
        return ''
