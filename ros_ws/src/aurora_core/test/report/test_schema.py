# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import jsonschema
import pytest

from aurora_core.agsg.build import build_agsg
from aurora_core.knowledge.config_files import config_path
from aurora_core.report.build import build_report
from aurora_core.report.schema import DOCUMENTS, schema_text, write_schemas
from aurora_core.spec.scenario import ScenarioSpec


def _without_words(value: Any) -> Any:
    """Drop the descriptions: they come from docstrings and bind nobody."""
    if isinstance(value, dict):
        return {
            key: _without_words(item)
            for key, item in value.items()
            if not (key == 'description' and isinstance(item, str))
        }
    return [_without_words(item) for item in value] if isinstance(value, list) else value


@pytest.mark.parametrize('name', sorted(DOCUMENTS))
def test_the_shipped_file_is_what_the_code_writes(name: str) -> None:
    shipped = json.loads(config_path('schema', f'{name}.schema.json').read_text('utf-8'))
    assert _without_words(shipped) == _without_words(json.loads(schema_text(name))), (
        'write it anew: python -m aurora_core.report.schema config/schema'
    )


def test_a_report_fits_its_schema_and_a_wrong_one_does_not(make: SimpleNamespace) -> None:
    schema = json.loads(schema_text('report'))
    document = build_report(make.facts()).model_dump(mode='json')
    jsonschema.validate(document, schema)
    for change in ({'status': 'done'}, {'run_id': None}, {'extra': 1}):
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate({**document, **change}, schema)


def test_the_schema_asks_for_everything_of_the_contract() -> None:
    asked = {
        'schema_version', 'run_id', 'status', 'prompt', 'engine', 'model', 'map', 'seed',
        'versions', 'digests', 'limits', 'clauses', 'conditions', 'feasibility', 'repairs',
        'metrics', 'timing', 'cost', 'trace', 'question', 'error',
    }  # fmt: skip
    assert asked <= set(json.loads(schema_text('report'))['required'])


def test_all_files_are_written(tmp_path: Path) -> None:
    paths = write_schemas(tmp_path / 'new')
    assert [path.name for path in paths] == [f'{name}.schema.json' for name in DOCUMENTS]
    assert json.loads(paths[0].read_text('utf-8'))['$id'] == 'urn:aurora:report:1'


def test_a_specification_fits_its_schema_with_and_without_later_fields() -> None:
    schema = json.loads(schema_text('scenario_spec'))
    plain = ScenarioSpec(prompt='x').model_dump(mode='json')
    later = {**plain, 'prohibitions': [{'id': 'p1', 'forbids': 'world', 'weather': 'rain'}]}
    for document in (plain, ScenarioSpec.model_validate(later).model_dump(mode='json')):
        jsonschema.validate(document, schema)
    changes: tuple[dict[str, Any], ...] = ({'schema_version': 2}, {'orders': [{}]}, {'world': {}})
    for change in changes:
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate({**plain, **change}, schema)


def test_a_graph_fits_its_schema() -> None:
    schema = json.loads(schema_text('agsg'))
    document = build_agsg(ScenarioSpec(prompt='x')).model_dump(mode='json')
    jsonschema.validate(document, schema)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate({**document, 'nodes': [{'id': 'a', 'type': 'tree'}]}, schema)
