# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Any specification survives JSON to the last bit."""

from __future__ import annotations

import json

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy
from jsonschema import Draft202012Validator

from aurora_core.report.schema import schema_text
from aurora_core.spec.scenario import ScenarioSpec

_SCHEMA = Draft202012Validator(json.loads(schema_text('scenario_spec')))


@settings(
    max_examples=60,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
)
@given(data=st.data())
def test_json_keeps_everything_and_fits_the_schema(
    data: st.DataObject, specifications: SearchStrategy[ScenarioSpec]
) -> None:
    spec = data.draw(specifications)
    text = spec.canonical_json()
    again = ScenarioSpec.model_validate_json(text)
    assert again == spec
    assert again.canonical_json() == text
    _SCHEMA.validate(json.loads(text))
