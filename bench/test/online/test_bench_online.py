# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
from pathlib import Path

from aurora_bench.online.__main__ import main


def test_every_way_of_looking_ends_with_the_offline_margins(tmp_path: Path) -> None:
    code = main(['--agents', '3', '--seconds', '30', '--results', str(tmp_path)])
    costs = json.loads((tmp_path / 'online.json').read_text())['costs']
    assert code == 0
    assert [cost['step'] for cost in costs] == [1, 10, 20] * 2
    assert all(cost['equal'] for cost in costs)
    assert 'ms per tick' in (tmp_path / 'online.md').read_text()
