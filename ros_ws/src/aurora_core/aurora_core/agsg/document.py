# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The graph as one JSON document, as run folders hold it."""

from __future__ import annotations

import json

from aurora_core.errors import VerificationError
from aurora_core.judging.codec import conditions_from_json
from aurora_core.outcomes.agsg import Agsg


def agsg_from_json(data: bytes | str) -> Agsg:
    """Read a graph that was written with `model_dump`.

    Raises:
        ValueError: It is none.
    """
    document = json.loads(data)
    if not isinstance(document, dict):
        raise ValueError('a graph is an object')
    # Each condition has the argument type of its quantity, which the document alone does not tell.
    rows = document.pop('conditions', [])
    agsg = Agsg.model_validate_json(json.dumps(document))
    try:
        conditions = conditions_from_json(json.dumps(rows))
    except VerificationError as err:
        raise ValueError(str(err)) from err
    return Agsg.model_validate({**dict(agsg), 'conditions': conditions})
