# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One graph for all tests that leave it as it was: ten processes that start are much work."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from aurora_system_tests.graph import RunningGraph

# They come last: the graph that they share lives until the end.
_SHARING = ('test_bad_prompts_over_ros', 'test_graph_runs', 'test_paper_prompts')


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Put the files that share the graph behind all others, in their order."""
    items.sort(key=lambda item: item.path.stem in _SHARING)


@pytest.fixture(scope='session')
def graph(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningGraph]:
    """Every node; in the end each leaves with 0 and none has written a traceback."""
    # Imported here: tests that need no ROS are found beside this file, too.
    from aurora_system_tests.graph import running_graph

    with running_graph(tmp_path_factory.mktemp('graph')) as running:
        yield running
        codes = {name: node.end() for name, node in running.nodes.items()}
        assert set(codes.values()) == {0}, codes
        assert 'Traceback' not in running.logs()
