# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One execution from load to closed bag, in a worker thread, with clean-up on every exit."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rclpy.exceptions import InvalidHandle
from rclpy.impl.implementation_singleton import rclpy_implementation

from aurora_core.errors import AuroraError, ExecutionError, ParticipantSilentError
from aurora_core.execution.plan import Execution
from aurora_core.outcomes.agsg import Agsg
from aurora_msgs.msg import RunEnd
from aurora_msgs.srv import (
    LoadSync,
    RunDigest,
    StartRecording,
    StartSync,
    StopRecording,
    StopSync,
)
from aurora_nodes.tick_path import AIR, GROUND, ActiveRun, TickPath
from aurora_ros import interfaces as on
from aurora_ros.account import Account, tampered
from aurora_ros.call import Caller
from aurora_ros.conversions.loads import ground_request, uav_request
from aurora_ros.conversions.messages import agsg_message, message_builder, world_message
from aurora_ros.heartbeat import HeartbeatWatch
from aurora_ros.lifecycle import ManagedNode
from aurora_ros.matching import await_subscribers, twins, wait_until
from aurora_ros.parameters import require_positive
from aurora_ros.writers import COMPONENT as WRITERS
from aurora_ros.writers import MatchedWriters, Stranger, named, second_one, strangers

CALLS = (
    on.GROUND_LOAD,
    on.UAV_LOAD,
    on.GROUND_DIGEST,
    on.UAV_DIGEST,
    on.SYNC_LOAD,
    on.SYNC_START,
    on.SYNC_STOP,
    on.RECORDER_START,
    on.RECORDER_STOP,
)
_LOOK_S = 0.05
_SETTLE_S = 0.6  # the others' leases of whoever died end within one announcement of ours
_WRITERS_S = 0.2  # how often it is looked who writes and serves
_DIGESTS = {GROUND: on.GROUND_DIGEST, AIR: on.UAV_DIGEST}
_LATCHED = (on.AGSG, on.ROSTER, on.WORLD)
# Of these the recorder does not know who writes.
_UNRECORDED = tuple(topic for topic in on.RUN_TOPICS if topic not in on.RECORDED)
_RECORDED = (*_LATCHED, on.GROUND_STATE, on.GROUND_COMMAND, on.COMM, on.SENSING, on.EVENTS)
_RECORDED_WITH_UAVS = (*_RECORDED, on.UAV_STATE, on.UAV_COMMAND)


@dataclass(frozen=True, kw_only=True)
class ExecutorSettings:
    """See `config/executor.param.yaml`."""

    autostart: bool
    call_limit_s: float
    load_limit_s: float
    stop_limit_s: float
    twin_limit_s: float
    silence_limit_s: float
    feedback_period_s: float
    live_monitor: bool

    def __post_init__(self) -> None:
        require_positive(self, 'call_limit_s', 'load_limit_s', 'stop_limit_s')
        require_positive(self, 'twin_limit_s', 'silence_limit_s', 'feedback_period_s')


@dataclass(frozen=True, slots=True, kw_only=True)
class Order:
    """What is to be executed.

    Attributes:
        run_id: Of the run folder.
        agsg: Grounded graph, published beside roster and world.
        bag_directory: Folder to create.
    """

    run_id: str
    agsg: Agsg
    execution: Execution
    bag_directory: Path


@dataclass(frozen=True, slots=True, kw_only=True)
class Done:
    """A closed recording.

    Attributes:
        outcome: finished, horizon or cancelled.
        states_sha256: Digests of the states that were heard, by `GROUND` and `AIR`.
    """

    bag: Path
    ticks: int
    outcome: str
    states_sha256: Mapping[str, str]


