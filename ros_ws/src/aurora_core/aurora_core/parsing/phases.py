# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Verbs of what a UAV does for a while, by their keys in the lexicon."""

from __future__ import annotations

FLOWN = frozenset({'hover', 'track', 'follow', 'orbit', 'navigate', 'observe', 'fly'})
# `after it has hovered for 20 s` is a phase, not an event.
PHASES = FLOWN | {'wait'}
