#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# Style, format, import rules, what an attacker could use, packages, and text that is no Python.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export PATH="$PWD/.venv/bin:$PATH" _ROS_WHEELS_BOOTSTRAP_COMPLETE=1
ruff check .
ruff format --check .
PYTHONPATH=ros_ws/src/aurora_core lint-imports
# What an attacker could use; `# nosec` stands where what is read is ours, or was checked before.
python -m bandit -q -ll -r ros_ws/src bridges aurora_nodes tools -x '*/test/*,*/build/*,*/install/*'
python tools/supply_chain.py check
python tools/check_text.py
