# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Set up a checkout: virtual environment, ROS 2, colcon workspace. Called by tools/setup.sh.

Needs nothing but the standard library. Each step has a stamp; a finished step is skipped, an
interrupted one is done again.
"""

from __future__ import annotations

import argparse
import fcntl
import os
import sys
from pathlib import Path

# Run as a folder (`python tools/aurora_setup`) in isolated mode, hence the plain imports.
sys.path.insert(0, str(Path(__file__).resolve().parent))

from checks import check_machine, check_ros_choice
from console import SetupError, say
from environment import ensure_dev, ensure_run, is_current
from layout import WHEELS, Layout
from native import ensure_native
from prepared import ensure_prepared
from workspace import ensure_workspace

INTERRUPTED = 130


def main() -> int:
    """Run the set-up; return the process's exit code."""
    parser = argparse.ArgumentParser(prog='tools/setup.sh')
    parser.add_argument('--dev', action='store_true', help='also what tests and linters need')
    parser.add_argument('--no-build', action='store_true', help='only the virtual environment')
    arguments = parser.parse_args()
    layout = Layout(
        root=Path(__file__).resolve().parents[2],
        ros=os.environ.get('AURORA_ROS', '') or WHEELS,
        python_tag=f'{sys.version_info.major}.{sys.version_info.minor}',
    )
    try:
        layout.logs.mkdir(parents=True, exist_ok=True)
        with (layout.logs / 'lock').open('w') as lock:
            _wait_for(lock.fileno())
            check_ros_choice(layout)
            check_machine(layout, fresh=not is_current(layout))
            ensure_run(layout)
            if arguments.dev:
                ensure_dev(layout)
            if not arguments.no_build:
                ensure_workspace(layout)
                ensure_native(layout)
                ensure_prepared(layout)
    except SetupError as err:
        sys.stderr.write(f'setup: error: {err}\n')
        return 1
    except OSError as err:
        sys.stderr.write(f'setup: error: {err.strerror or err}: {err.filename or "?"}\n')
        return 1
    except KeyboardInterrupt:
        sys.stderr.write('setup: interrupted; call `make setup` again to go on\n')
        return INTERRUPTED
    say('ready')
    return 0


def _wait_for(descriptor: int) -> None:
    """Let one set-up per checkout run at a time."""
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        say('another set-up of this checkout is running: waiting for it')
        fcntl.flock(descriptor, fcntl.LOCK_EX)


if __name__ == '__main__':
    sys.exit(main())
