# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Every command on the pages that are written for newcomers ends as the page says."""

from __future__ import annotations

import re
import shlex
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import pytest

Call = Callable[..., SimpleNamespace]
DOCS = Path(__file__).resolve().parents[4] / 'docs'
# Words beside a command that announce its exit code.
CODES = {'infeasible': 5, 'not understood': 3}


def _lines(page: str) -> list[str]:
    blocks = re.findall(r'```bash\n(.*?)```', (DOCS / page).read_text(encoding='utf-8'), re.DOTALL)
    lines = [line for block in blocks for line in block.splitlines()]
    # Those of the graph, and of who changes the code, have tests of their own.
    return [line for line in lines if line.startswith('aurora ')]


@pytest.mark.parametrize('page', ['prompts.md', 'verdict.md', 'exports.md', 'agsg.md'])
def test_the_commands_end_as_announced(
    page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, call: Call
) -> None:
    monkeypatch.chdir(tmp_path)
    lines = _lines(page)
    assert lines
    for line in lines:
        command, _, comment = line.partition('  #')
        name, *words = shlex.split(command)
        assert name == 'aurora'
        runs = sorted((tmp_path / 'runs').glob('*'))
        words = [word.replace('runs/<run_id>', str(runs[-1])) if runs else word for word in words]
        wanted = next((code for word, code in CODES.items() if word in comment), 0)
        done = call(*words)
        assert done.code == wanted, f'{line}\n{done.out}\n{done.err}'
