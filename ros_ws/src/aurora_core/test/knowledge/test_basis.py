# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a run was made with travels as it is, and every value that is another is named."""

from __future__ import annotations

import json

import pytest

from aurora_core.errors import ConfigError
from aurora_core.knowledge.basis import Basis, Tables
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import load_limits, load_tolerances
from aurora_core.knowledge.settings import load_settings


@pytest.fixture(scope='module')
def tables() -> Tables:
    return Tables(
        limits=load_limits(config_path('limits.json')),
        tolerances=load_tolerances(config_path('tolerances.json')),
        settings=load_settings(),
    )


def changed(basis: Basis, table: str, **values: object) -> Basis:
    document = basis.model_dump(mode='json')
    document[table].update(values)
    return Basis.model_validate(document)


def test_it_comes_back_as_it_was_to_the_last_bit(tables: Tables) -> None:
    basis = Basis.of('0.1.0', tables)
    again = Basis.model_validate_json(basis.model_dump_json())
    assert again.tables() == tables
    assert again.sha256 == basis.sha256
    assert basis.differences(again) == ()


def test_every_value_that_is_another_is_named_with_both(tables: Tables) -> None:
    here = Basis.of('0.1.0', tables)
    limits = json.loads(tables.limits.model_dump_json())
    other = changed(here, 'limits', clearance_min_m=0.5)
    other = changed(other, 'tolerances', of_tomorrow=1)
    other = other.model_copy(update={'version': '0.0.9'})
    assert other.differences(here) == (
        'version "0.0.9" (here "0.1.0")',
        f'limits.clearance_min_m 0.5 (here {limits["clearance_min_m"]})',
        'tolerances.of_tomorrow 1 (here none)',
    )
    assert other.sha256 != here.sha256
    assert len(here.differences(other)) == 3


def test_entries_that_this_version_does_not_know_cannot_be_read(tables: Tables) -> None:
    other = changed(Basis.of('0.1.0', tables), 'settings', of_tomorrow=1)
    with pytest.raises(ConfigError, match=r'cannot be read by this version: of_tomorrow'):
        other.tables()