class RunDriver:
    """Drives bridges, sync and recorder through one run after another.

    Args:
        node: The executor.
        path: Its part of each tick.
        watch: Tells who has died.
        settings: Wall-clock limits.
    """

    def __init__(
        self, node: ManagedNode, path: TickPath, watch: HeartbeatWatch, settings: ExecutorSettings
    ) -> None:
        self._node = node
        self._path = path
        self._watch = watch
        self._settings = settings
        # Every wait of a run notices the death of anybody who takes part in it.
        self._caller = Caller(node, watch, guard=self._check_participants)
        self._participants: tuple[str, ...] = ()
        self._caller.prepare(*CALLS)
        self._publishers = {topic: node.publisher(topic) for topic in (*_LATCHED, on.RUN_END)}
        self._observers = ['recorder', *(['monitor'] if settings.live_monitor else [])]
        self._matched = MatchedWriters.on(node, _UNRECORDED)

    def close(self) -> None:
        """Release what would keep endpoints of the node alive."""
        self._matched.close()

    def run(
        self, order: Order, *, on_tick: Callable[[int], None], cancelled: Callable[[], bool]
    ) -> Done:
        """Execute and record a scenario; blocks until everything is closed.

        Raises:
            AuroraError: A component refused, failed, fell silent or died; it is named.
        """
        # Unique over restarts of this node too, so that a stray sample never fits a later run.
        run_number = time.time_ns()
        execution = order.execution
        run = ActiveRun(
            run_number=run_number,
            dt_s=execution.roster.dt_s,
            builder=message_builder(run_number, execution.roster.dt_s),
            stepper=execution.stepper,
            has_uavs=bool(execution.roster.uavs),
            on_tick=on_tick,
        )
        self._node.heartbeat.busy(run_number)
        self._participants = ('sync', 'sumo_bridge', *self._observers)
        if run.has_uavs:
            self._participants += ('uav_bridge',)
        recording = False
        try:
            self._await_participants(cancelled)
            self._await_alone(cancelled)
            self._matched.begin()
            self._load(order, run)
            self._start_recording(order, run)
            recording = True
            self._publish_documents(order, run)
            # Who was there before may have become known only now; nothing is flown yet.
            self._await_alone(cancelled)
            self._path.arm(run)
            self._call(on.SYNC_START, StartSync.Request(run_number=run_number))
            self._await_end(run, cancelled)
            self._path.disarm()
            self._check_writers(self._strangers())
            self._check_accounts(run)
            self._publish_end(order, run)
            self._stop_clock(run)
            bag = self._stop_recording(run, complete=True)
            recording = False
            self._check_writers(self._strangers(), last=True)
        except AuroraError as err:
            cause = self._cause(err)
            self._participants = ()  # the clean-up goes on without whoever died
            self._give_up(run, recording=recording)
            if cause is None:
                raise
            raise cause from err
        finally:
            self._participants = ()
            self._path.disarm()
            self._node.heartbeat.idle()
        return Done(
            bag=bag,
            ticks=run.last_tick + 1,
            outcome=run.outcome,
            states_sha256={name: it.states_sha256 for name, it in run.accounts.items()},
        )

    def _await_participants(self, cancelled: Callable[[], bool]) -> None:
        """Wait for whoever was started again just before this run.

        A node that was killed counts as a listener until its lease is over, so that no publisher
        can tell by counting whether the one started in its place listens already.

        Raises:
            ExecutionError: A name is there twice for longer than any lease.
        """
        settings = self._settings
        wait_until(
            lambda: cancelled() or not any(map(self._watch.is_dead, self._participants)),
            settings.call_limit_s,
            _LOOK_S,
        )
        names = (self._node.get_name(), *self._participants)
        if not twins(self._node, on.HEARTBEAT, names):
            return
        wait_until(
            lambda: cancelled() or not twins(self._node, on.HEARTBEAT, names),
            settings.twin_limit_s,
            _LOOK_S,
        )
        for name in () if cancelled() else twins(self._node, on.HEARTBEAT, names):
            raise ExecutionError(
                f'two nodes are named {name} (waited {settings.twin_limit_s:g} s)',
                component=name,
                hint='another graph runs in this ROS_DOMAIN_ID: end it or use another domain',
            )
        time.sleep(_SETTLE_S)

    def _await_alone(self, cancelled: Callable[[], bool]) -> None:
        """Wait until nobody else writes or serves what a run needs; one that died is forgotten.

        Raises:
            ExecutionError: Somebody does for longer than any lease.
        """
        limit_s = self._settings.twin_limit_s
        wait_until(lambda: cancelled() or not self._strangers(), limit_s, _LOOK_S)
        for stranger in () if cancelled() else self._strangers():
            raise second_one(stranger)

    def _strangers(self) -> list[Stranger]:
        names = (self._node.get_name(), *self._participants)
        return [*strangers(self._node, on.RUN_TOPICS, names), *self._caller.strangers()]

    def _check_writers(self, before: list[Stranger], *, last: bool = False) -> list[Stranger]:
        """Raise when somebody else writes or serves; return those that have no name yet.

        Args:
            before: What this returned at the last look.
            last: There is no later look.

        Raises:
            ExecutionError: Somebody does.
        """
        there = self._strangers()
        for stranger in there:
            if stranger.node or stranger in before:
                raise second_one(next(iter(named(self._strangers)), stranger))
        self._matched.check(last=last)
        return there

    def _load(self, order: Order, run: ActiveRun) -> None:
        execution = order.execution
        common: dict[str, Any] = {
            'run_id': order.run_id,
            'run_number': run.run_number,
            'horizon_s': execution.horizon_s,
        }
        self._call(
            on.SYNC_LOAD,
            LoadSync.Request(
                **common,
                dt_s=run.dt_s,
                participants=[self._node.get_name()],
                listeners=1 + run.has_uavs + 1,  # the bridges, and who counts the writers here
                observers=self._observers,
            ),
        )
        limit_s = self._settings.load_limit_s
        listeners = 1 + len(self._observers)  # of a state: this node too
        ground = ground_request(execution.ground_load, listeners=listeners, **common)
        self._call(on.GROUND_LOAD, ground, limit_s)
        run.accounts[GROUND] = Account(ground)
        if run.has_uavs:
            listeners += self._hears('sumo_bridge', on.UAV_STATE)
            air = uav_request(execution.air_load, listeners=listeners, **common)
            self._call(on.UAV_LOAD, air, limit_s)
            run.accounts[AIR] = Account(air)
        await_subscribers(
            self._path.listeners(run.has_uavs, observers=len(self._observers)),
            limit_s=self._settings.call_limit_s,
            component=self._node.get_name(),
        )

    def _start_recording(self, order: Order, run: ActiveRun) -> None:
        topics = _RECORDED_WITH_UAVS if run.has_uavs else _RECORDED
        request = StartRecording.Request(
            run_id=order.run_id,
            run_number=run.run_number,
            iteration=order.agsg.iteration,
            directory=str(order.bag_directory),
            topics=[topic.full_name for topic in topics],
        )
        self._call(on.RECORDER_START, request, self._settings.stop_limit_s)

    def _publish_documents(self, order: Order, run: ActiveRun) -> None:
        execution = order.execution
        messages = {
            on.AGSG: agsg_message(order.agsg, order.run_id),
            on.ROSTER: run.builder.roster(order.run_id, execution.roster),
            on.WORLD: world_message(run.builder, execution.world, order.run_id),
        }
        for topic, message in messages.items():
            self._publishers[topic].publish(message)
            run.sent[topic.full_name] += 1

    def _publish_end(self, order: Order, run: ActiveRun) -> None:
        """Tell the observers how much of what was sent."""
        sent = _sent(run)
        self._publishers[on.RUN_END].publish(
            RunEnd(
                run_number=run.run_number,
                run_id=order.run_id,
                iteration=order.agsg.iteration,
                last_tick=max(0, run.last_tick),
                topics=list(sent),
                counts=list(sent.values()),
            )
        )

    def _await_end(self, run: ActiveRun, cancelled: Callable[[], bool]) -> None:
        """Wait until sync ends the run; a cancelled one ends with its next tick.

        Raises:
            AuroraError: The run failed.
        """
        seen_tick, moved_at = run.last_tick, time.monotonic()
        looked_at, unnamed = moved_at, list[Stranger]()
        while not run.ended.is_set():
            run.stopping = run.stopping or cancelled()
            if run.last_tick != seen_tick:
                seen_tick, moved_at = run.last_tick, time.monotonic()
            self._check_alive(run, time.monotonic() - moved_at)
            if time.monotonic() - looked_at >= _WRITERS_S:
                looked_at, unnamed = time.monotonic(), self._check_writers(unnamed)
            run.ended.wait(_LOOK_S)
        if run.error is not None:
            raise run.error

    def _check_alive(self, run: ActiveRun, silent_s: float) -> None:
        self._check_participants()
        # sync names a silent participant before this; only a silent sync comes here.
        if silent_s > self._settings.silence_limit_s:
            raise ParticipantSilentError(
                f'no tick for {silent_s:.1f} s after tick {run.last_tick}', component='sync'
            )

    def _check_participants(self) -> None:
        """Raise when somebody who takes part in the run has died or was stopped."""
        for name in self._participants:
            cause = self._watch.cause_of_death(name)
            if cause:
                raise ParticipantSilentError(f'{name} {cause}', component=name)

    def _stop_recording(self, run: ActiveRun, *, complete: bool) -> Path:
        """Close the bag, after everything that was sent is in it if it is to be complete."""
        expected = _sent(run) if complete else {}
        request = StopRecording.Request(
            run_number=run.run_number,
            last_tick=max(0, run.last_tick),
            expected_topics=list(expected),
            expected_counts=list(expected.values()),
        )
        limit_s = self._settings.stop_limit_s
        response = self._caller.service(on.RECORDER_STOP, request, limit_s, await_restart=False)
        return Path(response.bag_uri)

    def _check_accounts(self, run: ActiveRun) -> None:
        """Hold what the others did against what they were asked for and what was heard.

        Raises:
            ExecutionError: They did something else: somebody wrote in another's name.
        """
        if not run.outcome:
            raise tampered(f'sync ended the run at tick {run.last_tick}, the executor did not')
        request = RunDigest.Request(run_number=run.run_number)
        limit_s = self._settings.call_limit_s
        for source, account in run.accounts.items():
            call = _DIGESTS[source]
            answer = self._caller.service(call, request, limit_s, await_restart=False)
            account.compare(answer, call.server)

    def _stop_clock(self, run: ActiveRun) -> None:
        request = StopSync.Request(run_number=run.run_number)
        limit_s = self._settings.call_limit_s
        self._caller.service(on.SYNC_STOP, request, limit_s, await_restart=False)

    def _give_up(self, run: ActiveRun, *, recording: bool) -> None:
        """Stop clock and recorder after a failure, whoever of them still answers."""
        self._path.disarm()
        try:
            self._stop_clock(run)
        except AuroraError as err:
            self._node.get_logger().warning(f'while cleaning up: {err}')
        if not recording:
            return
        try:
            self._stop_recording(run, complete=False)
        except AuroraError as err:
            self._node.get_logger().warning(f'while cleaning up: {err}')

    def _cause(self, error: AuroraError) -> AuroraError | None:
        """Return what is behind an error, if it is something else: a stranger's messages."""
        # Whoever died may have been started again already.
        if isinstance(error, ParticipantSilentError) or error.component == WRITERS:
            return None
        try:
            return next(map(second_one, named(self._strangers)), None)
        except (InvalidHandle, rclpy_implementation.RCLError):
            return None  # the node is being shut down under us

    def _hears(self, node: str, topic: on.Topic) -> bool:
        """Tell whether a node that need not does listen to a topic."""
        listeners = self._node.get_subscriptions_info_by_topic(topic.full_name)
        return node in {info.node_name for info in listeners}

    def _call(self, call: on.Call, request: object, limit_s: float | None = None) -> Any:
        return self._caller.service(call, request, limit_s or self._settings.call_limit_s)


def _sent(run: ActiveRun) -> dict[str, int]:
    """Return how many messages of each topic a complete run has."""
    counts = dict(run.sent)
    counts[on.GROUND_STATE.full_name] = run.last_tick + 1
    if run.has_uavs:
        counts[on.UAV_STATE.full_name] = run.last_tick + 1
    return counts
