#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# `make demo`: sets up if needed, starts the graph, runs the prompt in $PROMPT, prints the verdict,
# stops the graph. Exit code 0 when verified.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)"
"$root/tools/setup.sh"
cd "$root"
# From standard input: a prompt may begin with a dash.
printf '%s' "${PROMPT:?make demo needs a prompt}" | tools/in_env.sh aurora run --engine ros --picture -
