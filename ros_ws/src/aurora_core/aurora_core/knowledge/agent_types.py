# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Measured sizes and dynamics of the agent types."""

from __future__ import annotations

from collections.abc import Mapping

from pydantic import BaseModel, ConfigDict

from aurora_core.errors import ConfigError
from aurora_core.files import CONFIG_BYTES, read_json
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import Limits, Positive
from aurora_core.spec.vocabulary import AgentType


class AgentTypeRecord(BaseModel):
    """One type; sizes in metres, dynamics in SI, `vclass` in SUMO's words.

    Attributes:
        desired_speed_mps: What it goes where nobody says more; None: what the street allows.
    """

    model_config = ConfigDict(frozen=True, extra='ignore', allow_inf_nan=False)

    name: str
    length_m: Positive
    width_m: Positive
    height_m: Positive
    max_speed_mps: Positive
    accel_mps2: Positive
    decel_mps2: Positive
    vclass: str
    is_person: bool
    desired_speed_mps: Positive | None = None


def top_speed_mps(record: AgentTypeRecord, limits: Limits) -> float:
    """Return the limit on the speed of an agent: the general one, or what its type can reach."""
    walks = record.is_person
    top = limits.pedestrian_speed_max_mps if walks else limits.vehicle_speed_max_mps
    return min(record.max_speed_mps, top)


def load_agent_types() -> Mapping[str, AgentTypeRecord]:
    """Read `knowledge/agent_types.json`, by type name.

    Raises:
        ConfigError: The file is missing, out of its schema, or lacks a type of the vocabulary.
    """
    path = config_path('knowledge', 'agent_types.json')
    try:
        table = read_json(path, CONFIG_BYTES)
        records = [AgentTypeRecord.model_validate(row) for row in table['types']]
    except OSError as err:
        raise ConfigError(f'{path} cannot be read: {err}', hint='run make setup') from err
    except (ValueError, LookupError, TypeError) as err:
        raise ConfigError(
            f'{path} is not valid: expected a list "types" of agent types, found: {err!r}',
            hint='compare with the shipped file',
        ) from err
    by_name = {record.name: record for record in sorted(records, key=lambda r: r.name)}
    lacking = [t.value for t in AgentType if t.value not in by_name]
    if lacking or len(by_name) < len(records):
        wrong = f'types lacks {", ".join(lacking)}' if lacking else 'types repeats a name'
        raise ConfigError(f'{path} is not valid: {wrong}', hint='compare with the shipped file')
    return by_name
