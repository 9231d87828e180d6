# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The paper's own numbers, quoted beside ours."""

from __future__ import annotations

from collections.abc import Mapping

DIFFERS = (
    'The simulators differ: the paper ran CARLA 0.9.15 and AirSim 1.8.1 with five language models '
    'that sample, we run SUMO and our own multirotors on another map. Its numbers stand beside '
    'ours; their difference says nothing about either.'
)

# Configuration -> (C, RF, P, SF, Fid) by model; None: not given. Source: the paper's table of
# end-to-end performance, 50 prompts, one seed.
Row = tuple[float, float, float | None, float | None, float | None]
MODELS = ('GPT-4o', 'GPT-5.5', 'GPT-5.4-mini', 'Gemini 3.1 Pro', 'Gemini 3.8 Flash')
TABLE: Mapping[str, tuple[Row, ...]] = {
    'B1': tuple((c, rf, None, None, None) for c, rf in (
        (0.42, 0.58), (0.82, 0.18), (0.70, 0.30), (0.80, 0.20), (0.72, 0.28),
    )),
    'B2': tuple((c, rf, None, None, None) for c, rf in (
        (0.68, 0.32), (0.92, 0.08), (0.86, 0.14), (0.94, 0.06), (0.92, 0.08),
    )),
    'B3': tuple((c, rf, None, None, None) for c, rf in (
        (0.66, 0.34), (0.92, 0.08), (0.78, 0.22), (0.98, 0.02), (0.98, 0.02),
    )),
    'B4': (
        (1.00, 0.0, 0.58, 0.42, 0.966), (1.00, 0.0, 0.42, 0.58, 1.000),
        (1.00, 0.0, 0.50, 0.50, 1.000), (1.00, 0.0, 0.66, 0.34, 0.993),
        (1.00, 0.0, 0.62, 0.38, 0.984),
    ),
    'B5': (
        (0.98, 0.0, 0.56, 0.42, 0.980), (1.00, 0.0, 0.48, 0.52, 1.000),
        (1.00, 0.0, 0.60, 0.40, 0.995), (0.98, 0.0, 0.70, 0.28, 0.995),
        (1.00, 0.0, 0.54, 0.46, 0.971),
    ),
    'AURORA': (
        (0.98, 0.0, 0.76, 0.22, 0.980), (1.00, 0.0, 0.64, 0.36, 1.000),
        (1.00, 0.0, 0.70, 0.30, 0.995), (0.98, 0.0, 0.84, 0.14, 0.995),
        (1.00, 0.0, 0.74, 0.26, 0.971),
    ),
}  # fmt: skip
# Median repair episode by model, seconds of their machine: from 194 to 249.
REPAIR_EPISODE_S = (194.0, 249.0)
