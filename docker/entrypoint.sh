#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# Runs the container's command inside AURORA's environment.
set -eo pipefail
source /aurora/ros_ws/setup.bash
exec "$@"
