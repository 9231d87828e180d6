# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora verify` in this process, and what it says about a damaged bag."""

from __future__ import annotations

import contextlib
import io
import json
import re
import time
from dataclasses import dataclass
from pathlib import Path

from aurora_cli.main import run_command_line

# A place in the file, a stream of the run, or the file that should be beside it.
_PLACE = re.compile(r'\(byte \d+\)|/aurora/[a-z/]+|metadata\.yaml|header or index|\d s and \d')
_DEFECT = 'this is a defect of AURORA'


@dataclass(frozen=True, slots=True, kw_only=True)
class Judgement:
    """What the command did.

    Attributes:
        code: Exit code.
        status: Of the verdict; `error` when nothing could be judged.
        integrity: Of the bag, '' when nothing could be judged.
        text: What is said about the damage.
        seconds: Of this thread's processor time.
    """

    code: int
    status: str
    integrity: str
    text: str
    seconds: float

    @property
    def crashed(self) -> bool:
        """Whether the command ended by an error that nobody expected."""
        return _DEFECT in self.text

    @property
    def refused(self) -> bool:
        """Whether it neither passed nor failed but said that this cannot be judged."""
        return self.code == 4 and not self.crashed and self.integrity != 'intact'

    @property
    def named(self) -> bool:
        """Whether it says where the damage is."""
        return _PLACE.search(self.text) is not None


def judge(path: Path) -> Judgement:
    """Verify a bag."""
    out, err = io.StringIO(), io.StringIO()
    begun = time.thread_time()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = run_command_line(['verify', str(path), '--json'])
    seconds = time.thread_time() - begun
    # Results hold no paths of the machine.
    said = err.getvalue().replace(f'{path.parent}/', '')
    try:
        document = json.loads(out.getvalue())
    except ValueError:
        return Judgement(code=code, status='error', integrity='', text=said, seconds=seconds)
    if 'verdict' not in document:
        text = str(document['error']['message']).replace(f'{path.parent}/', '')
        return Judgement(code=code, status='error', integrity='', text=text, seconds=seconds)
    verdict = document['verdict']
    return Judgement(
        code=code,
        status=verdict['status'],
        integrity=verdict['integrity'],
        text='; '.join(verdict['notes']),
        seconds=seconds,
    )
