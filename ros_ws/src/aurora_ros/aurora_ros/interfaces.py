# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Names, types, QoS and writers of every topic, service and action (`docs/interfaces.md`).

Names are relative: every node lives in the namespace `aurora` unless it is remapped.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from rclpy.qos import QoSProfile
from rosgraph_msgs.msg import Clock

from aurora_msgs import action, msg, srv
from aurora_ros import qos

NAMESPACE = 'aurora'


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Topic:
    """A topic: relative name, message class, profile, and the nodes that may write on it."""

    name: str
    type: Any
    qos: QoSProfile
    writers: tuple[str, ...]

    @property
    def full_name(self) -> str:
        """Name as it stands in a bag."""
        return self.name if self.name.startswith('/') else f'/{NAMESPACE}/{self.name}'

    @property
    def type_name(self) -> str:
        """Type as it stands in a bag, such as `aurora_msgs/msg/Tick`."""
        package, kind = self.type.__module__.split('.')[:2]
        return f'{package}/{kind}/{self.type.__name__}'


@dataclass(frozen=True, slots=True, kw_only=True)
class Call:
    """A service or an action: relative name, interface class, node that serves it."""

    name: str
    type: Any
    server: str

    @property
    def is_action(self) -> bool:
        """Whether it is an action."""
        return hasattr(self.type, 'Goal')

    @property
    def services(self) -> tuple[str, ...]:
        """Relative names of what is called behind it: an action is three services."""
        if not self.is_action:
            return (self.name,)
        parts = ('send_goal', 'get_result', 'cancel_goal')
        return tuple(f'{self.name}/_action/{part}' for part in parts)


# Every node of the graph that is named in it, and the one that publishes a recording instead.
NODES = (
    'sync',
    'sumo_bridge',
    'uav_bridge',
    'recorder',
    'executor',
    'parser',
    'grounding',
    'monitor',
    'repair',
    'orchestrator',
    'replay',
)
_FAILING = ('sumo_bridge', 'uav_bridge', 'recorder', 'executor')

CLOCK = Topic(name='/clock', type=Clock, qos=qos.CLOCK, writers=('sync',))
TICK = Topic(name='tick', type=msg.Tick, qos=qos.STREAM, writers=('sync',))
TICK_DONE = Topic(name='tick_done', type=msg.TickDone, qos=qos.STREAM, writers=('executor',))
ACK = Topic(name='ack', type=msg.Ack, qos=qos.STREAM, writers=('recorder', 'monitor'))
FAULT = Topic(name='fault', type=msg.Fault, qos=qos.STREAM, writers=_FAILING)
SYNC_STATUS = Topic(name='sync/status', type=msg.SyncStatus, qos=qos.LATCHED, writers=('sync',))
HEARTBEAT = Topic(name='heartbeat', type=msg.Heartbeat, qos=qos.HEARTBEAT, writers=NODES)
AGSG = Topic(
    name='agsg', type=msg.Agsg, qos=qos.LATCHED, writers=('executor', 'parser', 'grounding')
)
ROSTER = Topic(name='roster', type=msg.Roster, qos=qos.LATCHED, writers=('executor',))
WORLD = Topic(name='world', type=msg.World, qos=qos.LATCHED, writers=('executor',))
RUN_END = Topic(name='run_end', type=msg.RunEnd, qos=qos.LATCHED, writers=('executor',))
GROUND_STATE = Topic(
    name='ground/state', type=msg.GroundState, qos=qos.STREAM, writers=('sumo_bridge',)
)
UAV_STATE = Topic(name='uav/state', type=msg.UavState, qos=qos.STREAM, writers=('uav_bridge',))
GROUND_COMMAND = Topic(
    name='ground/command', type=msg.GroundCommand, qos=qos.STREAM, writers=('executor',)
)
UAV_COMMAND = Topic(name='uav/command', type=msg.UavCommand, qos=qos.STREAM, writers=('executor',))
COMM = Topic(name='comm', type=msg.LinkEvent, qos=qos.STREAM, writers=('executor',))
SENSING = Topic(name='sensing', type=msg.Visibility, qos=qos.STREAM, writers=('executor',))
EVENTS = Topic(name='events', type=msg.ScenarioEvent, qos=qos.STREAM, writers=('executor',))
MARGINS = Topic(name='margins', type=msg.Margins, qos=qos.LATCHED, writers=('monitor',))
VERDICT = Topic(name='verdict', type=msg.Verdict, qos=qos.LATCHED, writers=('monitor',))

# Nobody else may write on these while a run goes on.
RUN_TOPICS = (
    CLOCK,
    TICK,
    TICK_DONE,
    ACK,
    FAULT,
    SYNC_STATUS,
    HEARTBEAT,
    AGSG,
    ROSTER,
    WORLD,
    RUN_END,
    GROUND_STATE,
    UAV_STATE,
    GROUND_COMMAND,
    UAV_COMMAND,
    COMM,
    SENSING,
    EVENTS,
    MARGINS,
    VERDICT,
)

# What a run is judged on: every one is in its bag, and heard by the live monitor.
JUDGED = (
    AGSG,
    ROSTER,
    WORLD,
    GROUND_STATE,
    UAV_STATE,
    GROUND_COMMAND,
    UAV_COMMAND,
    COMM,
    SENSING,
    EVENTS,
)
# What the recorder hears.
RECORDED = (*JUDGED, CLOCK, VERDICT)

RUN_PROMPT = Call(name='run_prompt', type=srv.RunPrompt, server='orchestrator')
GET_RUN = Call(name='get_run', type=srv.GetRun, server='orchestrator')
LIST_RUNS = Call(name='list_runs', type=srv.ListRuns, server='orchestrator')
RUN = Call(name='run', type=action.RunScenario, server='orchestrator')
PARSE = Call(name='parse', type=srv.ParsePrompt, server='parser')
GROUND_SCENARIO = Call(name='ground_scenario', type=srv.GroundScenario, server='grounding')
CHECK = Call(name='check', type=srv.Check, server='grounding')
EXECUTE = Call(name='execute', type=action.ExecuteScenario, server='executor')
VERIFY = Call(name='verify', type=srv.VerifyTrace, server='monitor')
REPAIR = Call(name='repair', type=srv.ProposeRepair, server='repair')
GROUND_LOAD = Call(name='ground/load', type=srv.LoadGround, server='sumo_bridge')
UAV_LOAD = Call(name='uav/load', type=srv.LoadUav, server='uav_bridge')
GROUND_DIGEST = Call(name='ground/digest', type=srv.RunDigest, server='sumo_bridge')
UAV_DIGEST = Call(name='uav/digest', type=srv.RunDigest, server='uav_bridge')
SYNC_LOAD = Call(name='sync/load', type=srv.LoadSync, server='sync')
SYNC_START = Call(name='sync/start', type=srv.StartSync, server='sync')
SYNC_STOP = Call(name='sync/stop', type=srv.StopSync, server='sync')
RECORDER_START = Call(name='recorder/start', type=srv.StartRecording, server='recorder')
RECORDER_STOP = Call(name='recorder/stop', type=srv.StopRecording, server='recorder')


def roll_call(node: str) -> Call:
    """Return the service by which a node says that it is present."""
    return Call(name=f'{node}/roll_call', type=srv.RollCall, server=node)
