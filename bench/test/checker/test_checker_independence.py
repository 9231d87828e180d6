# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The checker shares nothing with what it checks."""

from __future__ import annotations

import ast
import json
import subprocess
import sys
from pathlib import Path

import aurora_bench.checker

PACKAGE = Path(aurora_bench.checker.__file__).parent


def test_no_source_of_the_checker_imports_anything_of_ours() -> None:
    foreign = []
    files = sorted(PACKAGE.rglob('*.py'))
    assert len(files) > 10
    for file in files:
        for node in ast.walk(ast.parse(file.read_text(encoding='utf-8'))):
            names = []
            if isinstance(node, ast.Import):
                names = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom):
                names = ['.' * node.level + (node.module or '')]
                if node.module == 'aurora_bench':
                    names = [f'aurora_bench.{alias.name}' for alias in node.names]
            elif isinstance(node, ast.Call) and ast.unparse(node.func) in (
                '__import__',
                'importlib.import_module',
                'import_module',
            ):
                names = ['.dynamic']
            foreign += [
                f'{file.name}: {name}'
                for name in names
                if name.startswith('.')
                or (name.startswith('aurora') and not name.startswith('aurora_bench.checker'))
            ]
    assert foreign == []


def test_no_module_of_ours_is_loaded_when_it_runs() -> None:
    code = (
        'import json, sys; import aurora_bench.checker, aurora_bench.checker.__main__; '
        'print(json.dumps(sorted(sys.modules)))'
    )
    done = subprocess.run(
        [sys.executable, '-c', code], capture_output=True, text=True, check=True, timeout=120
    )
    ours = [m for m in json.loads(done.stdout) if m.startswith('aurora')]
    assert 'aurora_bench.checker.check' in ours
    assert [
        m for m in ours if m != 'aurora_bench' and not m.startswith('aurora_bench.checker')
    ] == []


def test_no_claim_of_the_recording_is_read() -> None:
    text = (PACKAGE / 'read.py').read_text(encoding='utf-8')
    for topic in ('agsg', '/aurora/events', 'sensing', 'margins', 'verdict', 'ground/command'):
        assert topic not in text
    assert 'conditions_json' not in text
