# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Settings that several nodes have."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class PreloadSettings:
    """See `config/parser.param.yaml`.

    Attributes:
        preload_map: Map that is read at the start, so that the first request finds it.
    """

    preload_map: str
