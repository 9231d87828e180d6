# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The doctor where the environment is not there:  python3 ros_ws/src/aurora_cli/aurora_cli/doctor

Needs nothing but Python; what is missing becomes a finding.
"""

from __future__ import annotations

import sys
from pathlib import Path

_HERE = Path(__file__).resolve()
_SOURCES = _HERE.parents[3]
for _folder in (
    _HERE.parents[2],
    _SOURCES / 'aurora_core',
    _SOURCES / 'bridges' / 'aurora_uav_sim',
):
    if str(_folder) not in sys.path:
        sys.path.append(str(_folder))

from aurora_cli.commands.doctor import main  # noqa: E402  (found only now)

if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
