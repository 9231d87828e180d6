# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Every command on the pages that are written for newcomers ends as the page says."""

from __future__ import annotations

import re
import shlex
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import pytest

Call = Callable[..., SimpleNamespace]
DOCS = Path(__file__).resolve().parents[4] / 'docs'
# Words beside a command that announce its exit code.
CODES = {'infeasible': 5, 'not understood': 3}


# Have tests of their own (test_beside, test_allow_relax, test_killed_repair), or need a machine.
ELSEWHERE = ('--jobs', '--dask', '--allow-relax', 'aurora repair')


def _lines(page: str) -> list[str]:
    blocks = re.findall(r'```bash\n(.*?)```', (DOCS / page).read_text(encoding='utf-8'), re.DOTALL)
    lines = [line for block in blocks for line in block.splitlines()]
    # Those of the graph, and of who changes the code, have tests of their own.
    return [
        line
        for line in lines
        if line.startswith(('aurora ', 'openssl ', 'base64 '))
        and not any(part in line for part in ELSEWHERE)
    ]


@pytest.mark.parametrize(
    'page',
    ['prompts.md', 'verdict.md', 'exports.md', 'agsg.md', 'repair.md', 'security.md'],
)
def test_the_commands_end_as_announced(
    page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, call: Call
) -> None:
    monkeypatch.chdir(tmp_path)
    lines = _lines(page)
    assert lines
    if '<run_id>' in lines[0]:
        assert call('run', 'A drone hovers at 20 meters for 5 seconds.').code == 0
    for line in lines:
        command, _, comment = line.replace('~/', f'{tmp_path}/').partition('  #')
        runs = sorted((tmp_path / 'runs').glob('*'))
        if runs:
            command = command.replace('runs/<run_id>', str(runs[-1]))
        name, *words = shlex.split(command)
        if name != 'aurora':
            if shutil.which(name) is None:
                pytest.skip(f'no {name} on this machine')
            subprocess.run(['bash', '-c', command], cwd=tmp_path, check=True, timeout=60)
            continue
        wanted = next((code for word, code in CODES.items() if word in comment), 0)
        done = call(*words)
        assert done.code == wanted, f'{line}\n{done.out}\n{done.err}'
