# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Open a bag of any storage that `rosbags` reads."""

from __future__ import annotations

import argparse
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from backports.zstd import ZstdError
from rosbags.rosbag2 import Reader, ReaderError

from aurora_ros2cli.errors import CliError

# What reading a damaged file ends with besides ReaderError.
DAMAGE = (
    ReaderError,
    ZstdError,
    OSError,
    EOFError,
    AssertionError,
    ValueError,
    TypeError,
    LookupError,
    struct.error,
)


def add_bag_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the bag and its storage."""
    parser.add_argument('bag_path', type=Path, help='Bag to open')
    parser.add_argument(
        '-s',
        '--storage',
        choices=('mcap', 'sqlite3'),
        help='Storage implementation of bag. By default attempts to detect automatically.',
    )


@contextmanager
def opened(path: Path) -> Iterator[Reader]:
    """Open a bag.

    Args:
        path: Folder with `metadata.yaml`, or a single file.

    Raises:
        CliError: If it is not there or cannot be read, also later on.
    """
    if not path.exists():
        raise CliError(f"[ERROR] [ros2bag]: Bag path '{path}' does not exist!")
    try:
        with Reader(path) as reader:
            yield reader
    except BrokenPipeError:
        raise  # of standard output, not of the bag
    except DAMAGE as err:
        raise CliError(
            f"[ERROR] [ros2bag]: cannot read the bag '{path}': {err or type(err).__name__}"
        ) from err
