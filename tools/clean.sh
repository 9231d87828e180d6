#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# Removes what set-up, builds and tools made; never sources, runs or logs of the user.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
rm -rf .venv .venv-rivals .venv-fuzz ros_ws/build ros_ws/install ros_ws/log .pytest_cache .mypy_cache .ruff_cache \
  .import_linter_cache .hypothesis
find . -name __pycache__ -type d -not -path './.git/*' -prune -exec rm -rf {} +
