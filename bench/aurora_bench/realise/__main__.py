# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora bench realise FILE…`: run what the annotations say, with nothing of a parser in it."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from aurora_bench.rulers.command import Ruler, measure
from aurora_bench.rulers.runs import RealiseWork

REALISE = Ruler(
    name='realise',
    about='Annotated requests that are realised when nothing is misread',
    word='realised',
    of=' feasible',
    takes=lambda prompt: prompt.feasibility != 'infeasible',
    work=lambda options, folder: RealiseWork(
        folder=folder,
        keep=options.keep is not None,
        map_name=options.map,
        repair=options.repair,
    ),
)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command and return its exit code."""
    return measure(REALISE, arguments)


if __name__ == '__main__':
    sys.exit(main())
