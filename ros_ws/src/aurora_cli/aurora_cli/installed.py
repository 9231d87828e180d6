# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What is installed, loaded once for all that this process does."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.map_folders import own_maps_folder
from aurora_core.pipeline.knowledge import Knowledge, installed_knowledge


def installed() -> Knowledge:
    """Return limits, tolerances, settings and maps of the configuration folder.

    Raises:
        ConfigError: A file is missing or broken.
    """
    return _of(config_path(), own_maps_folder())


def forget() -> None:
    """Load anew what is installed when it is next asked for: it was measured again."""
    _of.cache_clear()


@lru_cache(maxsize=1)
def _of(_config: Path, _own_maps: Path) -> Knowledge:
    return installed_knowledge()
