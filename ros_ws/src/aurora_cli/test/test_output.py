# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import os
import subprocess
import sys

import pytest

from aurora_cli.output import print_json

MAIN = 'from aurora_cli.main import main; main()'


def test_what_libraries_print_does_not_reach_standard_output() -> None:
    code = (
        'import os\n'
        'from aurora_cli.output import quiet_stdout\n'
        'with quiet_stdout():\n'
        '    os.write(1, b"from C\\n")\n'
        '    print("from Python")\n'
        'print("answer")\n'
    )
    done = subprocess.run(
        [sys.executable, '-c', code], capture_output=True, text=True, check=True, timeout=30
    )
    assert done.stdout == 'answer\n'
    assert sorted(done.stderr.split('\n'))[1:] == ['from C', 'from Python']


def test_a_closed_standard_output_is_no_crash() -> None:
    code = (
        'import os\n'
        'os.close(1)\n'
        'from aurora_cli.output import quiet_stdout\n'
        'with quiet_stdout():\n'
        '    pass\n'
    )
    done = subprocess.run(
        [sys.executable, '-c', code], stderr=subprocess.PIPE, text=True, check=False, timeout=30
    )
    assert 'Traceback' not in done.stderr


def test_json_keeps_umlauts_and_refuses_what_is_not_finite(
    capsys: pytest.CaptureFixture[str],
) -> None:
    print_json({'text': 'Käse'})
    out = capsys.readouterr().out
    assert 'Käse' in out
    assert json.loads(out) == {'text': 'Käse'}
    with pytest.raises(ValueError, match='JSON'):
        print_json({'x': float('inf')})


def test_a_reader_that_left_is_no_traceback() -> None:
    reader, writer = os.pipe()
    os.close(reader)
    done = subprocess.run(
        [
            sys.executable,
            '-c',
            'from aurora_cli.main import main; main()',
            'map',
            'list',
            '--json',
        ],
        stdout=writer,
        stderr=subprocess.PIPE,
        text=True,
        check=False,
        timeout=60,
    )
    os.close(writer)
    assert 'Traceback' not in done.stderr
