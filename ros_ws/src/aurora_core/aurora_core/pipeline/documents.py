# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The documents that a realisation is executed from, as files of a run folder."""

from __future__ import annotations

from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.feasibility import FeasibilityVerdict
from aurora_core.report.run_folder import RunFolder, StageFile


def write_grounded(folder: RunFolder, grounded: Agsg) -> None:
    """Write graph, grounding and schedule of a grounded scenario."""
    folder.write_stage(StageFile.AGSG, grounded.iteration, grounded)
    folder.write_stage(StageFile.GROUNDING, grounded.iteration, grounded.texts.grounding)
    folder.write_stage(StageFile.SCHEDULE, grounded.iteration, grounded.texts.schedule)


def write_again(folder: RunFolder, grounded: Agsg, feasibility: FeasibilityVerdict | None) -> None:
    """Write these of a later realisation, with the request as it was and is."""
    folder.write_stage(StageFile.SPEC, grounded.iteration, grounded.spec)
    if feasibility is not None:
        folder.write_stage(StageFile.FEASIBILITY, grounded.iteration, feasibility)
    write_grounded(folder, grounded)
