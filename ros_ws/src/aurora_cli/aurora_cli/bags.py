# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Find the bag that RUN_OR_BAG names; a name without a bag is the user's mistake."""

from __future__ import annotations

from aurora_cli.output import UsageProblem
from aurora_core.errors import BagError
from aurora_core.report import find_bag as core
from aurora_core.report.find_bag import FoundBag


def find_bag(text: str, iteration: int | None) -> FoundBag:
    """Return the bag of a run folder, run id, bag folder or MCAP file.

    Args:
        text: RUN_OR_BAG.
        iteration: `--iteration`; the last one when None.

    Raises:
        UsageProblem: There is no such thing.
    """
    try:
        return core.find_bag(text, iteration)
    except BagError as err:
        raise UsageProblem(err.message) from err
