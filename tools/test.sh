#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# Runs every test inside the environment: those that start ROS nodes one by one, and beside them,
# with what these leave of the processor, all others in one worker per core. The ROS tests wait much
# of their time; the others have the lowest priority, so that no node waits for one of them.
# Options for both: as arguments or in PYTEST_ADDOPTS.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source ros_ws/setup.bash
# Hundreds of node processes import the same modules; without their byte code each compiles them.
unset PYTHONDONTWRITEBYTECODE
mapfile -t packages < <(tools/packages.sh)
# The others need not be imported for the ROS part.
mapfile -t ros_files < <(grep -rl --include='test_*.py' 'pytest\.mark\.ros' "${packages[@]}")
together=0 alone=0
output="$(mktemp)"
nice -n 19 python -m pytest -n logical --dist worksteal -m 'not ros' "${packages[@]}" "$@" \
  > "$output" 2>&1 &
others=$!
trap 'kill "$others" 2> /dev/null || true; rm -f "$output"' EXIT
python -m pytest -m ros "${ros_files[@]}" "$@" || alone=$?
[ "$alone" != 2 ] || exit 2 # interrupted
tail -n +1 -f --pid="$others" "$output"
wait "$others" || together=$?
# 5: the options select none of these, which is a failure only when they select none at all.
[ "$together" != 5 ] || together=$alone
[ "$alone" != 5 ] || alone=$together
exit $((together > alone ? together : alone))
