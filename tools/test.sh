#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# Runs every test inside the environment. Options for pytest: PYTEST_ADDOPTS.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source ros_ws/setup.bash
# Hundreds of node processes import the same modules; without their byte code each compiles them.
unset PYTHONDONTWRITEBYTECODE
mapfile -t packages < <(tools/packages.sh)
exec python -m pytest "${packages[@]}" "$@"
