# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Sizes and dynamics of the agent types, as they were measured in the ground simulator."""

from __future__ import annotations

from collections.abc import Mapping

from pydantic import BaseModel, ConfigDict

from aurora_core.errors import ConfigError
from aurora_core.files import CONFIG_BYTES, read_json
from aurora_core.knowledge.config_files import config_root
from aurora_core.knowledge.limits import Limits, NotNegative, Positive
from aurora_core.knowledge.measured_on import check_made_of, ground_basis, measure_command
from aurora_core.knowledge.settings import load_settings
from aurora_core.spec.vocabulary import AgentType

RECORDS = ('knowledge', 'measured', 'agent_types.json')


class AgentTypeRecord(BaseModel):
    """One type; sizes in metres, dynamics in SI, `vclass` in SUMO's words.

    Attributes:
        max_speed_mps: As driven on a free road without a limit.
        accel_mps2: As driven from rest (persons: change their speed within a step).
        decel_mps2: As driven to rest, in service.
        emergency_decel_mps2: What the simulator allows in an emergency.
        headway_s: Time gap to the one in front.
        min_gap_m: Gap at standstill.
        desired_speed_mps: What it goes where nobody says more; None: what the street allows.
    """

    model_config = ConfigDict(frozen=True, extra='forbid', allow_inf_nan=False)

    name: str
    length_m: Positive
    width_m: Positive
    height_m: Positive
    max_speed_mps: Positive
    accel_mps2: Positive
    decel_mps2: Positive
    vclass: str
    is_person: bool
    emergency_decel_mps2: Positive
    headway_s: NotNegative
    min_gap_m: NotNegative
    desired_speed_mps: Positive | None = None


def top_speed_mps(record: AgentTypeRecord, limits: Limits) -> float:
    """Return the limit on the speed of an agent: the general one, or what its type can reach."""
    walks = record.is_person
    top = limits.pedestrian_speed_max_mps if walks else limits.vehicle_speed_max_mps
    return min(record.max_speed_mps, top)


def load_agent_types() -> Mapping[str, AgentTypeRecord]:
    """Read the records of the agent types, by type name.

    Raises:
        ConfigError: The file is missing, out of its schema, lacks a type of the vocabulary, or was
            measured of other vehicle types, with another simulator or at another step.
    """
    path = config_root().joinpath(*RECORDS)
    try:
        table = read_json(path, CONFIG_BYTES)
        records = [AgentTypeRecord.model_validate(row) for row in table['types']]
        made = dict(table['made_of'])
    except OSError as err:
        raise ConfigError(
            f'{path} cannot be read: {err}', hint=f'measure: {measure_command()}'
        ) from err
    except (ValueError, LookupError, TypeError) as err:
        raise ConfigError(
            f'{path} is not valid: expected a list "types" of agent types, found: {err!r}',
            hint=f'measure again: {measure_command()}',
        ) from err
    check_made_of(path, made, ground_basis(load_settings().run.dt_s))
    by_name = {record.name: record for record in sorted(records, key=lambda r: r.name)}
    lacking = [t.value for t in AgentType if t.value not in by_name]
    if lacking or len(by_name) < len(records):
        wrong = f'types lacks {", ".join(lacking)}' if lacking else 'types repeats a name'
        raise ConfigError(
            f'{path} is not valid: {wrong}',
            hint='compare with the shipped file config/maps/vtypes.add.xml',
        )
    return by_name
