# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Measured sizes and dynamics of the agent types."""

from __future__ import annotations

import json
from collections.abc import Mapping

from pydantic import BaseModel, ConfigDict, ValidationError

from aurora_core.errors import ConfigError
from aurora_core.knowledge.config_files import config_path


class AgentTypeRecord(BaseModel):
    """One type; sizes in metres, dynamics in SI, `vclass` in SUMO's words."""

    model_config = ConfigDict(frozen=True, extra='ignore', allow_inf_nan=False)

    name: str
    length_m: float
    width_m: float
    height_m: float
    max_speed_mps: float
    accel_mps2: float
    decel_mps2: float
    vclass: str
    is_person: bool


def load_agent_types() -> Mapping[str, AgentTypeRecord]:
    """Read `knowledge/agent_types.json`, by type name.

    Raises:
        ConfigError: The file is missing or out of its schema.
    """
    path = config_path('knowledge', 'agent_types.json')
    try:
        table = json.loads(path.read_text(encoding='utf-8'))
        records = [AgentTypeRecord.model_validate(row) for row in table['types']]
    except OSError as err:
        raise ConfigError(f'{path} cannot be read: {err}', hint='run make setup') from err
    except (json.JSONDecodeError, KeyError, ValidationError) as err:
        raise ConfigError(
            f'{path} is not valid: {err}', hint='compare with the shipped file'
        ) from err
    return {record.name: record for record in sorted(records, key=lambda r: r.name)}
