#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# Prints the folder of every package of the workspace that holds Python, relative to the checkout,
# once each (the links in ros_ws/src would name some twice), and tools/, which has tests too.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
for manifest in */package.xml bridges/*/package.xml ros_ws/src/*/package.xml; do
  folder="${manifest%/package.xml}"
  [ -e "$manifest" ] && [ ! -L "$folder" ] || continue
  [ -z "$(find "$folder" -name '*.py' -print -quit)" ] || echo "$folder"
done
echo tools
