# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What to do about an exception: a machine that has no more to give is no defect of ours."""

from __future__ import annotations

import errno
import os

import pytest

from aurora_core.errors import hint_for


@pytest.mark.parametrize(
    ('err', 'said'),
    [
        (MemoryError(), 'ulimit -v'),
        (OSError(errno.ENOMEM, os.strerror(errno.ENOMEM)), 'ulimit -v'),
        (ImportError('libgeos.so: failed to map segment from shared object'), 'ulimit -v'),
        (OSError(errno.EMFILE, os.strerror(errno.EMFILE)), 'ulimit -n'),
        (OSError(errno.ENOSPC, os.strerror(errno.ENOSPC)), 'room on the disk'),
        (OSError(errno.EFBIG, os.strerror(errno.EFBIG)), 'room on the disk'),
        (ImportError('No module named x'), 'defect of AURORA'),
        (ZeroDivisionError('division by zero'), 'defect of AURORA'),
    ],
)
def test_the_hint_names_what_is_used_up(err: Exception, said: str) -> None:
    assert said in hint_for(err)
