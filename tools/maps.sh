#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# Builds every shipped map from its sources (needs the dev packages: netconvert) and measures it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source ros_ws/setup.bash
for script in config/maps/build_*.py; do
  echo "maps: $script"
  python "$script"
done
for folder in config/maps/*/map.json; do
  aurora map measure "$(basename "$(dirname "$folder")")"
done
