# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora bag standard`: a second bag of a run, of ROS's own message types."""

from __future__ import annotations

from pathlib import Path

from aurora_cli.bags import find_bag
from aurora_cli.output import print_json, quiet_stdout, say
from aurora_core.pipeline.verification import load_bag
from aurora_core.report.standard_topics import write_standard_bag


def standard_command(bag: str, out: Path | None, iteration: int | None, *, as_json: bool) -> int:
    """Write the bag and return the exit code.

    Raises:
        UsageProblem: There is no such run or bag.
        AuroraError: The bag cannot be read, or the folder exists or cannot be written.
    """
    found = find_bag(bag, iteration)
    folder = out if out is not None else found.bag.with_name(f'{found.bag.name}.standard')
    with quiet_stdout():
        content, _ = load_bag(found.bag)
        counts = write_standard_bag(folder, content.trace, content.world)
    if as_json:
        print_json({'schema_version': 1, 'bag': str(folder), 'topics': counts})
        return 0
    say(f'aurora: wrote {folder}')
    for topic, count in sorted(counts.items()):
        say(f'  {topic}  {count}')
    return 0
