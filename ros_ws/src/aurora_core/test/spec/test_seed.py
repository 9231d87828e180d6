# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A seed that a simulator refuses is refused before anything starts."""

from __future__ import annotations

from typing import Any

import pytest
from pydantic import ValidationError

from aurora_core.pipeline.stages import RunRequest
from aurora_core.spec.scenario import World
from aurora_core.spec.seed import SEED_MAX, check_seed, typed_seed

NO_SEEDS = (-1, SEED_MAX + 1, 10**400, 1.0, 1.5, True, '7', float('nan'))


@pytest.mark.parametrize('value', [0, 1, SEED_MAX])
def test_a_seed_is_taken_everywhere(value: int) -> None:
    assert RunRequest(prompt='', seed=value).seed == value
    assert World(seed=value).seed == value
    assert check_seed(value) == value
    assert typed_seed(str(value)) == value


@pytest.mark.parametrize('value', NO_SEEDS, ids=lambda value: str(type(value)))
def test_what_is_no_seed_is_refused_with_the_range(value: Any) -> None:
    for document in (World, lambda seed: RunRequest(prompt='', seed=seed)):
        with pytest.raises(ValidationError, match=f'from 0 to {SEED_MAX}'):
            document(seed=value)
    with pytest.raises(ValueError, match=f'from 0 to {SEED_MAX}'):
        check_seed(value)


@pytest.mark.parametrize('text', ['', '-1', '1.0', '0x10', '2147483648', '9' * 5000, '\u0663'])
def test_what_is_typed_and_no_seed_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match=f'from 0 to {SEED_MAX}'):
        typed_seed(text)
