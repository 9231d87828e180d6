# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Find the bag that RUN_OR_BAG names."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from aurora_core.errors import BagError
from aurora_core.report.run_documents import read_document
from aurora_core.report.run_folder import MANIFEST, PROMPT, REPORT, StageFile, is_run_id
from aurora_core.report.run_report import RunReport
from aurora_core.trace.bag_metadata import METADATA

# As `RunFolder.bag_path` writes it: no leading zeroes, no digits of other scripts.
_BAG = re.compile(r'bag\.(0|[1-9][0-9]{0,8})')
_DEFAULT_ROOT = Path('runs')
# So many runs are named where another name was given.
_SHOWN = 3
# One of these beside a bag, or the name of the folder, makes it a run folder.
_OF_A_RUN = (MANIFEST, PROMPT, REPORT, *(f'{stage.value}.*.json' for stage in StageFile))


@dataclass(frozen=True, slots=True, kw_only=True)
class FoundBag:
    """A bag and where it belongs.

    Attributes:
        bag: Folder (or file) of the bag.
        run: Run folder, None for a bag that lies alone.
        iteration: Which one, None for a bag that lies alone, or that lies in a run folder under a
            name that no bag of a run has.
    """

    bag: Path
    run: Path | None
    iteration: int | None


def find_bag(text: str, iteration: int | None) -> FoundBag:
    """Return the bag of a run folder, run id, bag folder or MCAP file.

    Args:
        text: RUN_OR_BAG.
        iteration: `--iteration`; when None the one that the report is about, else the last one.

    Raises:
        BagError: There is no such thing.
    """
    path = Path(text)
    if not path.exists() and (_DEFAULT_ROOT / text).is_dir():
        path = _DEFAULT_ROOT / text
    if not path.exists():
        raise BagError(f'{text} is neither a run folder, nor a run in runs/, nor a bag{_others()}')
    if path.is_file() and path.name == METADATA:
        path = path.parent
    is_named = not path.is_dir()
    folder = path.parent if is_named else path
    place = _place(folder)
    match = _BAG.fullmatch(place.name)
    # What is named is the bag, whatever it is or holds: its reader says what is wrong with it.
    if is_named or any(path.glob('*.mcap')):
        if iteration is not None and (match is None or int(match[1]) != iteration):
            raise BagError(f'--iteration {iteration} does not fit the bag {path}')
        run = place.parent if _is_run(place.parent) else None
        number = int(match[1]) if match is not None and run is not None else None
        return FoundBag(bag=path, run=run, iteration=number)
    return _in_run(path, iteration)


def _others() -> str:
    """Return which runs there are, in words: the last few of `runs/`."""
    found = sorted(p.name for p in _DEFAULT_ROOT.glob('*') if is_run_id(p.name))
    if not found:
        return '; there is no run in runs/ here'
    return f'; the last in runs/: {", ".join(reversed(found[-_SHOWN:]))}'


def _place(folder: Path) -> Path:
    """Return where a folder lies, under the name that it was called by unless that has none."""
    return folder.resolve() if '..' in folder.parts else folder.absolute()


def _is_run(folder: Path) -> bool:
    """Tell whether a folder is that of a run: what is left of one still is."""
    return is_run_id(folder.name) or any(True for name in _OF_A_RUN for _ in folder.glob(name))


def _in_run(path: Path, iteration: int | None) -> FoundBag:
    numbers = sorted(
        int(match[1])
        for child in path.glob('bag.*')
        if (match := _BAG.fullmatch(child.name)) is not None
    )
    if not numbers:
        raise BagError(f'{path} holds no bag: nothing was executed')
    wanted = _judged(path, numbers) if iteration is None else iteration
    if wanted not in numbers:
        shown = ', '.join(str(number) for number in numbers)
        raise BagError(f'{path} has no iteration {wanted}; it has {shown}')
    return FoundBag(bag=path / f'bag.{wanted}', run=_place(path), iteration=wanted)


def _judged(path: Path, numbers: Sequence[int]) -> int:
    """Return the iteration that the report of a run is about, the last one when it tells none."""
    report = read_document(path / REPORT, RunReport)
    if not isinstance(report, RunReport) or report.trace is None or report.bags is None:
        return numbers[-1]
    listed = {entry.bag: entry.iteration for entry in report.bags}
    # A bag that the report does not list is not passed over: it is held against the run.
    if {f'bag.{number}' for number in numbers} - listed.keys():
        return numbers[-1]
    told = listed.get(report.trace.bag, numbers[-1])
    return told if told in numbers else numbers[-1]
