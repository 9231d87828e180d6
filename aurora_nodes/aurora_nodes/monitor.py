# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The `monitor` node: judges a run as it was heard live, and its bag in `/aurora/verify`.

The bag decides. What was heard live must give the same margins to the last bit; if it does not,
something was lost or altered on one of the two ways, and nothing is claimed.
"""

from __future__ import annotations

import threading
import time
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from rclpy.exceptions import InvalidHandle
from rclpy.impl.implementation_singleton import rclpy_implementation

from aurora_core.errors import AuroraError, VerificationError
from aurora_core.outcomes.verdict import Verdict, VerdictStatus
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.trace.bag_reader import read_bag
from aurora_core.trace.definitions import message_definitions
from aurora_core.trace.trace import Integrity
from aurora_msgs.msg import Verdict as VerdictMessage
from aurora_msgs.srv import VerifyTrace
from aurora_nodes.judgement import Judgement, LiveOutcome, judge, reconcile
from aurora_nodes.live_margins import LiveMargins, Preview
from aurora_nodes.live_run import LiveRun, RunTotals
from aurora_nodes.live_watch import LiveSettings, LiveWatch
from aurora_ros import interfaces as on
from aurora_ros.conversions.verdict import (
    margins_message,
    outlooks_message,
    verdict_message,
)
from aurora_ros.heartbeat import HeartbeatWatch
from aurora_ros.main import run_node
from aurora_ros.node import AuroraNode, defect
from aurora_ros.parameters import declare

_T = TypeVar('_T')


class MonitorNode(AuroraNode):
    """Live run or bag in, verdict out."""

    def __init__(self) -> None:
        super().__init__('monitor')
        self._settings = declare(self, 'monitor', LiveSettings)
        self._definitions = message_definitions()
        self._known = installed_knowledge()
        self._verdicts = self.publisher(on.VERDICT)
        self._margins = self.publisher(on.MARGINS)
        self._heard: LiveOutcome | None = None
        self._judging: threading.Thread | None = None
        self._watch: LiveWatch | None = None
        if self._settings.live:
            previews = LiveMargins(
                self._definitions,
                self._settings.margins_period_s,
                self._settings.margins_lag_ticks,
                lambda: self._margins.get_subscription_count() > 0,
                self._preview,
                self.get_logger().warning,
            )
            self._watch = LiveWatch(
                self, self._settings, HeartbeatWatch(self), previews, self._on_end
            )
        self.serve(on.VERIFY, self._verify)

    def _verify(
        self, request: VerifyTrace.Request, response: VerifyTrace.Response
    ) -> VerifyTrace.Response:
        bag, asked = Path(request.bag_uri), request.agsg.sha256
        judgement = self._beside(
            lambda: judge(
                self._known,
                read_bag(bag, self._definitions),
                str(bag),
                self.heartbeat.came_further,
            )
        )
        if asked and asked != judgement.graph_sha256:
            raise VerificationError(
                f'expected the bag of graph {asked[:12]}, found graph '
                f'{judgement.graph_sha256[:12]}',
                hint='name the bag of this run and iteration',
            )
        while self._watch is not None and self._watch.is_ending:
            time.sleep(self._settings.poll_period_s)
            self._watch.poll()
        self._await(self._judging)
        verdict = reconcile(judgement, self._heard)
        response.verdict = _message(judgement, verdict, VerdictMessage.BAG)
        self._verdicts.publish(response.verdict)
        return response

    @property
    def is_idle(self) -> bool:
        """Whether nothing is being judged."""
        return self._judging is None or not self._judging.is_alive()

    def _on_end(self, run: LiveRun, totals: RunTotals) -> None:
        """Judge a run that has ended, in a thread: the node goes on to serve."""
        before = self._judging
        self._judging = threading.Thread(
            target=self._judge_live, args=(run, totals, before), name='live', daemon=True
        )
        self._judging.start()

    def _judge_live(
        self, run: LiveRun, totals: RunTotals, before: threading.Thread | None
    ) -> None:
        if before is not None:
            before.join()
        where = f'run {totals.run_id} as it was heard'
        try:
            judgement = judge(self._known, run.content(totals, self._definitions), where)
            self._remember(totals, judgement, '')
            self._publish(judgement, totals.run_number)
        except (InvalidHandle, rclpy_implementation.RCLError):
            return  # the node is being shut down under us
        except AuroraError as err:
            self._not_judged(totals, err)
        except Exception as err:  # noqa: BLE001 - a defect: logged, and told with the bag's verdict
            self.get_logger().error(traceback.format_exc())
            self._not_judged(totals, defect(err, self.get_name()))

    def _remember(self, totals: RunTotals, judgement: Judgement | None, problem: str) -> None:
        """Keep the outcome for the bag that will come; a replay has one already."""
        if not totals.replayed:
            self._heard = LiveOutcome(
                run_id=totals.run_id,
                iteration=totals.iteration,
                judgement=judgement,
                problem=problem,
            )

    def _not_judged(self, totals: RunTotals, err: AuroraError) -> None:
        """Say so, to whoever waits for the verdict too."""
        self.get_logger().error(f'run {totals.run_id} cannot be judged as it was heard: {err}')
        self._remember(totals, None, str(err))
        verdict = Verdict(
            status=VerdictStatus.INCONCLUSIVE,
            results=(),
            integrity=Integrity.UNKNOWN,
            notes=(str(err),),
        )
        message = verdict_message(
            verdict,
            run_id=totals.run_id,
            iteration=totals.iteration,
            end_s=0.0,
            trace_sha256='',
            source=VerdictMessage.LIVE,
        )
        self._verdicts.publish(message)

    def _preview(self, preview: Preview) -> None:
        self._margins.publish(
            outlooks_message(
                preview.scene.conditions,
                preview.outlooks,
                run_number=preview.run_number,
                tick=preview.tick,
                end_s=preview.end_s,
            )
        )

    def _publish(self, judgement: Judgement, run_number: int) -> None:
        self._margins.publish(
            margins_message(
                judgement.verdict,
                run_number=run_number,
                tick=judgement.last_tick,
                end_s=judgement.end_s,
            )
        )
        self._verdicts.publish(_message(judgement, judgement.verdict, VerdictMessage.LIVE))

    def _beside(self, work: Callable[[], _T]) -> _T:
        """Do long work in a thread, hearing and acknowledging a run meanwhile."""
        results: list[_T] = []
        errors: list[Exception] = []

        def run() -> None:
            try:
                results.append(work())
            except Exception as err:  # noqa: BLE001 - raised again in the node's thread
                errors.append(err)

        thread = threading.Thread(target=run, name='bag', daemon=True)
        thread.start()
        self._await(thread)
        if errors:
            raise errors[0]
        return results[0]

    def _await(self, thread: threading.Thread | None) -> None:
        while thread is not None and thread.is_alive():
            thread.join(self._settings.poll_period_s)
            if self._watch is not None:
                self._watch.look()


def _message(judgement: Judgement, verdict: Verdict, source: int) -> VerdictMessage:
    return verdict_message(
        verdict,
        run_id=judgement.run_id,
        iteration=judgement.iteration,
        end_s=judgement.end_s,
        trace_sha256=judgement.trace_sha256,
        source=source,
    )


def main() -> int:
    """Run the node until it is told to end."""
    return run_node(MonitorNode, background=True)
