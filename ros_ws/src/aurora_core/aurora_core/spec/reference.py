# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How elements of the specification refer to each other: by id, to places by their word.

Ids (`ego`, `van1`, `uav1`, `e1`) match `[a-z][a-z0-9_]{0,31}`; landmarks are `landmark:<name>`.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import StringConstraints

from aurora_core.spec.vocabulary import Place

Id = Annotated[str, StringConstraints(pattern=r'^[a-z][a-z0-9_]{0,31}$')]
PlaceRef = Annotated[
    str,
    StringConstraints(
        pattern=r'^(intersection|crosswalk|sidewalk|roadside|main_road|landmark:.{1,64})$'
    ),
]

# What the world of a scenario is called where elements are called by their ids.
ENVIRONMENT_ID = 'world'

# What the reference of a landmark begins with; its name on the map follows.
LANDMARK = 'landmark:'
# And where a recorded world says how one gets to it on the road.
APPROACH = 'approach:'

_PLACES = frozenset(place.value for place in Place)


def is_landmark(reference: str | None) -> bool:
    """Tell whether a reference names a landmark of the map."""
    return reference is not None and reference.startswith(LANDMARK)


def is_place(reference: str) -> bool:
    """Tell whether a reference names a place of the map, not an element of the scene."""
    return is_landmark(reference) or reference in _PLACES
