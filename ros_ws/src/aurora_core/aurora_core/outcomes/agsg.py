# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`Agsg`: G = (V, E_G, tau_V, tau_E, Theta, omega), the value that travels between the stages.

Source: paper, eq. (1). The JSON documents are the truth; nodes, edges and parameters are derived
from them (`agsg.build`) and a graph whose derived part does not match is refused.
"""

from __future__ import annotations

import hashlib
from enum import StrEnum

from aurora_core.document import Document
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


class Agsg(Document):
    """The scenario graph at one stage of one repair iteration.

    Attributes:
        spec: The request.
        grounding_json: `GroundedScenario`, '' until grounded.
        schedule_json: `Schedule`, '' until planned.
        conditions_json: Success conditions, '[]' until grounded.
    """

    iteration: int = 0
    stage: Stage = Stage.PARSED
    map_name: str
    map_digest: str = ''
    spec: ScenarioSpec
    grounding_json: str = ''
    schedule_json: str = ''
    conditions_json: str = '[]'
    nodes: tuple[AgsgNode, ...] = ()
    edges: tuple[AgsgEdge, ...] = ()
    parameters: tuple[AgsgParameter, ...] = ()

    @property
    def sha256(self) -> str:
        """Digest (hex) over the documents, each with its length in front."""
        digest = hashlib.sha256()
        for text in (
            self.spec.canonical_json(),
            self.grounding_json,
            self.schedule_json,
            self.conditions_json,
        ):
            data = text.encode('utf-8')
            digest.update(len(data).to_bytes(8, 'little'))
            digest.update(data)
        return digest.hexdigest()
