#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# Runs the tests that start no ROS node, and says how much of the core they run and which error codes
# they provoke: tools/coverage.sh FOLDER [TESTS …]. FOLDER gets coverage.json (with branches) and
# codes/. It fails when a test does, or below the threshold of pyproject.toml ([tool.coverage.report]).
set -euo pipefail
folder="$(mkdir -p "$1" && cd "$1" && pwd)"
shift
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source ros_ws/setup.bash
mapfile -t packages < <(tools/packages.sh)
[ $# -eq 0 ] || packages=("$@")
rm -rf "$folder/codes"
mkdir -p "$folder/codes"
export AURORA_CODES_FOLDER="$folder/codes" COVERAGE_FILE="$folder/.coverage" PYTHONPATH="tools:$PYTHONPATH"
exec nice -n 10 python -m pytest -q -n logical --dist worksteal -m 'not ros' -p error_codes \
  --cov=aurora_core --cov-branch --cov-report="json:$folder/coverage.json" --cov-report= "${packages[@]}"
