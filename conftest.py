# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import gc
import signal
from collections.abc import Iterator

import pytest


def pytest_collection() -> None:
    """Let the garbage collector wait: of what is collected nearly all stays.

    It would take a tenth of the time of the collection.
    """
    gc.disable()


def pytest_collection_finish() -> None:
    """Keep what was collected out of the garbage collector: thousands of tests that stay anyway.

    Otherwise it goes through all of them again and again, a tenth of the time of a session.
    """
    gc.collect()
    gc.freeze()
    gc.enable()


@pytest.fixture(scope='session', autouse=True)
def _signals_as_in_a_terminal() -> Iterator[None]:
    """Heed SIGINT and SIGHUP, also where the tests run behind nohup or in the background."""
    before = {
        signal.SIGINT: signal.signal(signal.SIGINT, signal.default_int_handler),
        signal.SIGHUP: signal.signal(signal.SIGHUP, signal.SIG_DFL),
    }
    yield
    for number, handler in before.items():
        signal.signal(number, handler)
