# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The vocabulary is what prompt files and reports are written in: a change breaks them."""

from __future__ import annotations

from enum import StrEnum

import pytest

from aurora_core.spec import vocabulary
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.requirements import STATED_QUANTITIES

_WORDS = {
    'AgentType': 'car truck bus van motorcycle bicycle pedestrian police ambulance firetruck rsu',
    'Weather': 'clear cloudy rain heavy_rain fog snow',
    'TimeOfDay': 'dawn noon dusk night',
    'TrafficDensity': 'low medium high',
    'Place': 'intersection crosswalk sidewalk roadside main_road',
    'Relation': 'ahead behind left right adjacent_lane same_lane oncoming beside at on near '
    'before parked_at',
    'BehaviorKind': 'drive circulate follow tailgate overtake approach stop brake slow yield '
    'cross walk wait park change_lane turn_left turn_right emergency_run',
    'MissionMode': 'hover track navigate',
    'Pattern': 'rectangle line lawnmower orbit waypoints',
    'LinkOcclusion': 'shortens blocks ignored',
    'ClauseStatus': 'encoded no_requirement not_encoded not_judged',
}
_QUANTITIES = (
    'distance horizontal_distance separation altitude speed vertical_speed deceleration '
    'time_headway time_to_collision tracked_fraction visible_time visible_fraction '
    'delivery_latency delivered delivery_ratio event_time hover_drift waypoints_visited '
    'mission_completed landed clearance battery'
)


@pytest.mark.parametrize('name', sorted(_WORDS))
def test_words_of_the_prompt_files(name: str) -> None:
    enum: type[StrEnum] = getattr(vocabulary, name)
    assert [word.value for word in enum] == _WORDS[name].split()


def test_quantities_that_a_prompt_can_name() -> None:
    assert list(STATED_QUANTITIES) == _QUANTITIES.split()
    assert set(STATED_QUANTITIES) <= {q.value for q in QuantityName}
