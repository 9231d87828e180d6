# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`config/repair.yaml`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated

import yaml
from pydantic import Field, NonNegativeFloat, NonNegativeInt, PositiveFloat, PositiveInt

from aurora_core.document import Document, first_problem
from aurora_core.errors import ConfigError
from aurora_core.files import CONFIG_BYTES, read_text
from aurora_core.knowledge.config_files import config_path
from aurora_core.outcomes.repair import Step
from aurora_core.spec.parameter import Provenance

# The paper bounds a numerical repair so.
_MOST_PARAMETERS = 5


Share = Annotated[float, Field(gt=0.0, le=1.0)]


class ProvenanceWeights(Document):
    """w(c) of equation 5."""

    explicit: PositiveFloat
    inferred: PositiveFloat
    default: PositiveFloat

    def of(self, provenance: Provenance) -> float:
        """Return the weight of a class."""
        return float(getattr(self, provenance.value))


class SurrogateSettings(Document):
    """The kinematic replay.

    Attributes:
        candidates: That are looked at before a co-simulation; 0: it is not asked.
        step_s: Between two samples of the record.
        apart: Share of a domain by which two edits differ at least.
        unknown: Error (normalised) of estimates of a kind that was never measured.
        errors: By quantity: how far such estimates have been too good (normalised).
    """

    candidates: NonNegativeInt
    step_s: PositiveFloat
    apart: Share
    unknown: NonNegativeFloat
    errors: Mapping[str, NonNegativeFloat] = {}


class RepairSettings(Document):
    """See `config/repair.yaml`."""

    escalation: tuple[Step, ...]
    budget: NonNegativeInt
    unasked: NonNegativeInt
    groundings: PositiveInt
    placements: NonNegativeInt
    jobs: PositiveInt
    limit_s: PositiveFloat
    most_parameters: PositiveInt = Field(le=_MOST_PARAMETERS)
    singles: PositiveInt
    in_vain: PositiveInt
    steps: Annotated[tuple[Share, ...], Field(min_length=1)]
    epsilon: PositiveFloat
    lambda_sem: NonNegativeFloat
    weights: ProvenanceWeights
    surrogate: SurrogateSettings


def load_repair_settings() -> RepairSettings:
    """Read `repair.yaml` of the configuration.

    Raises:
        ConfigError: The file is missing or out of its schema.
    """
    path = config_path('repair.yaml')
    try:
        return RepairSettings.model_validate(yaml.safe_load(read_text(path, CONFIG_BYTES)))
    except OSError as err:
        raise ConfigError(f'{path} cannot be read: {err}', hint='run make setup') from err
    except (ValueError, yaml.YAMLError) as err:
        raise ConfigError(
            f'{path} is not valid: {first_problem(err)}', hint='compare with the shipped file'
        ) from err
