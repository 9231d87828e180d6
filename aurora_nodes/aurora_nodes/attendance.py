# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who takes part in the run that is going on, and whether all of them are still there."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

from aurora_core.errors import AuroraError, ExecutionError, ParticipantSilentError
from aurora_nodes.supervision import Supervision
from aurora_ros.heartbeat import HeartbeatWatch
from aurora_ros.parameters import require_positive
from aurora_ros.roll_call import Question, RollCall

# In the order of dependence: of several dead ones the first is named.
_ALWAYS = ('sync', 'sumo_bridge', 'recorder', 'monitor', 'executor')
_AIR = 'uav_bridge'
_REPAIR = 'repair'  # without it a violated run ends with its first verdict
_AT_WORK = ('grounding', 'parser')  # needed while they work; the call to them notices
EVERYBODY = (*_ALWAYS, _AIR, *_AT_WORK, _REPAIR)
_UNKNOWN = (0, 0)  # process of a node that no heartbeat has told of
_PAUSE_S = 0.05  # between two roll calls while somebody is missing


@dataclass(frozen=True, kw_only=True)
class AttendanceLimits:
    """See `config/orchestrator.param.yaml`; s of wall-clock time."""

    roll_call_s: float
    air_period_s: float

    def __post_init__(self) -> None:
        require_positive(self, 'roll_call_s', 'air_period_s')


class Attendance:
    """Looks after the participants of one run after another; used by the thread of the runs.

    A node counts from `open` to `close` and must stay the same process. uav_sim has no heartbeat:
    uav_bridge is asked about it every second (while a run is flown the lockstep itself asks).

    Args:
        roll_call: With clients for `EVERYBODY`.
        watch: Hears the heartbeats.
        supervision: Restarts dead nodes, when there is one.
        limits: Of the roll call.
    """

    def __init__(
        self,
        roll_call: RollCall,
        watch: HeartbeatWatch,
        supervision: Supervision,
        limits: AttendanceLimits,
    ) -> None:
        self._limits = limits
        self._watch = watch
        self._supervision = supervision
        self._roll_call = roll_call
        self._needed: tuple[str, ...] = ()
        self._processes: dict[str, tuple[int, int]] = {}
        self._question: Question | None = None

    def open(self, cancelled: Callable[[], bool]) -> None:
        """Wait until everybody is present, also who is being restarted; then begin to watch.

        Raises:
            AuroraError: Somebody is missing; the first one is named.
        """
        supervision = self._supervision
        everybody = (*_ALWAYS, *_AT_WORK, *self._known())
        deadline_s = time.monotonic() + supervision.restart_s
        while not cancelled():
            absent = self._roll_call.absent(
                everybody, self._limits.roll_call_s, cancelled=cancelled
            )
            # Only from now on nothing is restarted any more, so look again.
            if not absent and supervision.begin_run(deadline_s, cancelled):
                self._begin()
                if self._dead() is None:
                    return
                supervision.end_run()
            hopeless = any(supervision.has_given_up(e.component) for e in absent.values())
            if hopeless or time.monotonic() > deadline_s:
                self._raise_first(absent)
                raise ExecutionError(
                    f'nodes were still being restarted after {supervision.restart_s:g} s',
                    component='orchestrator',
                    hint='see what up says, and the logs of the nodes',
                )
            time.sleep(_PAUSE_S)

    def expect_air(self) -> None:
        """Count uav_bridge and uav_sim in: the scenario has UAVs."""
        if _AIR not in self._needed:
            self._needed = (_AIR, *self._needed)
            self._processes[_AIR] = self._watch.process(_AIR)

    def check(self) -> None:
        """Do nothing while everybody is there; made to be called in every wait.

        Raises:
            AuroraError: A participant has died, was stopped or is another process now.
        """
        dead = self._dead()
        if dead is not None:
            raise dead
        if _AIR in self._needed:
            self._ask_air()

    def confirm(self) -> None:
        """Call the roll: a run must not end well with a dead participant.

        Raises:
            AuroraError: Somebody is not there; the first one is named.
        """
        self._raise_first(self._roll_call.absent(self._needed, self._limits.roll_call_s))
        self.check()

    def close(self) -> None:
        """End the watch; dead nodes may be restarted again."""
        self._needed = ()
        self._processes = {}
        self._drop_question()
        self._supervision.end_run()

    def _begin(self) -> None:
        self._needed = _ALWAYS
        self._processes = {name: self._watch.process(name) for name in _ALWAYS}

    def _known(self) -> tuple[str, ...]:
        """Return who is not needed by every run and is there.

        Without uav_bridge prompts on the ground still run, without repair those that hold.
        """
        return tuple(name for name in (_AIR, _REPAIR) if self._watch.was_heard(name))

    @property
    def has_repair(self) -> bool:
        """Whether a node repairs."""
        return self._watch.was_heard(_REPAIR)

    def _dead(self) -> AuroraError | None:
        for name in self._needed:
            cause = self._watch.cause_of_death(name)
            if not cause and self._is_another(name):
                cause = 'was restarted during the run, or another graph runs in this ROS_DOMAIN_ID'
            if cause:
                return ParticipantSilentError(
                    f'{name} {cause}', component=name, hint=f'see the log of {name}'
                )
        return None

    def _is_another(self, name: str) -> bool:
        process = self._watch.process(name)
        if self._processes[name] == _UNKNOWN:
            # It answered the roll call before its first heartbeat said which process it is.
            self._processes[name] = process
        return process not in (_UNKNOWN, self._processes[name])

    def _ask_air(self) -> None:
        """Raise what the last question has brought; ask the next one when it is time."""
        question = self._question
        if question is not None and question.response is not None:
            error = question.end(0.0)
            if error is not None:
                self._question = None
                raise error
        if question is None or time.monotonic() > question.asked_at_s + self._limits.air_period_s:
            if question is not None and not question.is_settled:
                return  # uav_bridge is busy with the run: that is its answer
            self._question = self._roll_call.question(_AIR)
            self._question.ask()

    def _drop_question(self) -> None:
        question, self._question = self._question, None
        if question is not None:
            question.end(0.0)

    @staticmethod
    def _raise_first(absent: dict[str, AuroraError]) -> None:
        for error in absent.values():
            raise error
