# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`LockstepBridge`: what the two simulator bridges have in common."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from typing import Any

from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.subscription import Subscription

from aurora_core.errors import AuroraError, ExecutionError
from aurora_core.ports.simulators import FloatArray
from aurora_msgs.msg import Fault, SyncStatus, Tick
from aurora_msgs.srv import RunDigest
from aurora_ros import interfaces as on
from aurora_ros.account import Account, told
from aurora_ros.conversions.states import Rows
from aurora_ros.errors import write_error
from aurora_ros.heartbeat import HeartbeatWatch
from aurora_ros.interfaces import Call, Topic
from aurora_ros.lifecycle import ManagedNode
from aurora_ros.lockstep_input import LockstepInput
from aurora_ros.matching import await_subscribers
from aurora_ros.node import defect

_ENDED = (SyncStatus.IDLE, SyncStatus.FINISHED, SyncStatus.FAILED)
MATCH_LIMIT_S = 5.0
_CLOCK = 'sync'
_LOOK_S = 0.5


@dataclass(frozen=True, slots=True, kw_only=True)
class BridgeInterfaces:
    """The interfaces in which the bridges differ."""

    load: Call
    digest: Call
    command: Topic
    state: Topic


class LockstepBridge(ManagedNode):
    """Waits for the command of each tick, advances its simulator, publishes the state.

    The clock grants ticks ahead of time, as far as the observers' credit goes: inside that window
    the command stamped k, which the executor sends once it has every state of k - 1, is all that
    tick k waits for.

    Args:
        name: Node name.
        interfaces: What it serves.
    """

    def __init__(self, name: str, interfaces: BridgeInterfaces) -> None:
        super().__init__(name)
        self._interfaces = interfaces
        self._input: LockstepInput[Any] = LockstepInput(first_needs_input=False)
        self._run_number = 0
        self._rows: Rows[Any]  # once a run is loaded
        self._account: Account | None = None

    @abstractmethod
    def open_run(self, request: Any) -> None:
        """Load the simulator; afterwards it stands at tick 0."""

    @abstractmethod
    def state(self) -> FloatArray:
        """Return the state rows of tick 0."""

    @abstractmethod
    def advance(self, tick: int, command: Any) -> FloatArray:
        """Apply the command stamped `tick`, advance to it and return its state rows."""

    def stand_by(self) -> None:
        """Do what keeps the simulator while a run stands still; called twice a second."""

    def close_run(self) -> None:
        """Leave the simulator after a run; the next one loads it again."""

    def is_in_run(self, run_number: int) -> bool:
        """Tell whether it is loaded for this run, which goes on."""
        return run_number == self._input.run_number

    @property
    def awaited(self) -> Subscription | None:
        """The next command, or the clock's leave for it once the window is used up."""
        if self._input.run_number is None:
            return None
        return self._grants if self._input.lacks_grant else self._commands

    def configure(self) -> None:
        """Create the endpoints."""
        self._state_publisher = self.publisher(self._interfaces.state)
        self._fault_publisher = self.publisher(on.FAULT)
        self._grants = self.subscription(on.TICK, self._on_tick)
        self._commands = self.subscription(self._interfaces.command, self._on_command)
        self.subscription(on.SYNC_STATUS, self._on_sync_status)
        self._watch = HeartbeatWatch(self)
        self.create_timer(_LOOK_S, self._on_look, clock=Clock(clock_type=ClockType.STEADY_TIME))
        self.serve(self._interfaces.load, self._load)
        self.serve(self._interfaces.digest, self._digest)

    def deactivate(self) -> None:
        """Leave the run that is going on."""
        self._end_run()

    def _load(self, request: Any, response: Any) -> Any:
        self.require_active()
        self._refuse_twice(request.run_number)
        self._input.disarm()
        await_subscribers(
            {self._state_publisher: max(1, request.listeners)},
            limit_s=MATCH_LIMIT_S,
            component=self.get_name(),
        )
        self.open_run(request)
        self._run_number = request.run_number
        self._rows = Rows(self._interfaces.state.type, request.run_number, request.dt_s)
        self._account = Account(request)
        self._input.arm(request.run_number)
        self.heartbeat.busy(request.run_number)
        response.ok = True
        return response

    def _refuse_twice(self, run_number: int) -> None:
        """Refuse a second load of a run: what came last would be flown and nobody told.

        Raises:
            ExecutionError: The bridge is loaded for that run.
        """
        if run_number == self._input.run_number:
            name = self._interfaces.load.name
            raise ExecutionError(
                f'run {run_number} is loaded already: {name} was called a second time',
                component=self.get_name(),
                hint='use a network that nobody else reaches: up --isolated, or another '
                'ROS_DOMAIN_ID',
            )

    def _digest(
        self, request: RunDigest.Request, response: RunDigest.Response
    ) -> RunDigest.Response:
        if self._account is None or request.run_number != self._run_number:
            raise ExecutionError(
                f'run {request.run_number} was not the last one to be loaded',
                component=self.get_name(),
            )
        self._account.fill(response)
        response.ok = True
        return response

    def _on_tick(self, message: Tick) -> None:
        self._input.grant(message.run_number, message.tick)
        self._step()

    def _on_command(self, message: Any) -> None:
        try:
            self._input.put(message.run_number, message.tick, message)
        except ExecutionError as err:
            self._fail(err)
            return
        self._step()

    def _on_sync_status(self, message: SyncStatus) -> None:
        if message.run_number == self._input.run_number and message.state in _ENDED:
            self._end_run()

    def _on_look(self) -> None:
        """Leave a run whose clock has died: no word of its end will come."""
        if self._input.run_number is None:
            return
        self.stand_by()
        if self._watch.is_dead(_CLOCK):
            self.get_logger().error(f'{_CLOCK} {self._watch.cause_of_death(_CLOCK)}: run given up')
            self._end_run()

    def _step(self) -> None:
        """Do the next tick if everything for it is there."""
        ready = self._input.take()
        if ready is None:
            return
        tick, command = ready
        try:
            rows = self.state() if tick == 0 else self.advance(tick, command)
            message = self._rows.at(tick, rows)
        except AuroraError as err:
            self._fail(err)
            return
        except Exception as err:  # noqa: BLE001 - a defect: it ends the run, not the node
            self.log_defect()
            self._fail(defect(err, self.get_name()))
            return
        self._state_publisher.publish(message)
        if self._account is not None:
            self._account.add(b'' if command is None else told(command), message.data)
        self.heartbeat.at(tick)

    def _fail(self, err: AuroraError) -> None:
        """Tell sync, which ends the run with this node's name."""
        self.get_logger().error(f'{err.component}: {err}')
        message = Fault(run_number=self._run_number, node=self.get_name())
        write_error(message, err)
        self._fault_publisher.publish(message)
        self._end_run()

    def _end_run(self) -> None:
        if self._input.run_number is None:
            return
        self._input.disarm()
        self.close_run()
        self.heartbeat.idle()
