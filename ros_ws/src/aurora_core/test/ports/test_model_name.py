# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Names of models are recorded, so an address in them holds no secret."""

from __future__ import annotations

import pytest
from pydantic import ValidationError

from aurora_core.pipeline.stages import RunRequest
from aurora_core.ports.model_name import check_no_secret, without_secrets

SECRETS = ('hunter2', 'some@body')
HELD = (
    'openai/x@http://me:hunter2@host/v1',
    'openai/x@https://hunter2@host:80/v1',
    'openai/x@HTTP://me:hunter2@host/v1',
    'openai/x@http://host/v1?key=hunter2',
    'openai/x@http://host/v1?api-version=1&key=hunter2&more=1,a b',
    'openai/x@http://host/v1#hunter2',
    'openai/x@http://me:hun,hunter2@host/v1',
    'openai/x@http://me:some@body@host/v1',
    'openai/x@http://me:a hunter2@host/v1',
    'openai/x@http://me:hunter2/more@host/v1',
    'openai/a@http://one/v1,openai/b@http://me:hunter2@two/v1',
    'openai/x@me:hunter2@host/v1',
    'openai/x@hunter2@host',
    'openai/x@ftp://me:hunter2@host/v1',
    'http://me:hunter2@host/v1',
)
FREE = (
    'offline',
    'openai/gpt-4o',
    'openai/gpt-4o,offline',
    'openai/x@http://127.0.0.1:8000/v1',
    'openai/a@http://one/v1,openai/b@https://two:1/v1,offline',
    'vertex_ai/claude@20250101',
    'vertex_ai/claude@20250101,vertex_ai/other@20250202',
    'recorded:/runs/what?ever@a:b@c/transcript.jsonl',
)


@pytest.mark.parametrize('named', HELD)
def test_a_secret_is_neither_shown_nor_recorded(named: str) -> None:
    assert not any(secret in without_secrets(named) for secret in SECRETS)
    for refuse in (check_no_secret, lambda name: RunRequest(prompt='', model=name)):
        with pytest.raises((ValueError, ValidationError)) as refused:
            refuse(named)
        told = f'{refused.value} {refused.value!r}'
        assert not any(secret in told for secret in SECRETS)
        assert 'models.yaml' in told


@pytest.mark.parametrize('named', FREE)
def test_names_without_a_secret_stay_as_they_are(named: str) -> None:
    assert without_secrets(named) == named
    assert RunRequest(prompt='', model=named).model == named
