# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""JSON Schemas of the documents that programs outside read, as they lie in `config/schema/`.

`python -m aurora_core.report.schema FOLDER` writes them; a test holds the files to the code.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from aurora_core.document import OMITTED
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.feasibility import FeasibilityVerdict
from aurora_core.outcomes.verdict import VERDICT_VERSION, Verdict
from aurora_core.report.check_report import CheckReport
from aurora_core.report.diff_report import DiffReport
from aurora_core.report.run_report import RunReport
from aurora_core.report.verify_report import VerifyReport
from aurora_core.spec.scenario import ScenarioSpec

_DIALECT = 'https://json-schema.org/draft/2020-12/schema'

# File stem -> document and its version.
DOCUMENTS: dict[str, tuple[type[BaseModel], int]] = {
    'report': (RunReport, 1),
    'scenario_spec': (ScenarioSpec, 1),
    'agsg': (Agsg, 1),
    'feasibility': (FeasibilityVerdict, 1),
    'verdict': (Verdict, VERDICT_VERSION),
    'check': (CheckReport, 1),
    'verify': (VerifyReport, 1),
    'diff': (DiffReport, 1),
}


def schema_text(name: str) -> str:
    """Return the text of a schema file.

    Args:
        name: Key of `DOCUMENTS`.
    """
    model, version = DOCUMENTS[name]
    schema = _complete(model.model_json_schema(mode='serialization'))
    whole = {'$schema': _DIALECT, '$id': f'urn:aurora:{name}:{version}', **schema}
    return json.dumps(whole, indent=2, sort_keys=True, ensure_ascii=False) + '\n'


def _complete(schema: Any) -> Any:
    """Ask for every field: a document is written whole, with its defaults, but for those fields
    that are left out when they have theirs.
    """
    if isinstance(schema, list):
        return [_complete(item) for item in schema]
    if not isinstance(schema, dict):
        return schema
    whole = {key: _complete(item) for key, item in schema.items()}
    if isinstance(whole.get('properties'), dict) and whole.get('type') == 'object':
        fields = whole['properties'].items()
        whole['required'] = sorted(name for name, field in fields if not field.get(OMITTED))
    return whole


def write_schemas(folder: Path) -> tuple[Path, ...]:
    """Write all schema files and return their paths."""
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for name in DOCUMENTS:
        path = folder / f'{name}.schema.json'
        path.write_text(schema_text(name), encoding='utf-8')
        written.append(path)
    return tuple(written)


if __name__ == '__main__':
    write_schemas(Path(sys.argv[1]))
