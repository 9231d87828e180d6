# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a program may ask of its scene, as closed values: the other side of `inside/aurora_scene`.

A program is foreign: whatever is not exactly one of these is answered with what is wrong.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import Field, FiniteFloat, TypeAdapter, ValidationError

from aurora_core.document import Document
from aurora_core.errors import AuroraError
from aurora_core.spec.vocabulary import Role, TimeOfDay, Weather

Name = Annotated[str, Field(pattern=r'^[A-Za-z][A-Za-z0-9_]{0,39}$')]
EdgeId = Annotated[str, Field(min_length=1, max_length=200)]
Edges = Annotated[tuple[EdgeId, ...], Field(min_length=1, max_length=500)]
Metres = Annotated[FiniteFloat, Field(ge=-1e5, le=1e5)]
Share = Annotated[FiniteFloat, Field(ge=0.0, le=1.0)]
Positive = Annotated[FiniteFloat, Field(ge=0.0, le=1e5)]


class SceneRefusal(AuroraError):  # noqa: N818  (an answer, not a fault of ours)
    """A request that the scene cannot carry out; its text goes to the program."""

    default_component = 'sandbox'


class Lanes(Document):
    """Traffic lanes near a point."""

    do: Literal['lanes']
    near: tuple[Metres, Metres] | None = None
    within_m: Positive = 300.0


class NextEdges(Document):
    """Edges from the end of one."""

    do: Literal['next_edges']
    edge: EdgeId


class Route(Document):
    """The shortest way."""

    do: Literal['route']
    from_edge: EdgeId
    to_edge: EdgeId


class Places(Document):
    """Landmarks."""

    do: Literal['places']


class Refuse(Document):
    """The request cannot be carried out."""

    do: Literal['refuse']
    because: Annotated[str, Field(pattern=r'^[a-z_]{1,40}$')]


class World(Document):
    """Weather, light and wind."""

    do: Literal['world']
    weather: Weather = Weather.CLEAR
    time_of_day: TimeOfDay = TimeOfDay.NOON
    wind_mps: Annotated[FiniteFloat, Field(ge=0.0, le=15.0)] = 0.0
    wind_from_deg: Annotated[FiniteFloat, Field(ge=0.0, le=360.0)] = 0.0


class Spawn(Document):
    """A body on the ground."""

    do: Literal['spawn']
    name: Name
    type: str
    lane: EdgeId
    position_m: Positive
    route: Edges | None = None
    speed_mps: Annotated[FiniteFloat, Field(ge=0.0, le=60.0)] = 0.0
    role: Role = Role.OTHER
    parked: bool = False


class SpawnUav(Document):
    """A multirotor on the ground."""

    do: Literal['spawn_uav']
    name: Name
    x_m: Metres
    y_m: Metres
    yaw_rad: Annotated[FiniteFloat, Field(ge=-7.0, le=7.0)] = 0.0


class Link(Document):
    """A radio link."""

    do: Literal['link']
    sender: Name
    receiver: Name
    loss: Share = 0.0
    latency_s: Annotated[FiniteFloat, Field(ge=0.0, le=60.0)] = 0.1
    range_m: Positive | None = None
    retransmissions: Annotated[int, Field(ge=0, le=100)] = 0


class Begin(Document):
    """The simulators start."""

    do: Literal['begin']


class Step(Document):
    """Ticks pass."""

    do: Literal['step']
    ticks: Annotated[int, Field(ge=1, le=100_000)] = 1


class OfBody(Document):
    """About one body."""

    name: Name


class State(OfBody):
    """Where it is."""

    do: Literal['state']


class SetSpeed(OfBody):
    """A speed to hold."""

    do: Literal['set_speed']
    value: FiniteFloat


class FreeSpeed(OfBody):
    """With the traffic again."""

    do: Literal['free_speed']


class SetTimeGap(OfBody):
    """A time gap to keep."""

    do: Literal['set_time_gap']
    value: FiniteFloat


class SetRoute(OfBody):
    """Other edges."""

    do: Literal['set_route']
    edges: Edges


class ChangeLane(OfBody):
    """Another lane."""

    do: Literal['change_lane']
    value: Annotated[int, Field(ge=0, le=63)]
    for_s: Positive = 5.0


class StopAt(OfBody):
    """A place to stop at."""

    do: Literal['stop_at']
    lane: EdgeId
    position_m: Positive
    for_s: Positive = 1000.0


class Resume(OfBody):
    """On from a stop."""

    do: Literal['resume']


class TakeOff(OfBody):
    """A climb."""

    do: Literal['take_off']
    altitude_m: Annotated[FiniteFloat, Field(gt=0.0, le=1000.0)]


class FlyTo(OfBody):
    """A point to hold."""

    do: Literal['fly_to']
    x_m: Metres
    y_m: Metres
    z_m: Metres
    velocity_mps: tuple[Metres, Metres, Metres] = (0.0, 0.0, 0.0)
    yaw_rad: Annotated[FiniteFloat, Field(ge=-7.0, le=7.0)] = 0.0


class Land(OfBody):
    """A landing."""

    do: Literal['land']


class Phase(OfBody):
    """What a flight is for."""

    do: Literal['phase']
    mission: Annotated[int, Field(ge=0, le=90)] | None = None


class Send(Document):
    """A message."""

    do: Literal['send']
    sender: Name
    receiver: Name


class Delivered(Document):
    """How many messages arrived."""

    do: Literal['delivered']
    sender: Name
    receiver: Name


class Log(Document):
    """A line for people."""

    do: Literal['log']
    text: Annotated[str, Field(max_length=2000)]


Request = Annotated[
    Lanes | NextEdges | Route | Places | Refuse | World | Spawn | SpawnUav | Link | Begin | Step
    | State | SetSpeed | FreeSpeed | SetTimeGap | SetRoute | ChangeLane | StopAt | Resume
    | TakeOff | FlyTo | Land | Phase | Send | Delivered | Log,
    Field(discriminator='do'),
]  # fmt: skip
_REQUEST: TypeAdapter[Request] = TypeAdapter(Request)


def read_request(values: Mapping[str, Any]) -> Request:
    """Return what a program asks.

    Raises:
        SceneRefusal: It is no request, or says something that none can say.
    """
    try:
        return _REQUEST.validate_python(dict(values))
    except ValidationError as err:
        told = '; '.join(
            f'{".".join(str(p) for p in e["loc"][1:]) or "do"}: {e["msg"]}'
            for e in err.errors(include_url=False, include_input=False)[:3]
        )
        raise SceneRefusal(told) from err
