# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`Agsg`: G = (V, E_G, tau_V, tau_E, Theta, omega), the value that travels between the stages.

Source: paper, eq. (1). Request, grounding, schedule and conditions are the truth; nodes, edges and
parameters are derived from them (`agsg.build`). They are JSON text in messages and files alone
(`agsg.message`), where a graph whose derived part does not match is refused.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

from pydantic import Field

from aurora_core.document import Document
from aurora_core.outcomes.condition import Condition, conditions_to_json
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.schedule import Schedule
from aurora_core.outcomes.triggers import as_realised
from aurora_core.spec.parameter import Provenance, Span, Unit
from aurora_core.spec.scenario import ScenarioSpec


class NodeType(StrEnum):
    """tau_V."""

    ENVIRONMENT = 'environment'
    GROUND_AGENT = 'ground_agent'
    UAV = 'uav'
    COMMUNICATION = 'communication'
    EVENT = 'event'
    CONDITION = 'condition'


class EdgeType(StrEnum):
    """tau_E."""

    SPATIAL = 'spatial'
    TEMPORAL = 'temporal'
    PERCEPTUAL = 'perceptual'
    COMMUNICATION = 'communication'
    BEHAVIORAL = 'behavioral'


class Stage(StrEnum):
    """How far the graph has come."""

    PARSED = 'parsed'
    GROUNDED = 'grounded'
    CHECKED = 'checked'
    REPAIRED = 'repaired'


class AgsgNode(Document):
    """An element of V."""

    id: str
    type: NodeType
    label: str


class AgsgEdge(Document):
    """An element of E_G: `target` depends on `source`."""

    source: str
    target: str
    type: EdgeType
    label: str


class AgsgParameter(Document):
    """An element of Theta with its owner omega(theta); units as in the specification."""

    path: str
    owner: str
    requested: float
    realised: float | None = None
    low: float
    high: float
    unit: Unit
    provenance: Provenance
    span: Span | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class AgsgTexts:
    """The documents of a graph as JSON texts: '' where there is none, '[]' for no conditions."""

    spec: str
    grounding: str
    schedule: str
    conditions: str

    @property
    def sha256(self) -> str:
        """Digest (hex) over the texts, each with its length in front."""
        digest = hashlib.sha256()
        for text in (self.spec, self.grounding, self.schedule, self.conditions):
            data = text.encode('utf-8')
            digest.update(len(data).to_bytes(8, 'little'))
            digest.update(data)
        return digest.hexdigest()


class Agsg(Document):
    """The scenario graph at one stage of one repair iteration.

    Attributes:
        spec: The request, completed (`planning.complete`).
        grounding: None until grounded.
        schedule: None until planned.
        conditions: Success conditions, () until grounded.
        recorded_sha256: Digest of the texts that it was read from, where this version would write
            others; '' otherwise.
    """

    iteration: int = 0
    stage: Stage = Stage.PARSED
    map_name: str
    map_digest: str = ''
    spec: ScenarioSpec
    grounding: GroundedScenario | None = None
    schedule: Schedule | None = None
    conditions: tuple[Condition, ...] = ()
    nodes: tuple[AgsgNode, ...] = ()
    edges: tuple[AgsgEdge, ...] = ()
    parameters: tuple[AgsgParameter, ...] = ()
    recorded_sha256: str = Field(default='', exclude=True)

    @cached_property
    def texts(self) -> AgsgTexts:
        """Its documents as they travel."""
        return AgsgTexts(
            spec=self.spec.canonical_json(),
            grounding='' if self.grounding is None else self.grounding.canonical_json(),
            schedule='' if self.schedule is None else self.schedule.canonical_json(),
            conditions=conditions_to_json(self.conditions),
        )

    @property
    def realised_spec(self) -> ScenarioSpec:
        """The request as it is carried out and judged: with the triggers of its grounding."""
        return self.spec if self.grounding is None else as_realised(self.spec, self.grounding)

    @property
    def sha256(self) -> str:
        """Digest (hex) over its documents."""
        return self.recorded_sha256 or self.texts.sha256
