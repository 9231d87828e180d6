#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# Style, format, import rules, and the text that is no Python.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export PATH="$PWD/.venv/bin:$PATH" _ROS_WHEELS_BOOTSTRAP_COMPLETE=1
ruff check .
ruff format --check .
PYTHONPATH=ros_ws/src/aurora_core lint-imports
python tools/check_text.py
