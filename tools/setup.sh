#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# Finds a Python that can build AURORA and hands over to tools/aurora_setup.
#   tools/setup.sh            the virtual environment (run lock) and the colcon workspace
#   tools/setup.sh --dev      the same, with the packages that tests and linters need
# PYTHON names the interpreter; AURORA_ROS=system uses /opt/ros/jazzy instead of the wheels.
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)"

# An environment that was sourced before must not leak into the new one.
unset PYTHONPATH PYTHONHOME VIRTUAL_ENV
export _ROS_WHEELS_BOOTSTRAP_COMPLETE=1

# Prints the real path of an interpreter (not of a shim, not of a virtual environment), or says
# on standard error why it does not do.
usable_python() {
  "$1" -I - 2>/dev/null <<'PY' || return 1
import os, sys
base = getattr(sys, '_base_executable', sys.executable) or sys.executable
if not (3, 11) <= sys.version_info[:2] <= (3, 12):
    sys.exit(1)
print(os.path.realpath(base) if sys.prefix != sys.base_prefix else base)
PY
}

if [ -n "${PYTHON:-}" ]; then
  candidates=("$PYTHON")
elif [ "${AURORA_ROS:-wheels}" = system ]; then
  candidates=(/usr/bin/python3)
else
  candidates=("$root/.venv/bin/python" python3.12 python3.11 python3 python)
fi

for candidate in "${candidates[@]}"; do
  if found="$(usable_python "$candidate")"; then
    exec "$found" -I "$root/tools/aurora_setup" "$@"
  fi
done
echo "setup: error: no Python 3.11 or 3.12 found (tried: ${candidates[*]});" \
  "install one (Debian, Ubuntu: apt install python3 python3-venv python3-dev g++ make libgl1 libxext6 libxrender1) or name it with PYTHON=…" >&2
exit 1
