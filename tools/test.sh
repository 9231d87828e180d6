#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# Runs every test inside the environment: those that start no ROS nodes side by side, one worker per
# core, then the others one by one. Options for both: as arguments or in PYTEST_ADDOPTS.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source ros_ws/setup.bash
# Hundreds of node processes import the same modules; without their byte code each compiles them.
unset PYTHONDONTWRITEBYTECODE
mapfile -t packages < <(tools/packages.sh)
together=0 alone=0
python -m pytest -n logical --dist worksteal -m 'not ros' "${packages[@]}" "$@" || together=$?
python -m pytest -m ros "${packages[@]}" "$@" || alone=$?
# 5: the options select none of these, which is a failure only when they select none at all.
[ "$together" != 5 ] || together=$alone
[ "$alone" != 5 ] || alone=$together
exit $((together > alone ? together : alone))
