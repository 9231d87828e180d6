# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The physics steps compiled, where `make setup` could, and in plain Python everywhere else.

`native/flight.c` does what `multirotor.py` and `control.py` do, bit for bit and twenty times as
fast.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any, TypeVar, cast

from aurora_uav_sim import control, multirotor
from aurora_uav_sim.native_code import twin
from aurora_uav_sim.parameters import ControlParameters

_Class = TypeVar('_Class')


def _on(base: Any, plain: type[_Class], attributes: str, set_up: Callable[..., None]) -> Any:
    """Return the plain class with its numbers and its step in `base`."""
    members: dict[str, Any] = {
        '__slots__': (attributes,) if attributes else (),
        '__init__': set_up,
    }
    if 'reset' in vars(plain):
        members['reset'] = vars(plain)['reset']
    return type(plain.__name__, (base,), members)


def _set_up_controller(
    controller: Any, body: multirotor.Multirotor, parameters: ControlParameters
) -> None:
    control.Controller.__init__(controller, body, parameters)
    for field in dataclasses.fields(parameters):
        if hasattr(controller, field.name):
            setattr(controller, field.name, getattr(parameters, field.name))


def _classes() -> tuple[
    type[multirotor.Multirotor], type[control.Controller], type[control.SetPoint]
]:
    native = twin('aurora_uav_flight')
    if native is None:
        return multirotor.Multirotor, control.Controller, control.SetPoint
    return (
        cast(
            'type[multirotor.Multirotor]',
            _on(
                native.Body,
                multirotor.Multirotor,
                'parameters',
                multirotor.Multirotor.__init__,
            ),
        ),
        cast(
            'type[control.Controller]',
            _on(native.Cascade, control.Controller, '_c', _set_up_controller),
        ),
        cast(
            'type[control.SetPoint]',
            _on(native.Point, control.SetPoint, '', control.SetPoint.__init__),
        ),
    )


def _flown() -> Callable[..., int]:
    native = twin('aurora_uav_flight')
    return control.fly if native is None else native.fly


Multirotor, Controller, SetPoint = _classes()
fly = _flown()
IS_COMPILED = Multirotor is not multirotor.Multirotor
