# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

Call = Callable[..., SimpleNamespace]


def test_a_run_becomes_a_bag_of_standard_topics(
    finished: SimpleNamespace, here: Path, call: Call
) -> None:
    done = call('bag', 'standard', str(finished.folder), '-o', 'std', '--json')
    assert done.code == 0
    topics = json.loads(done.out)['topics']
    assert {'/tf', '/markers', '/diagnostics'} <= set(topics)
    assert (here / 'std' / 'metadata.yaml').is_file()
    # The run is as it was, and no folder is written twice.
    assert call('verify', str(finished.folder)).code == 0
    assert call('bag', 'standard', str(finished.folder), '-o', 'std').code == 4
