# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The shipped maps, loaded once."""

from __future__ import annotations

import pytest

from aurora_core.knowledge.map_model import MapModel, load_map


@pytest.fixture(scope='session')
def downtown() -> MapModel:
    """The default map."""
    return load_map('downtown')


@pytest.fixture(scope='session')
def junction() -> MapModel:
    """The one-junction map."""
    return load_map('junction')
