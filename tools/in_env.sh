#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# Runs a command inside the environment of ros_ws/setup.bash:  tools/in_env.sh COMMAND [ARGUMENT…]
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)"
source "$root/ros_ws/setup.bash"
exec "$@"
